// Records of all formats as motions of a scene: values, and faults at the motion or in the record's line.
#include <doctest/doctest.h>

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
