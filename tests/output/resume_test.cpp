// What a run that was killed left behind, and going on from it; the program as a whole: tests/app/resume_test.cpp.
#include <doctest/doctest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <thread>

#include "base/errors.hpp"
#include "integrators/simulation.hpp"
#include "output/checkpoint.hpp"
#include "output/history_file.hpp"
#include "output/peaks.hpp"
#ifdef NSFRAME_HAS_VTK
#include "output/vtk_frames.hpp"
#endif
#include "tests/support/files.hpp"
#include "tests/support/hdf5_contents.hpp"
#include "tests/verification/two_story_model.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

constexpr int last_checkpoint = 2000, killed_at = 2345;  // steps

class Killer : public MotionObserver {
 public:
  void step(const State&, const State&, const StepReport& report, const Energy&) override {
    if (report.step == killed_at) raise(SIGKILL);
  }
};

struct Outcome {
  Summary summary;
  std::vector<Peak> peaks;
};

Outcome run(const Scene& scene, const std::filesystem::path& folder, RunControl control, Observer* more = nullptr) {
  const Model model = model_of(scene);
  Simulation simulation(model, scene.analysis);
  PeakTracker peaks;
  HistoryFile history(folder / "results.h5", scene.output, "title = \"killed\"\n");
  std::vector<Observer*> observers{&peaks, &history};
#ifdef NSFRAME_HAS_VTK
  VtkFrames frames(folder, scene.output);
  observers.push_back(&frames);
#endif
  if (more) observers.push_back(more);
  Outcome outcome{simulation.run(observers, control), {}};
  outcome.peaks = peaks.peaks();
  return outcome;
}

// Snapshots after every step, of which the file keeps those up to `last_checkpoint`: rows beyond it are in results.h5.
RunControl checkpoints(const std::filesystem::path& folder) {
  RunControl control;
  control.snapshot_interval = 1e-9;
  control.keep_snapshot = [=](const Snapshot& snapshot) {
    const double step = snapshot.number("time_history.steps");
    if (step > last_checkpoint - 5 && step <= last_checkpoint) write_checkpoint(folder / "checkpoint.h5", "", snapshot);
  };
  return control;
}

bool same_bits(const Energy& a, const Energy& b) { return std::memcmp(&a, &b, sizeof(Energy)) == 0; }

Snapshot small_snapshot() {
  Snapshot snapshot;
  snapshot.put("state.time", 0.1);
  snapshot.put("state.velocity", std::vector<double>{1, -0.0, 1e-310, 3});
  snapshot.put("empty", std::vector<double>{});
  return snapshot;
}

}  // namespace

TEST_CASE("a run killed between two checkpoints goes on from the last one with the same bits") {
  for (const auto& [name, scheme] : {std::pair<std::string, std::string>{"two_story_elastic", "moreau-jean"},
                                     {"two_story_elastic", "exact"}, {"two_story", "moreau-jean"}, {"two_story", "exponential"}}) {
    CAPTURE(name);
    CAPTURE(scheme);
    const Scene scene = example_scene(name, {"analysis.scheme=" + scheme, "analysis.duration=3 s",
                                             scheme == "exponential" ? "analysis.accuracy=1e-3" : "analysis.dt=1 ms", "output.history=[\"nodes\", \"contacts\", \"sections\", \"fibers\", \"energy\"]",
                                             "output.history_rate=300"});
    const TemporaryFolder whole, killed;
    const Outcome expected = run(scene, whole.path(), {});
    const pid_t child = fork();
    if (child == 0) {
      Killer killer;
      run(scene, killed.path(), checkpoints(killed.path()), &killer);
      _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    REQUIRE(WIFSIGNALED(status));
    const Checkpoint checkpoint = read_checkpoint(killed / "checkpoint.h5");
    RunControl control;
    control.resume = &checkpoint.snapshot;
    const Outcome resumed = run(scene, killed.path(), control);
    check_same_contents(whole / "results.h5", killed / "results.h5");
    CHECK(files_below(whole.path(), {"results.h5", "checkpoint.h5"}) == files_below(killed.path(), {"results.h5", "checkpoint.h5"}));
    CHECK(same_bits(expected.summary.energy, resumed.summary.energy));
    CHECK(expected.summary.impacts.size() == resumed.summary.impacts.size());
    CHECK(expected.summary.factorizations == resumed.summary.factorizations);
    CHECK(expected.summary.newton_iterations == resumed.summary.newton_iterations);
    for (std::size_t i = 0; i < expected.peaks.size(); ++i) {
      CHECK(expected.peaks[i].acceleration == resumed.peaks[i].acceleration);
    }
  }
}

TEST_CASE("a checkpoint gives back every bit, and an earlier one stays when the new one cannot be written") {
  const TemporaryFolder folder;
  write_checkpoint(folder / "checkpoint.h5", "title = \"a\"\n", small_snapshot());
  const Checkpoint read = read_checkpoint(folder / "checkpoint.h5");
  CHECK(read.scene == "title = \"a\"\n");
  CHECK(read.version == NSFRAME_VERSION);
  CHECK(read.snapshot.arrays == small_snapshot().arrays);
  CHECK(std::signbit(read.snapshot.array("state.velocity")[1]));
  std::filesystem::create_directory(folder / "checkpoint.h5.partial");  // in the way
  CHECK_THROWS_AS(write_checkpoint(folder / "checkpoint.h5", "title = \"b\"\n", small_snapshot()), IoError);
  CHECK(read_checkpoint(folder / "checkpoint.h5").scene == "title = \"a\"\n");
}

TEST_CASE("a snapshot that lacks an array, or has one of another size, is refused") {
  const Snapshot snapshot = small_snapshot();
  CHECK_THROWS_AS(snapshot.number("state.velocity"), IoError);
  CHECK_THROWS_AS(snapshot.array("state.history"), IoError);
  VectorX three(3);
  CHECK_THROWS_AS(snapshot.read("state.velocity", three), IoError);
}

TEST_CASE("a checkpoint with any byte of its numbers changed is damaged") {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "checkpoint.h5";
  Snapshot snapshot;
  snapshot.put("state.time", 1234.5);
  write_checkpoint(path, "", snapshot);
  std::string bytes = file_text(path);
  const double time = 1234.5;
  const std::size_t at = bytes.find(std::string(reinterpret_cast<const char*>(&time), sizeof time));
  REQUIRE(at != std::string::npos);
  bytes[at + 1] = static_cast<char>(bytes[at + 1] ^ 1);
  std::ofstream(path, std::ios::binary) << bytes;
  CHECK_THROWS_AS(read_checkpoint(path), IoError);
  std::ofstream(path, std::ios::binary) << "not HDF5";
  CHECK_THROWS_AS(read_checkpoint(path), IoError);
}

TEST_CASE("what writing checkpoints takes is counted as output, not as steps") {
  const Scene scene = example_scene("bouncing_ball", {"analysis.scheme=exact", "analysis.dt=5 ms", "analysis.duration=0.05 s"});
  constexpr double writing = 0.25;  // [s] a checkpoint, thousands of times what the ten steps take
  int written = 0;
  RunControl control;
  control.snapshot_interval = 1e-9;
  control.keep_snapshot = [&](const Snapshot&) {
    if (++written <= 2) std::this_thread::sleep_for(std::chrono::duration<double>(writing));
  };
  const TemporaryFolder folder;
  const Summary summary = run(scene, folder.path(), control).summary;
  REQUIRE(written >= 2);
  CHECK(summary.timing.step_loop < writing);
  CHECK(summary.timing.output >= 2 * writing);
}
