#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "base/errors.hpp"
#include "output/files.hpp"
#include "output/numerical_warnings.hpp"
#include "output/poundings.hpp"
#include "output/summary.hpp"
#include "tests/output/sample_pair.hpp"
#include "tests/support/files.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

Impact impact_at(double time, int pair, double approach, double impulse, double rate_after) {
  return {time, pair, approach, impulse, -approach, rate_after};
}

Summary sample_summary() {
  Summary summary;
  summary.title = "Two frames";
  summary.scheme = "moreau-jean";
  summary.dt = 1e-3;
  summary.theta = 1;
  summary.duration = summary.end_time = 20;
  summary.steps = 20000;
  summary.dofs = 96;
  summary.structures = {"left", "right"};
  summary.frequencies = {{2.6, 7.5}, {3.4, 9.9}};
  summary.modes = {{"right", "L1", 3.5, 0.006, 0.017, 3.49}, {"right", "L2", 6.55, 0.002, 0.023, 6.53}};
  summary.pairs = {"left.11-right.12", "left.14-right.13 with a name that is much longer than any column of the table"};
  for (int i = 0; i < 30; ++i) summary.impacts.push_back(impact_at(0.1 * i, i % 2, 0.4, 120, 0.24));
  summary.poundings = merge_impacts(summary.impacts);
  Peak peak;
  peak.node = "left.21";
  peak.displacement = Vector3(0.0512, -0.001, 0.0001);
  peak.twist = 0.003;
  summary.peaks = {peak};
  summary.floor_spectra = {{"left.21", 0, 5.0, 14.7, 0.3, 0.9, 0.5}, {"left.21", 2, 5.0, 1e-9, 0.02, 1e-10, 0.02}};
  summary.floor_spectra_damping = 0.05;
  summary.energy.input = 1200;
  summary.energy.kinetic = 200;
  summary.energy.strain = 1000.001;
  summary.newton_iterations = 20000;
  summary.warnings = numerical_warnings(summary);
  return summary;
}

}  // namespace

TEST_CASE("impacts of one pair closer than 20 ms are one pounding, of another pair they are not") {
  const std::vector<Impact> impacts{impact_at(1.000, 0, 0.5, 10, 0.1), impact_at(1.005, 1, 0.3, 7, 0.2),
                                    impact_at(1.015, 0, 0.2, 5, 0.05), impact_at(1.030, 0, 0.1, 1, 0.3),
                                    impact_at(1.051, 0, 0.4, 2, 0.24)};
  const auto poundings = merge_impacts(impacts);
  REQUIRE(poundings.size() == 3);
  CHECK(poundings[0].time == 1.000);
  CHECK(poundings[0].duration == doctest::Approx(0.030));
  CHECK(poundings[0].impulse == 16);
  CHECK(poundings[0].impacts == 3);
  CHECK(poundings[0].approach_velocity == 0.5);
  CHECK(poundings[0].effective_restitution == doctest::Approx(0.6));
  CHECK(poundings[1].pair == 1);
  CHECK(poundings[1].duration == 0);
  CHECK(poundings[2].time == 1.051);
  CHECK(poundings[2].effective_restitution == doctest::Approx(0.6));
}

TEST_CASE("a contact with a law of force is a pounding from its begin to its end, in the order of begins") {
  Impact long_contact = impact_at(1.3, 0, 0.5, 10, 0.3), within = impact_at(1.2, 1, 0.4, 7, 0.2), next = impact_at(1.33, 0, 0.2, 3, 0.1);
  long_contact.duration = 0.2;
  within.duration = 0.05;
  next.duration = 0.015;  // begins 15 ms after the end
  const auto poundings = merge_impacts({within, long_contact, next});
  REQUIRE(poundings.size() == 2);
  CHECK(poundings[0].pair == 0);
  CHECK(poundings[0].time == doctest::Approx(1.1));
  CHECK(poundings[0].duration == doctest::Approx(0.23));
  CHECK(poundings[0].impulse == 13);
  CHECK(poundings[0].effective_restitution == doctest::Approx(0.2));
  CHECK(poundings[1].time == doctest::Approx(1.15));
}

TEST_CASE("a pounding that starts from resting contact has no restitution") {
  const auto poundings = merge_impacts({impact_at(0.5, 0, 0, 3, 0), impact_at(1, 0, 0.4, 3, 0.2), impact_at(2, 0, 1.8e-17, 3, -1.4e-17)});
  REQUIRE(poundings.size() == 3);
  CHECK(poundings[0].effective_restitution == 0);
  CHECK(poundings[1].effective_restitution == 0.5);
  CHECK(poundings[2].effective_restitution == 0);  // rounding at rest is no approach
}

TEST_CASE("the summary file has every key of the contract and the numbers of the run") {
  const TemporaryFolder folder;
  const Summary summary = sample_summary();
  write_summary(summary, folder / "summary.json");
  const auto json = nlohmann::json::parse(file_text(folder / "summary.json"));
  for (const char* key :
       {"scheme", "dt", "steps", "dofs", "frequencies", "impacts", "poundings", "peaks", "drifts", "floor_spectra", "energy", "numerical_damping",
        "max_penetration", "newton_iterations", "savings", "timing", "warnings", "completed", "stop_reason", "title"}) {
    CHECK_MESSAGE(json.contains(key), key);
  }
  CHECK(json["impacts"].size() == 30);
  CHECK(json["impacts"][0]["pair"] == "left.11-right.12");
  CHECK(json["impacts"][1]["t"].get<double>() == 0.1);
  CHECK(json["poundings"][0]["effective_restitution"].get<double>() == doctest::Approx(0.6));
  CHECK(json["frequencies"][1][0] == 3.4);
  CHECK(json["energy"]["balance_error"].get<double>() == doctest::Approx(0.001));
  CHECK(json["numerical_damping"][1]["added"].get<double>() == doctest::Approx(0.021));
  CHECK(json["peaks"][0]["displacement"][0] == 0.0512);
  CHECK(json["floor_spectra"].size() == 2);
  CHECK(json["floor_spectra"][0]["node"] == "left.21");
  CHECK(json["floor_spectra"][0]["direction"] == "x");
  CHECK(json["floor_spectra"][0]["psa"] == 14.7);
  CHECK(json["floor_spectra"][0]["psa_period"] == 0.3);
  CHECK(json["floor_spectra"][0]["psv"] == 0.9);
  CHECK(json["floor_spectra"][0]["psv_period"] == 0.5);
  CHECK(json["floor_spectra"][0]["damping"] == 0.05);
  CHECK(json["timing"].contains("step_loop"));
  CHECK_FALSE(std::filesystem::exists(folder / "summary.json.partial"));
}

TEST_CASE("the summary of a run that blew up is still valid JSON") {
  Summary summary = sample_summary();
  summary.energy.kinetic = std::nan("");
  summary.title = "not UTF-8: \xff";
  CHECK(nlohmann::json::parse(summary_json(summary))["energy"]["kinetic"].is_null());
}

TEST_CASE("the scheme's own damping is named where it drowns what the scene asks for") {
  const auto warnings = numerical_warnings(sample_summary());
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0] ==
        "theta = 1 at dt = 1 ms adds damping of its own: 1.1 % to L1 of 'right' (0.6 % asked), 2.1 % to L2 of 'right' "
        "(0.2 % asked): impacts may be missed; theta = 0.5 adds none");
}

TEST_CASE("warnings and table name the modes that matter: damped by the scene, or with mass below 30 Hz") {
  Summary summary = sample_summary();
  summary.modes.push_back({"left", "L1", 2.1, 1e-30, 0.0066, 2.1, 0.9});   // no damping asked, most of the mass
  summary.modes.push_back({"left", "T1", 6.1, 1e-30, 0.019, 6.1, 0.95});   // more mass, but not the lowest main mode
  summary.modes.push_back({"left", "R1", 8.6, 1e-30, 0.027, 8.6, 0.001});  // hardly any mass
  summary.modes.push_back({"left", "V1", 39, 1e-30, 0.12, 39, 0.95});      // too fast to matter
  CHECK(modes_that_matter(summary).size() == 4);
  const auto warnings = numerical_warnings(summary);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0] ==
        "theta = 1 at dt = 1 ms adds damping of its own: 1.1 % to L1 of 'right' (0.6 % asked), 0.7 % to L1 of 'left' (none "
        "asked), 1.9 % to T1 of 'left' (none asked), and too much to 1 other mode: impacts may be missed; theta = 0.5 adds none");
  const std::string text = summary_text(summary);
  CHECK(text.find("V1") == std::string::npos);
  CHECK(text.find("... and 2 modes of less mass or without damping of the scene") != std::string::npos);
  CHECK(nlohmann::json::parse(summary_json(summary))["numerical_damping"][2]["asked"] == 0.0);
  summary.modes[1].complex_frequency = 5.9;
  summary.modes[1].complex_damping = 0.12;
  const nlohmann::json modes = nlohmann::json::parse(summary_json(summary))["numerical_damping"];
  CHECK(modes[1]["complex_damping"] == 0.12);
  CHECK(modes[1]["complex_frequency"] == 5.9);
  CHECK(!modes[0].contains("complex_damping"));
}

TEST_CASE("the table of peaks has one row a level, the roof first, and leaves out what stands still") {
  Summary summary = sample_summary();
  summary.peaks.clear();
  const auto add = [&](const char* node, double level, double x) {
    Peak peak;
    peak.node = node;
    peak.level = level;
    peak.displacement.x() = x;
    summary.peaks.push_back(peak);
  };
  add("left.1", 0, 0);
  add("left.11", 2.5, 0.03);
  add("left.21", 5, 0.05);
  add("left.22", 5, 0.06);
  add("right.11", 2.5, 0.07);
  const std::string text = summary_text(summary);
  const auto roof = text.find("left.22 "), floor = text.find("left.11 "), other = text.find("right.11 ");
  CHECK(roof < floor);
  CHECK(floor < other);
  CHECK(other != std::string::npos);
  CHECK(text.find("left.21 ") > text.find("Largest values of the floor spectra"));
  CHECK(text.find("left.1 ") == std::string::npos);
  CHECK(nlohmann::json::parse(summary_json(summary))["peaks"].size() == 5);
}

TEST_CASE("drifts are in the summary file as ratios and in the table in percent") {
  Summary summary = sample_summary();
  summary.drifts = {{"left", 1, 0, 2.5, Vector2(0.0123, 0.0004)}, {"left", 2, 2.5, 5, Vector2(0.02, 0.001)}};
  const auto json = nlohmann::json::parse(summary_json(summary));
  REQUIRE(json["drifts"].size() == 2);
  CHECK(json["drifts"][0]["structure"] == "left");
  CHECK(json["drifts"][1]["story"] == 2);
  CHECK(json["drifts"][0]["drift"][0] == 0.0123);
  CHECK(summary_text(summary).find("1.230") != std::string::npos);
}

TEST_CASE("a scheme that adds no damping and no shift gives no warning") {
  Summary summary = sample_summary();
  for (auto& mode : summary.modes) {
    mode.damping_effective = mode.damping_asked;
    mode.frequency_effective = mode.frequency;
  }
  CHECK(numerical_warnings(summary).empty());
}

TEST_CASE("modes that nonlinear elements see at rest are told where they are heavy, those left out stand so in the table") {
  Summary summary = sample_summary();
  for (auto& mode : summary.modes) {
    mode.damping_effective = mode.damping_asked;
    mode.frequency_effective = mode.frequency;
  }
  summary.modes.push_back({"left", "V1", 39, 0.02, 0.02, 39, 0.95});
  summary.modes.push_back({"left", "V2", 103, 0.02, 0.02, 103, 0.05});
  summary.dt = 1e-2;
  CHECK(numerical_warnings(summary).empty());
  summary.resting_frequency = 48;
  CHECK(numerical_warnings(summary).empty());  // V2 is light
  summary.dt = 2e-2;
  summary.resting_frequency = 24;
  const auto warnings = numerical_warnings(summary);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0] == "dt = 20 ms is too long for nonlinear elements to see mode V1 of 'left' (39 Hz) swing: they see it where it would rest; a smaller step, or "
                       "accuracy, shows it");
  summary.left_out_modes = 1;
  summary.modes.back().frequency_effective = 0;
  const std::string text = summary_text(summary);
  CHECK(text.find("left out") != std::string::npos);
  CHECK(text.find(", 1 mode left out, ") != std::string::npos);
}

TEST_CASE("the terminal table stays within 100 columns and lists at most 20 poundings") {
  const std::string text = summary_text(sample_summary());
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) CHECK_MESSAGE(line.size() <= 100, line);
  CHECK(text.find("... and 10 more") != std::string::npos);
  CHECK(text.find("impacts may be missed") != std::string::npos);
}

TEST_CASE("a summary that cannot be written says which file and why") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(write_summary(sample_summary(), folder / "missing/summary.json"), IoError);
  try {
    write_text_file("/dev/full/x", "text");
    FAIL("expected an IoError");
  } catch (const IoError& error) {
    CHECK(std::string(error.what()).find("/dev/full/x") != std::string::npos);
  }
  write_text_file(folder / "file", "text");
  CHECK_THROWS_AS(make_folder(folder / "file/below"), IoError);
  CHECK_THROWS_AS(make_folder(folder / "file"), IoError);
}
