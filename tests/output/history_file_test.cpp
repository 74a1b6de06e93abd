#include <doctest/doctest.h>
#include <sched.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <memory>

#include "base/errors.hpp"
#include "output/history_file.hpp"
#include "output/member_forces.hpp"
#include "tests/output/sample_pair.hpp"
#include "tests/support/hdf5_reader.hpp"
#include "tests/support/recorder.hpp"
#include "tests/support/small_models.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

OutputOptions keeping(std::vector<std::string> history) {
  OutputOptions options;
  options.history = std::move(history);
  return options;
}

// Steps of 1 ms whose state is a scaled sample state.
class Steps {
 public:
  Steps(const Model& model, Observer& observer) : base_(sample_state(model)), before_(base_), observer_(observer) {
    observer_.start(model, before_);
  }
  void run(int steps) {
    for (int i = 0; i < steps; ++i) {
      ++step_;
      State after = base_;
      after.time = 1e-3 * step_;
      after.displacement *= factor(step_);
      after.velocity *= factor(step_);
      after.impulse = VectorX::Constant(base_.impulse.size(), 2.0);
      Energy energy;
      energy.input = step_;
      observer_.step(before_, after, {}, energy);
      before_ = after;
    }
  }
  static double factor(int step) { return std::cos(0.01 * step); }
  const State& base() const { return base_; }
  const State& last() const { return before_; }

 private:
  State base_, before_;
  Observer& observer_;
  int step_ = 0;
};

// Runs `body` in a process of its own; its exit code, or minus the signal that ended it.
template <class Body>
int in_child(Body&& body) {
  std::fflush(nullptr);
  std::cout.flush();
  const pid_t child = fork();
  if (child == 0) std::exit(body());  // with HDF5's own handlers at exit
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

}  // namespace

TEST_CASE("HDF5 reads back displacement, velocity and absolute acceleration of the nodes asked for") {
  const TemporaryFolder folder;
  const Model model = sample_pair();
  OutputOptions options = keeping({"nodes"});
  options.nodes = {"right.21", "left.13"};
  HistoryFile history(folder / "results.h5", options, "title = \"pair\"\n");
  Steps steps(model, history);
  steps.run(2500);  // more than two blocks
  history.finish();

  const Hdf5Reader file(folder / "results.h5");
  CHECK(file.shape("/time") == std::vector<hsize_t>{2501});
  CHECK(file.numbers("/time")[2500] == 2.5);
  CHECK(file.texts("/nodes/id") == options.nodes);
  CHECK(file.shape("/nodes/displacement") == std::vector<hsize_t>{2501, 2, 6});
  CHECK(file.units("/nodes/velocity") == "m/s, m/s, m/s, rad/s, rad/s, rad/s");
  CHECK(file.units("/time") == "s");
  const auto displacement = file.numbers("/nodes/displacement"), velocity = file.numbers("/nodes/velocity"),
             acceleration = file.numbers("/nodes/acceleration_absolute");
  const int node = node_index(model, "left.13");
  const VectorX q = model.dofs.expand(steps.base().displacement), v = model.dofs.expand(steps.base().velocity);
  for (const int row : {0, 1, 700, 2500}) {
    for (int k = 0; k < 6; ++k) {
      const auto at = static_cast<std::size_t>(12 * row + 6 + k);
      CHECK(displacement[at] == doctest::Approx(q[6 * node + k] * (row > 0 ? Steps::factor(row) : 1)).epsilon(1e-14));
      CHECK(velocity[at] == doctest::Approx(v[6 * node + k] * (row > 0 ? Steps::factor(row) : 1)).epsilon(1e-14));
      double expected =
          row == 0 ? 0 : v[6 * node + k] * (Steps::factor(row) - (row > 1 ? Steps::factor(row - 1) : 1)) / 1e-3;
      if (row > 0 && k == 0) {
        expected += (model.motions[0].velocity_at(1e-3 * row) - model.motions[0].velocity_at(1e-3 * (row - 1))) / 1e-3;
      }
      CHECK(acceleration[at] == doctest::Approx(expected).epsilon(1e-9));  // 1e-16 of v over dt
    }
  }
  CHECK(file.texts("/scene")[0] == "title = \"pair\"\n");
  CHECK(file.attribute("/", "finished") == 1);
  CHECK_FALSE(file.has("/contacts"));
  CHECK_FALSE(file.has("/elements"));
}

TEST_CASE("the rows at a lower rate are the nearest steps, and impulses are sums since the row before") {
  const TemporaryFolder folder;
  const Model model = sample_pair();
  OutputOptions options = keeping({"contacts", "energy", "ground"});
  options.history_rate = 100;
  HistoryFile history(folder / "results.h5", options, "");
  Steps steps(model, history);
  steps.run(100);
  history.finish();
  const Hdf5Reader file(folder / "results.h5");
  CHECK(file.shape("/contacts/gap") == std::vector<hsize_t>{11, 4});
  CHECK(file.numbers("/time")[3] == doctest::Approx(0.03));
  CHECK(file.texts("/contacts/pair").size() == 4);
  CHECK(file.texts("/contacts/pair")[0] == model.contacts.pairs[0].name);
  CHECK(file.numbers("/contacts/impulse")[7] == 20);  // ten steps of 2 N s
  const VectorX gap = model.contacts.jacobian * steps.last().displacement + model.contacts.initial_gap;
  CHECK(file.numbers("/contacts/gap")[43] == doctest::Approx(gap[3]).epsilon(1e-14));
  CHECK(file.numbers("/energy/input")[10] == 100);
  CHECK(file.attribute("/energy", "input") == 100);
  CHECK(file.numbers("/ground/acceleration")[9] == doctest::Approx(model.motions[0].acceleration_at(0.03)));
}

TEST_CASE("element forces are in local axes and sections carry N, MZ, MY") {
  const TemporaryFolder folder;
  const Model model = sample_pair();
  HistoryFile history(folder / "results.h5", keeping({"elements", "sections"}), "");
  Steps steps(model, history);
  steps.run(3);
  history.finish();
  const Hdf5Reader file(folder / "results.h5");
  CHECK(file.shape("/elements/elastic_beam/forces") == std::vector<hsize_t>{4, 32, 12});
  const auto ids = file.texts("/elements/elastic_beam/id");
  CHECK(ids[0] == model.groups[0]->id(0));
  const auto forces = file.numbers("/elements/elastic_beam/forces");
  EndForces end_forces;
  const Vector12 expected =
      end_forces.evaluate(model, 0, 5, steps.last(), model.dofs.expand(steps.last().displacement));
  const double* stored = &forces[(3 * 32 + 5) * 12];
  CHECK((Eigen::Map<const Vector12>(stored) - expected).norm() == 0);
  // equilibrium of a member without loads: N, VY, VZ and T are opposite, MZ differs by VY L
  CHECK(stored[0] == doctest::Approx(-stored[6]));
  CHECK(stored[5] + stored[11] == doctest::Approx(stored[1] * model.groups[0]->shape(5).length));
  CHECK(file.shape("/sections/elastic_beam/force") == std::vector<hsize_t>{4, 64, 3});
  const auto sections = file.numbers("/sections/elastic_beam/force");
  const double* first = &sections[(3 * 64 + 10) * 3];
  CHECK(first[0] == doctest::Approx(-stored[0]));
  CHECK(first[1] == doctest::Approx(-stored[5]));
  CHECK(first[2] == doctest::Approx(-stored[4]));
  CHECK(file.texts("/sections/elastic_beam/element")[10] == ids[5]);
}

TEST_CASE("sections with laws of shear and torsion have their strains and forces too, others have not") {
  ModelDescription d = column();
  d.materials = {{"steel", {}, Elastic{210e9}}, {"y", {}, Elastic{5e6}}, {"z", {}, Elastic{2e6}}, {"twist", {}, Elastic{6566}}};
  FiberSectionDescription section;
  for (const double y : {-0.05, 0.05}) {
    for (const double z : {-0.04, 0.04}) section.fibers.push_back({y, z, 5e-4, {"steel", {}}});
  }
  section.torsion = Reference{"twist", {}};
  section.shear_y = Reference{"y", {}};
  section.shear_z = Reference{"z", {}};
  d.sections[0].kind = section;
  d.structures[0].elements[0].kind = ElementKind::force_beam;
  d.structures[0].masses = {mass("2", 1000, Vector3(0, 0, 50))};
  for (const auto& [dof, rate] : {std::pair{0, 0.3}, {1, 0.2}, {5, 0.5}}) d.structures[0].initial_velocities.push_back({{"2", {}}, dof, rate});
  const Model model = build(d);
  AnalysisOptions options;
  options.scheme = "moreau-jean";
  options.dt = 1e-3;
  options.duration = 5e-3;
  const TemporaryFolder folder;
  HistoryFile history(folder / "results.h5", keeping({"sections"}), "");
  Recorder recorder;
  REQUIRE(Simulation(model, options).run({&history, &recorder}).completed);
  const Hdf5Reader file(folder / "results.h5");
  const auto strains = file.numbers("/sections/force_beam/shear_deformation"), forces = file.numbers("/sections/force_beam/shear_force");
  const State& last = recorder.states.back();
  const std::vector<SectionResult> sections = model.groups[0]->sections(0, model.dofs.expand(last.displacement), last.history.data());
  const auto points = static_cast<hsize_t>(sections.size());
  REQUIRE(file.shape("/sections/force_beam/shear_force") == std::vector<hsize_t>{6, points, 3});
  for (std::size_t i = 0; i < sections.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t at = 3 * (5 * sections.size() + i) + k;
      const double law = k == 0 ? 5e6 : k == 1 ? 2e6 : 6566;
      CHECK(std::abs(forces[at]) > 1);
      CHECK(forces[at] == sections[i].shear_force[static_cast<Eigen::Index>(k)]);
      CHECK(strains[at] == doctest::Approx(forces[at] / law).epsilon(1e-9));
    }
  }
  d.sections[0].kind = elastic_section("c", {210e9, 81e9, 3e-3, 1e-5, 4e-6, 8e-8}).kind;
  d.structures[0].elements[0].kind = ElementKind::elastic_beam;
  const Model plain = build(d);
  HistoryFile other(folder / "plain.h5", keeping({"sections"}), "");
  REQUIRE(Simulation(plain, options).run({&other}).completed);
  CHECK_FALSE(Hdf5Reader(folder / "plain.h5").has("/sections/elastic_beam/shear_force"));
}

TEST_CASE("without histories the file has impacts, poundings, the energy at the end and the scene") {
  const TemporaryFolder folder;
  const Model model = sample_pair();
  HistoryFile history(folder / "results.h5", {}, "scene text");
  Steps steps(model, history);
  steps.run(10);
  history.impact({0.010, 2, 0.5, 100, -0.5, 0.3});
  history.impact({0.012, 2, 0.1, 10, -0.1, 0.06});
  steps.run(10);
  history.finish();
  const Hdf5Reader file(folder / "results.h5");
  CHECK(file.shape("/time") == std::vector<hsize_t>{0});
  CHECK(file.numbers("/impacts/time") == std::vector<double>{0.010, 0.012});
  CHECK(file.numbers("/impacts/pair") == std::vector<double>{2, 2});
  CHECK(file.numbers("/impacts/impulse") == std::vector<double>{100, 10});
  CHECK(file.numbers("/poundings/impulse") == std::vector<double>{110});
  CHECK(file.numbers("/poundings/effective_restitution")[0] == doctest::Approx(0.12));
  CHECK(file.attribute("/energy", "input") == 20);
  CHECK(file.texts("/scene")[0] == "scene text");
}

TEST_CASE("a run given up by an exception keeps all its rows") {
  const TemporaryFolder folder;
  const Model model = sample_pair();
  {
    HistoryFile history(folder / "results.h5", keeping({"nodes"}), "");
    Steps steps(model, history);
    steps.run(700);
  }
  const Hdf5Reader file(folder / "results.h5");
  CHECK(file.shape("/nodes/displacement") == std::vector<hsize_t>{701, 24, 6});
  CHECK(file.attribute("/", "finished") == 0);
}

TEST_CASE("what was written stays readable when the process is killed") {
  const TemporaryFolder folder;
  const int status = in_child([&] {
    const Model model = sample_pair();
    HistoryFile history(folder / "results.h5", keeping({"nodes", "contacts"}), "scene");
    Steps steps(model, history);
    steps.run(1000);
    return raise(SIGKILL);
  });
  CHECK(status == -SIGKILL);
  const Hdf5Reader file(folder / "results.h5");
  const auto rows = file.shape("/time")[0];
  CHECK(rows > 1000 - 300);  // all but the last block
  CHECK(file.shape("/nodes/displacement")[0] == rows);
  CHECK(file.numbers("/time")[rows - 1] == doctest::Approx(1e-3 * double(rows - 1)));
  CHECK(file.texts("/scene")[0] == "scene");
}

TEST_CASE("an earlier result is replaced when a run starts, not before") {
  const TemporaryFolder folder;
  std::ofstream(folder / "results.h5") << "earlier";
  const Model model = sample_pair();
  { const HistoryFile never_started(folder / "results.h5", {}, ""); }
  CHECK(std::filesystem::file_size(folder / "results.h5") == 7);
  OutputOptions wrong = keeping({"nodes"});
  wrong.nodes = {"nowhere"};
  {
    HistoryFile history(folder / "results.h5", wrong, "");
    CHECK_THROWS_AS(history.start(model, sample_state(model)), InputError);
  }
  CHECK(std::filesystem::file_size(folder / "results.h5") == 7);
  CHECK_FALSE(std::filesystem::exists(folder / "results.h5.partial"));
}

TEST_CASE("wrong names of histories and places that cannot be written are typed errors") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH_AS(HistoryFile(folder / "results.h5", keeping({"node"}), ""),
                       "output.history: unknown history 'node'; did you mean 'nodes'?", InputError);
  const Model model = sample_pair();
  HistoryFile history("/proc/nsframe/results.h5", {}, "");
  CHECK_THROWS_AS(history.start(model, sample_state(model)), IoError);
  std::filesystem::create_directories(folder / "taken/results.h5.partial");
  HistoryFile blocked(folder / "taken/results.h5", {}, "");
  CHECK_THROWS_AS(blocked.start(model, sample_state(model)), IoError);
}

TEST_CASE("a disk that fills up is an I/O error that names the file and the cause, and what fitted stays readable") {
  const TemporaryFolder folder;
  constexpr int not_allowed = 77;
  const int status = in_child([&] {
    // a file system of 1 MB of its own, in a user name space that maps this user
    const uid_t user = getuid();
    const gid_t group = getgid();
    if (unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return not_allowed;
    std::ofstream("/proc/self/uid_map") << "0 " << user << " 1";
    std::ofstream("/proc/self/setgroups") << "deny";
    std::ofstream("/proc/self/gid_map") << "0 " << group << " 1";
    if (mount("none", folder.path().c_str(), "tmpfs", 0, "size=1M") != 0) return not_allowed;
    const Model model = sample_pair();
    auto history = std::make_unique<HistoryFile>(folder / "results.h5", keeping({"nodes"}), "");
    std::string text;
    try {
      Steps steps(model, *history);
      steps.run(5000);
    } catch (const IoError& error) {
      text = error.what();
    }
    if (text.find("results.h5") == std::string::npos || text.find("No space left") == std::string::npos) return 2;
    history.reset();  // giving up is clean, and so is the end of the process
    const hid_t file = H5Fopen((folder / "results.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    const hid_t data = H5Dopen2(file, "/nodes/displacement", H5P_DEFAULT), space = H5Dget_space(data);
    hsize_t sizes[3] = {0, 0, 0};
    H5Sget_simple_extent_dims(space, sizes, nullptr);
    std::vector<double> values(sizes[0] * sizes[1] * sizes[2]);
    const bool readable = H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0;
    H5Sclose(space);
    H5Dclose(data);
    H5Fclose(file);
    return readable && sizes[0] > 100 ? 0 : 3;
  });
  if (status == not_allowed) {
    MESSAGE("skipped: this machine does not let a test mount a file system");
  } else {
    CHECK(status == 0);
  }
}

TEST_CASE("histories of all nodes cost a few microseconds a step") {
  const TemporaryFolder folder;
  const Model model = sample_pair();
  HistoryFile history(folder / "results.h5", keeping({"nodes"}), "");
  const State state = sample_state(model);
  State after = state;
  after.time = 1e-3;
  history.start(model, state);
  const int steps = 20000;
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < steps; ++i) history.step(state, after, {}, {});
  history.finish();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  MESSAGE("histories of " << model.nodes.size() << " nodes: " << 1e6 * seconds / steps << " us a step");
  CHECK(seconds / steps < 200e-6);  // loose: debug builds and busy machines run this too
}
