// nsframe study: a scene over combinations of its keys, against a reference that is made automatically.
#include "app/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/errors.hpp"
#include "output/files.hpp"
#include "output/numerical_warnings.hpp"
#include "output/poundings.hpp"
#include "output/summary.hpp"
#include "study/report.hpp"

namespace nsframe::app {

namespace {

// Tried in turn as the reference's scheme, as far as registered: the first that takes the scene.
constexpr const char* reference_schemes[]{"exact", "exponential", "moreau-jean"};
constexpr int most_halvings = 6;
constexpr double enough = 1e-4;  // own error of a reference, of the peak, below which no step is halved further

struct Run {
  Summary summary;
  std::vector<VectorX> history;
};

std::vector<int> nodes_to_compare(const LoadedScene& loaded) {
  std::vector<int> nodes;
  const auto& asked = loaded.scene.output.nodes;
  for (int i = 0; i < loaded.model.nodes.size(); ++i) {
    const std::string& id = loaded.model.nodes.id[static_cast<std::size_t>(i)];
    if (asked.empty() || std::find(asked.begin(), asked.end(), id) != asked.end()) nodes.push_back(i);
  }
  return nodes;
}

Run run_once(const LoadedScene& loaded, const AnalysisOptions& options, double interval) {
  ReducedSimulation simulation(loaded.model, options);
  HistoryRecorder recorder(nodes_to_compare(loaded), interval, options.dt);
  Run run;
  run.summary = simulation.run({&recorder});
  run.summary.poundings = merge_impacts(run.summary.impacts);
  run.history = recorder.rows();
  return run;
}

class StudyRun {
 public:
  StudyRun(const StudyArguments& arguments, std::vector<StudyAxis> axes) : arguments_(arguments), axes_(std::move(axes)) {}
  Study run();

 private:
  LoadedScene load_with(const Combination& settings) const;
  void find_interval();
  // Index of the reference for the physical keys of this combination; makes it when it is the first.
  int reference_for(const Combination& settings);
  Run make_reference(const LoadedScene& loaded, StudyReference& reference) const;
  StudyRow row_of(const Combination& settings);

  const StudyArguments& arguments_;
  std::vector<StudyAxis> axes_;
  double interval_ = 0, least_step_ = 1e300;  // [s]
  Study study_;
  std::vector<Run> references_;
};

LoadedScene StudyRun::load_with(const Combination& settings) const {
  SceneArguments arguments = arguments_.scene;
  arguments.set.insert(arguments.set.end(), settings.begin(), settings.end());
  return load(arguments);
}

// Every combination is read here, so that bad keys and values stop the study before its first run.
void StudyRun::find_interval() {
  std::vector<double> steps;
  double duration = 1e300;
  for (const Combination& settings : combinations(axes_)) {
    const LoadedScene loaded = load_with(settings);
    study_.title = loaded.scene.title;
    const AnalysisOptions& options = loaded.scene.analysis;
    double length = options.duration;
    if (length == 0) {
      for (const GroundMotion& motion : loaded.model.motions) length = std::max(length, motion.duration());
    }
    if (!(length > 0)) throw InputError("error: a study needs a time history: the scene has neither duration nor motion");
    steps.push_back(options.dt);
    least_step_ = std::min(least_step_, options.dt);
    duration = std::min(duration, length);
  }
  interval_ = common_interval(steps, duration);
}

Run StudyRun::make_reference(const LoadedScene& loaded, StudyReference& reference) const {
  const std::vector<std::string> known = scheme_names();
  AnalysisOptions options = loaded.scene.analysis;
  options.highest_frequency = 0;  // a reference leaves nothing out,
  options.accuracy = 0;           // and its steps are those that are halved
  std::string reasons;
  for (const char* scheme : reference_schemes) {
    if (std::find(known.begin(), known.end(), scheme) == known.end()) continue;
    options.scheme = reference.scheme = scheme;
    options.theta = options.gamma = 0.5;
    options.dt = least_step_;
    Run coarse;
    try {
      coarse = run_once(loaded, options, interval_);
    } catch (const InputError& refusal) {
      reasons += std::string(refusal.what()) + "\n";
      continue;
    }
    for (int halved = 0; halved < most_halvings && coarse.summary.completed; ++halved) {
      options.dt /= 2;
      Run fine = run_once(loaded, options, interval_);
      if (!fine.summary.completed) break;
      reference.dt = options.dt;
      reference.own_error = largest_difference(coarse.history, fine.history);
      reference.peak = largest(fine.history);
      coarse = std::move(fine);
      if (reference.own_error <= enough * reference.peak) break;
    }
    if (reference.dt > 0) return coarse;
    reasons += fmt::format("error: {}: {}\n", scheme, coarse.summary.stop_reason);
  }
  throw InputError("error: no scheme gives a reference for this scene:\n" + reasons);
}

int StudyRun::reference_for(const Combination& settings) {
  Combination physics;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (axes_[i].physical()) physics.push_back(settings[i]);
  }
  for (std::size_t i = 0; i < references_.size(); ++i) {
    if (study_.references[i].physics == physics) return static_cast<int>(i);
  }
  StudyReference reference;
  reference.physics = physics;
  references_.push_back(make_reference(load_with(physics), reference));
  reference.impacts = static_cast<int>(references_.back().summary.impacts.size());
  reference.poundings = static_cast<int>(references_.back().summary.poundings.size());
  study_.references.push_back(reference);
  return static_cast<int>(references_.size()) - 1;
}

StudyRow StudyRun::row_of(const Combination& settings) {
  StudyRow row;
  row.settings = settings;
  row.reference = reference_for(settings);
  const Run& reference = references_[static_cast<std::size_t>(row.reference)];
  const LoadedScene loaded = load_with(settings);
  try {
    Run run = run_once(loaded, loaded.scene.analysis, interval_);
    row.seconds = run.summary.timing.step_loop;
    for (int i = 1; i < arguments_.repeat && run.summary.completed; ++i) {
      row.seconds = std::min(row.seconds, run_once(loaded, loaded.scene.analysis, interval_).summary.timing.step_loop);
    }
    if (!run.summary.completed) row.failure = run.summary.stop_reason;
    row.scheme = run.summary.scheme;
    row.steps = run.summary.steps;
    row.error = largest_difference(reference.history, run.history);
    row.impacts = static_cast<int>(run.summary.impacts.size());
    row.poundings = match(reference.summary.poundings, run.summary.poundings, pounding_window);
    for (const ModeNumerics& mode : modes_that_matter(run.summary))
      row.added_damping = std::max(row.added_damping, mode.damping_effective - mode.damping_asked);
  } catch (const InputError& refusal) {  // a scheme that does not take the scene: the others still run
    row.failure = refusal.what();
  } catch (const ConvergenceError& problem) {
    row.failure = problem.what();
  }
  return row;
}

Study StudyRun::run() {
  find_interval();
  for (const Combination& settings : combinations(axes_)) study_.rows.push_back(row_of(settings));
  return std::move(study_);
}

}  // namespace

int study(const StudyArguments& arguments) {
  const Study study = StudyRun(arguments, parse_axes(arguments.vary)).run();
  const std::filesystem::path folder = output_folder(arguments.scene);
  make_folder(folder);
  write_text_file(folder / "study.csv", study_csv(study));
  write_text_file(folder / "study.json", study_json(study));
  const std::string diagram = study_svg(study);
  if (!diagram.empty()) write_text_file(folder / "study.svg", diagram);
  fmt::print("{}\nstudy.csv, study.json{} in {}\n", study_text(study), diagram.empty() ? "" : ", study.svg", folder.string());
  return done;
}

}  // namespace nsframe::app
