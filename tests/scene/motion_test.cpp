// Records of all formats as motions of a scene: values, and faults at the motion or in the record's line.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cmath>

#include "scene_text.hpp"

using namespace nsframe;

namespace {

const std::string samples = NSFRAME_SOURCE_DIR "/tests/motion/samples/";

std::string motion(const std::string& file, const std::string& keys = "") {
  return "[structure.s]\nnodes = [[1, 0, 0, 0]]\n[motion]\nfile = \"" + file + "\"\n" + keys;
}

}  // namespace

TEST_CASE("a motion of a scene may be a record of any format") {
  const Scene shipped = test::scene(motion(NSFRAME_SOURCE_DIR "/examples/motions/el_centro_1940_ns.at2"));
  for (const auto& [file, keys] : {std::pair{"el_centro.V2", ""},
                                   {"el_centro.esm.asc", ""},
                                   {"el_centro.NS", ""},
                                   {"el_centro.csv", ""},
                                   {"el_centro.txt", "dt = \"20 ms\"\n"},
                                   {"el_centro.V2c", "channel = 1\nformat = \"cosmos\"\n"}}) {
    CAPTURE(file);
    const Scene scene = test::scene(motion(samples + file, keys));
    REQUIRE(scene.model.motions.size() == 1);
    REQUIRE(scene.model.motions[0].acceleration.size() == 400);
    CHECK(scene.model.motions[0].dt == doctest::Approx(0.02).epsilon(1e-12));
    // t = 2.04 s; K-NET's mean of 0.015 m/s2 is off
    CHECK(scene.model.motions[0].acceleration[102] ==
          doctest::Approx(shipped.model.motions[0].acceleration[102]).epsilon(0.006));
  }
}

TEST_CASE("faults of a record are reported at its line, what the scene says wrongly of it at the scene's") {
  CHECK(test::error(motion(samples + "el_centro.txt")) ==
        "s.toml:4:8: error: 'el_centro.txt' (plain text or CSV) doesn't say its step, which must be given: dt = "
        "\"...\" in a scene, --dt on "
        "the command line");
  CHECK(test::error(motion(samples + "el_centro.csv", "unit = \"g\"\n")) ==
        "s.toml:4:8: error: 'el_centro.csv' (plain text or CSV) is in units of cm/s2, not g");
  CHECK(test::error(motion(samples + "el_centro.V2c", "channel = 3\n")) ==
        samples + "el_centro.V2c:352:1: error: holds 2 channels of acceleration, not 3");
  CHECK(test::error(motion(samples + "el_centro.csv", "format = \"esn\"\n")) ==
        "s.toml:4:8: error: format 'esn' is not known; did you mean 'esm'?");
  CHECK(test::error(motion("/nowhere/x.at2")) == "s.toml:4:8: error: cannot open the record '/nowhere/x.at2'");
  CHECK(test::error(motion(samples + "el_centro.csv", "unit = \"m/s\"\n")).find("unit") != std::string::npos);
}

TEST_CASE("a motion may move supports, as a wave that reaches them, later, and be given as displacements") {
  const std::string record = samples + "el_centro.csv";
  const Scene wave = test::scene(motion(record, "supports = [\"s.1\"]\nwave = { direction = \"y\", velocity = \"250 m/s\" }\ndelay = \"50 ms\"\n"));
  const MotionDescription& m = wave.model.motions.at(0);
  REQUIRE(m.wave);
  CHECK(m.wave->velocity == 250);
  CHECK(m.wave->direction == Vector3::UnitY());
  CHECK(m.delay == 0.05);
  REQUIRE(m.supports.size() == 1);
  CHECK(m.supports[0].name == "s.1");

  // a cubic spline through displacements: their exact double integral is given back at every sample, and rest at both ends
  const test::TemporaryFolder folder;
  std::string text;
  const auto u = [](int i) { return i <= 80 ? std::pow(std::sin(pi * i / 80), 2) + 0.25 * (1 - std::cos(pi * i / 80)) : 0.5; };
  for (int i = 0; i <= 100; ++i) text += fmt::format("{:.15g}\n", u(i));
  folder.write("u.txt", text);
  const Scene moved = test::scene(motion((folder / "u.txt").string(), "dt = \"10 ms\"\nquantity = \"displacement\"\nfactor = \"2 cm\"\n"));
  GroundMotion spline;
  spline.dt = moved.model.motions.at(0).dt;
  spline.acceleration = moved.model.motions.at(0).acceleration;
  spline.prepare();
  REQUIRE(spline.displacement.size() == 101);
  for (int i = 0; i <= 100; ++i) CHECK(spline.displacement[static_cast<std::size_t>(i)] == doctest::Approx(0.02 * u(i)).epsilon(1e-11));
  CHECK(std::abs(spline.velocity.back()) < 1e-12);
  CHECK(spline.velocity[30] == doctest::Approx(0.02 / 0.8 * (pi * std::sin(2 * pi * 30 / 80) + 0.25 * pi * std::sin(pi * 30 / 80))).epsilon(1e-5));

  CHECK(test::error(motion((folder / "u.txt").string(), "dt = \"10 ms\"\nquantity = \"displacement\"\npga = \"1 m/s2\"\n")) ==
        "s.toml:7:7: error: displacements have no pga; scale them by factor");
  CHECK(test::error(motion((folder / "u.txt").string(), "dt = \"10 ms\"\nquantity = \"displacement\"\nunit = \"g\"\n")) ==
        "s.toml:7:8: error: units of displacements are in factor, e.g. factor = \"1 cm\"");
  folder.write("v.txt", "1\n2\n1\n0\n0\n");
  CHECK(test::error(motion((folder / "v.txt").string(), "dt = \"10 ms\"\nquantity = \"displacement\"\nfactor = \"1 cm\"\n")).find("must begin at zero") !=
        std::string::npos);
  CHECK(test::error(motion(record, "wave = { direction = \"y\", velocity = \"-250 m/s\" }\n")).find("velocity") != std::string::npos);
}
