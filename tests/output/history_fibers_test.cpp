// /fibers of results.h5 against the laws run by hand over the recorded section deformations.
#include <doctest/doctest.h>

#include <set>

#include "base/errors.hpp"
#include "integrators/simulation.hpp"
#include "models/fiber_selection.hpp"
#include "output/history_file.hpp"
#include "tests/support/files.hpp"
#include "tests/support/hdf5_reader.hpp"
#include "tests/verification/two_story_model.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

void write_history(const std::vector<std::string>& overrides, const std::filesystem::path& path) {
  const Scene scene = example_scene("two_story", overrides);
  const Model model = model_of(scene);
  Simulation simulation(model, scene.analysis);
  HistoryFile history(path, scene.output, "");
  REQUIRE(simulation.run({&history}).halved_steps == 0);  // else the histories committed in between are not in the file
}

// Strain and stress of each fiber of the file from the section deformations there, by S235 of the scene on its own.
void check_by_hand(const Hdf5Reader& file, const std::string& kind, bool expect_yielding) {
  const auto read = [&](const std::string& name) { return file.numbers(("/" + name).c_str()); };
  const auto element = file.texts(("/fibers/" + kind + "/element").c_str());
  const auto section_element = file.texts(("/sections/" + kind + "/element").c_str());
  const auto position = read("fibers/" + kind + "/position"), section_position = read("sections/" + kind + "/position");
  const auto y = read("fibers/" + kind + "/y"), z = read("fibers/" + kind + "/z"), area = read("fibers/" + kind + "/area");
  const auto strain = read("fibers/" + kind + "/strain"), stress = read("fibers/" + kind + "/stress"), yielded = read("fibers/" + kind + "/yielded");
  const auto deformation = read("sections/" + kind + "/deformation"), force = read("sections/" + kind + "/force");
  const UniaxialLaw law = Steel02{235e6, 210e9, 0.01};
  const std::size_t rows = file.shape("/time")[0], fibers = y.size(), sections = section_position.size();
  double strain_error = 0, stress_error = 0, most_yielded = 0, force_error = 0;
  std::vector<double> sums(3 * sections * rows, 0.0);
  std::set<std::size_t> found;
  for (std::size_t f = 0; f < fibers; ++f) {
    std::size_t s = 0;
    while (section_element[s] != element[f] || section_position[s] != position[f]) REQUIRE(++s < sections);
    found.insert(s);
    std::vector<double> committed(static_cast<std::size_t>(history_size(law))), trial(committed);
    initialize_history(law, committed.data());
    for (std::size_t row = 0; row < rows; ++row) {
      const double* e = &deformation[3 * (row * sections + s)];
      const double by_hand = e[0] - y[f] * e[1] + z[f] * e[2];
      const double stress_by_hand = respond(law, by_hand, committed.data(), trial.data()).stress;
      std::swap(committed, trial);
      const std::size_t at = row * fibers + f;
      strain_error = std::max(strain_error, std::abs(strain[at] - by_hand));
      stress_error = std::max(stress_error, std::abs(stress[at] - stress_by_hand));
      const double plastic = std::abs(by_hand - stress_by_hand / 210e9) / (235e6 / 210e9);
      if (std::abs(plastic - 0.1) > 1e-9) CHECK(yielded[at] == (plastic > 0.1 ? 1.0 : 0.0));
      most_yielded = std::max(most_yielded, yielded[at]);
      double* sum = &sums[3 * (row * sections + s)];
      for (const auto& [k, lever] : {std::pair{0, 1.0}, {1, -y[f]}, {2, z[f]}}) sum[k] += stress[at] * area[f] * lever;
    }
  }
  for (const std::size_t s : found) {
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t at = 3 * (row * sections + s) + k;
        force_error = std::max(force_error, std::abs(sums[at] - force[at]));
      }
    }
  }
  CHECK(strain_error < 1e-16 * 4);     // rounding of strains of about 1e-3
  CHECK(stress_error < 1e-10 * 235e6);  // rounding of powers, over the steps
  CHECK(force_error < 1e-10 * 5e5);    // [N, N m] of the squash load
  CHECK(most_yielded == (expect_yielding ? 1 : 0));
}

}  // namespace

TEST_CASE("stresses of the fibers kept are those of the law run by hand over the strains kept") {
  for (const std::string kind : {"force-based", "displacement"}) {
    CAPTURE(kind);
    const TemporaryFolder folder;
    write_history({"analysis.duration=3 s", "motion.pga=0.5 g", "output.history=[\"sections\", \"fibers\"]",
                   "output.fibers=[\"left.1\", \"right.2:5\"]", "structure.left.columns.element=" + kind,
                   "structure.right.columns.element=" + kind},
                  folder / "results.h5");
    const Hdf5Reader file(folder / "results.h5");
    const std::string group = kind == "displacement" ? "displacement_beam" : "force_beam";
    check_by_hand(file, group, true);
    const auto element = file.texts(("/fibers/" + group + "/element").c_str());
    const auto point = file.numbers(("/fibers/" + group + "/point").c_str());
    CHECK(element.front() == "left.1");
    CHECK(element.back() == "right.2");
    const auto alone = static_cast<std::size_t>(std::count(element.begin(), element.end(), "right.2"));
    CHECK(element.size() == 6 * alone);  // five points of one element, one of the other: both shapes have the same mesh
    CHECK(std::count(point.begin(), point.end(), 5.0) == static_cast<long>(2 * alone));
    CHECK(file.texts(("/fibers/" + group + "/material").c_str())[3] == "S235");
    CHECK(file.units(("/fibers/" + group + "/stress").c_str()) == "Pa");
    CHECK(file.units(("/fibers/" + group + "/strain").c_str()) == "1");
    CHECK(file.units(("/fibers/" + group + "/area").c_str()) == "m2");
  }
}

TEST_CASE("without a choice the fibers of all elements are kept, and none when fibers are not asked for") {
  const TemporaryFolder folder;
  write_history({"analysis.duration=0.01 s", "output.history=[\"sections\", \"fibers\"]"}, folder / "all.h5");
  const Hdf5Reader all(folder / "all.h5");
  check_by_hand(all, "force_beam", false);
  CHECK(all.shape("/fibers/force_beam/strain") == std::vector<hsize_t>{11, all.numbers("/fibers/force_beam/y").size()});
  const Scene scene = example_scene("two_story");
  const Model model = model_of(scene);
  const System system(model, 1);
  CHECK(all.numbers("/fibers/force_beam/y").size() == static_cast<std::size_t>(system.assembler.fibers()));
  write_history({"analysis.duration=0.01 s", "output.history=[\"nodes\"]"}, folder / "none.h5");
  CHECK_FALSE(Hdf5Reader(folder / "none.h5").has("/fibers"));
}

TEST_CASE("a chosen element that does not exist, has no fibers or lacks the point is a fault with its name") {
  const Model model = model_of(example_scene("two_story"));
  std::string beam;
  for (const auto& group : model.groups) {
    if (group->kind() == "elastic_beam") beam = group->id(0);
  }
  std::vector<std::string> faults;
  const auto chosen = choose_fibers(model, {"left.1:3", "left.9999", beam, "left.1:6", "left.1:0", "left.1:x"}, faults);
  REQUIRE(chosen.size() == 1);
  CHECK(model.groups[chosen[0].group]->id(chosen[0].element) == "left.1");
  CHECK(chosen[0].point == 2);
  REQUIRE(faults.size() == 5);
  CHECK(faults[0].starts_with("there is no element 'left.9999'; "));
  CHECK(faults[1] == "element '" + beam + "' has no fibers");
  CHECK(faults[2] == "element 'left.1' has integration points 1 to 5, not 6");
  CHECK(faults[3] == "element 'left.1' has integration points 1 to 5, not 0");
  CHECK(faults[4].starts_with("there is no element 'left.1:x'; "));

  const TemporaryFolder folder;
  Scene scene = example_scene("two_story", {"output.history=[\"fibers\"]", "output.fibers=[\"left.1:6\"]"});
  HistoryFile history(folder / "results.h5", scene.output, "");
  Simulation simulation(model, scene.analysis);
  CHECK_THROWS_WITH_AS(history.start(model, simulation.state()),
                       "output.fibers: element 'left.1' has integration points 1 to 5, not 6", InputError);
  CHECK_FALSE(std::filesystem::exists(folder / "results.h5"));
}
