#include <fmt/format.h>

#include <csignal>
#include <optional>

#include "app/commands.hpp"
#include "app/progress.hpp"
#include "app/resume.hpp"
#include "base/errors.hpp"
#include "base/timer.hpp"
#include "output/drifts.hpp"
#include "output/floor_spectra.hpp"
#include "output/history_file.hpp"
#include "output/peaks.hpp"
#include "output/poundings.hpp"
#include "output/sliding_watch.hpp"
#include "output/summary.hpp"
#include "output/warnings.hpp"
#ifdef NSFRAME_HAS_VTK
#include "output/stage_frames.hpp"
#include "output/vtk_frames.hpp"
#endif

namespace nsframe::app {

namespace {

// Largest effective mass of each mode, in the order of summary.modes.
void add_participation(const std::vector<StructureModes>& structures, Summary& summary) {
  std::size_t mode = 0;
  for (const StructureModes& modes : structures) {
    for (const Vector3& share : modes.participation) {
      if (mode == summary.modes.size()) return;
      summary.modes[mode].participation = share.maxCoeff();
      summary.modes[mode++].shares = share;
    }
  }
}

// Whether there was a time history, not static stages alone.
bool has_history(const Summary& summary) {
  return summary.stages.empty() || (summary.duration > 0 && summary.stages.back().completed);
}

void print_files(const std::filesystem::path& folder, bool frames, const Summary& summary) {
  fmt::print("\nresults in {}:\n", folder.string());
  const bool history = has_history(summary);
  if (frames && !summary.stages.empty()) fmt::print("  static/<stage>/    frames.pvd of every static stage, a point a frame\n");
  if (frames && history) fmt::print("  frames.pvd         open in ParaView, or run: paraview --script={}\n", (folder / "open_in_paraview.py").string());
  fmt::print("  summary.json       everything above, for programs\n");
  fmt::print("  results.h5         histories, impacts and the complete scene (HDF5)\n");
  fmt::print("  scene.toml         the scene with every default that was used\n");
  if (history) fmt::print("  checkpoint.h5      to go on from here with --resume, for instance to a longer analysis.duration\n");
}

// An earlier run's would not belong to the new files.
void remove_checkpoint(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::remove(folder / "checkpoint.h5", error);
  if (error) throw IoError(fmt::format("error: cannot remove '{}': {}", (folder / "checkpoint.h5").string(), error.message()));
}

RunControl keeping_checkpoints(const std::filesystem::path& folder, const std::string& scene, double interval) {
  RunControl control;
  control.stop_requested = [] { return SignalWatch::received() != 0; };
  control.keep_snapshot = [=](const Snapshot& snapshot) { write_checkpoint(folder / "checkpoint.h5", scene, snapshot); };
  control.snapshot_interval = interval;
  return control;
}

int exit_code(const Summary& summary, const std::filesystem::path& folder) {
  if (summary.completed) return done;
  if (!has_history(summary)) {
    fmt::print(stderr, "error: stopped: {}\nwhat was computed until then is kept in {}\n", summary.stop_reason, folder.string());
    return summary.interrupted ? interrupted - SIGINT + SignalWatch::received() : not_converged;
  }
  if (summary.interrupted) {
    fmt::print(stderr, "interrupted at t = {:.6g} s; the same command with --resume goes on from there (results in {})\n",
               summary.end_time, folder.string());
    return interrupted - SIGINT + SignalWatch::received();
  }
  fmt::print(stderr, "error: stopped at t = {:.6g} s: {}\nwhat was computed until then is kept in {}\n", summary.end_time,
             summary.stop_reason, folder.string());
  return not_converged;
}

}  // namespace

int run(const SceneArguments& arguments) {
  const Timer timer;
  const LoadedScene loaded = load(arguments);
  const std::filesystem::path folder = output_folder(arguments);
  const std::string complete = write_scene(loaded.scene, folder);
  Checkpoint checkpoint;
  if (arguments.resume) checkpoint = checkpoint_to_resume(folder, complete);
  ReducedSimulation reduced(loaded.model, loaded.scene.analysis);
  Simulation& simulation = reduced.simulation();
  if (arguments.resume) check_duration(checkpoint.snapshot, simulation.duration());
  const double setup = timer.seconds();
  make_folder(folder);
  write_text(folder / "scene.toml", complete);
  if (!arguments.resume) remove_checkpoint(folder);

  PeakTracker peaks(loaded.scene.output.nodes);
  DriftTracker drifts;
  std::optional<FloorSpectra> spectra;
  if (loaded.scene.output.floor_spectra) spectra.emplace(*loaded.scene.output.floor_spectra, loaded.scene.analysis.dt);
  HistoryFile history(folder / "results.h5", loaded.scene.output, complete, spectra ? &*spectra : nullptr);
  ProgressBar progress(simulation.duration(), arguments.quiet);
  SlidingWatch sliding;
  std::vector<Observer*> observers{&peaks, &drifts, &history, &progress, &sliding};
  if (spectra) observers.push_back(&*spectra);
  const bool wants_frames = loaded.scene.output.frames > 0;
#ifdef NSFRAME_HAS_VTK
  VtkFrames frames(folder, loaded.scene.output);
  StageFrames stage_frames(folder / "static", loaded.scene.output);
  if (wants_frames) observers.push_back(&frames);
#else
  if (wants_frames) throw InputError("error: output.frames: this nsframe was built without VTK; set frames = 0");
#endif
  const SignalWatch signals;
  RunControl control = keeping_checkpoints(folder, complete, loaded.scene.output.checkpoint);
  if (arguments.resume) control.resume = &checkpoint.snapshot;
  std::vector<StageObserver*> stage_observers;
  if (!arguments.resume) {  // what an earlier run wrote of the stages stands
    stage_observers.push_back(&history.stages());
#ifdef NSFRAME_HAS_VTK
    if (wants_frames) stage_observers.push_back(&stage_frames);
#endif
  }
  Summary summary = reduced.run(observers, control, stage_observers);
  if (!has_history(summary)) history.close();
  summary.title = loaded.scene.title;
  summary.timing.setup += setup - simulation.setup_seconds();  // the scene, too
  summary.poundings = merge_impacts(summary.impacts);
  summary.peaks = peaks.peaks();
  summary.drifts = drifts.drifts();
  add_participation(simulation.modes(), summary);
  summary.warnings = run_warnings(loaded.model, summary);
  if (spectra) {
    summary.floor_spectra = spectra->peaks();
    summary.floor_spectra_damping = spectra->damping();
    for (std::string& warning : spectrum_warnings(*spectra, summary.dt)) summary.warnings.push_back(std::move(warning));
  }
  for (std::string& warning : sliding.warnings()) summary.warnings.push_back(std::move(warning));
  write_summary(summary, folder / "summary.json");
  if (!arguments.quiet) {
    fmt::print("{}", summary_text(summary));
    print_files(folder, wants_frames, summary);
  }
  return exit_code(summary, folder);
}

}  // namespace nsframe::app
