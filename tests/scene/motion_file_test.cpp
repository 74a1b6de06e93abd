#include "scene/motion_file.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <numeric>

#include "scene_text.hpp"

using namespace nsframe;

namespace {

constexpr double g = 9.80665;  // [m/s2]

// What reading `text` gives: the record, or the message without the directory.
struct Reading {
  std::optional<Record> record;
  std::string error;
};

Reading read(const std::string& name, std::string_view text, std::optional<double> dt = {},
             std::optional<MotionUnit> unit = {}) {
  const test::TemporaryFolder directory;
  directory.write(name, text);
  MotionTable motion;
  motion.file = {name, {"s.toml", 7, 8}};
  motion.dt = dt;
  motion.unit = unit;
  Diagnostics diagnostics;
  Reading out{read_record(motion, directory.path(), diagnostics), ""};
  for (std::string message : diagnostics.messages()) {
    const std::string prefix = directory.path().string() + "/";
    for (std::size_t at = message.find(prefix); at != std::string::npos; at = message.find(prefix))
      message.erase(at, prefix.size());
    out.error += message;
  }
  return out;
}

Reading at2(std::string_view header, std::string_view values) {
  return read("a.at2", "PEER\nsome event\nACCELERATION TIME HISTORY IN UNITS OF G\n" + std::string(header) + "\n" +
                           std::string(values));
}

}  // namespace

TEST_CASE("an AT2 record is read with the usual variants of its header") {
  for (const char* header : {"NPTS=   3, DT=   .0100 SEC,   ", "NPTS= 3, DT= .01000 SEC", "npts=3,dt=0.01",
                             "    3    0.0100    NPTS, DT", "NPTS =  3 , DT =  1.0E-02 SEC"}) {
    CAPTURE(header);
    const Reading r = at2(header, "  .1000000E-02  -.2000000E+00\r\n   1\r\n");
    CHECK(r.error == "");
    REQUIRE(r.record);
    CHECK(r.record->dt == 0.01);
    CHECK(r.record->acceleration == std::vector<double>{0.001 * g, -0.2 * g, g});
  }
}

TEST_CASE("an AT2 record that holds fewer or more values than it says is an error") {
  CHECK(at2("NPTS= 3, DT= .01 SEC", "1 2\n").error == "a.at2:5:1: error: ends after 2 of NPTS = 3 values");
  CHECK(at2("NPTS= 3, DT= .01 SEC", "1 2\n3 4\n").error == "a.at2:6:3: error: more values than NPTS = 3");
}

TEST_CASE("an AT2 record with a bad header is an error") {
  CHECK(at2("NPTS= 0, DT= .01 SEC", "").error ==
        "a.at2:4:1: error: NPTS = 0, must be a whole number from 1 to 10000000");
  CHECK(at2("NPTS= 1e12, DT= .01 SEC", "1").error ==
        "a.at2:4:1: error: NPTS = 1000000000000, must be a whole number from 1 to 10000000");
  CHECK(at2("NPTS= 3, DT= -1 SEC", "").error == "a.at2:4:1: error: DT = -1, must be positive");
  CHECK(at2("NPTS= many", "").error == "a.at2:4:1: error: the header line with NPTS has no number of values and step");
  CHECK(read("a.at2", "only text\n").error == "a.at2:1:1: error: has no header line with NPTS and DT");
  CHECK(read("a.at2", "VELOCITY TIME HISTORY IN UNITS OF CM/S\nNPTS= 1, DT= 1\n1\n").error ==
        "a.at2:1:1: error: is not an acceleration record");
  CHECK(read("a.at2", "ACCELERATION IN UNITS OF CM/S/S\nNPTS= 1, DT= 1\n1\n").error ==
        "a.at2:1:1: error: an AT2 record is in units of g; give a plain text file with its unit instead");
}

TEST_CASE("what is no number in a record is an error with its place") {
  CHECK(at2("NPTS= 2, DT= .01", "1 x2\n").error == "a.at2:5:3: error: 'x2' is not a number");
  CHECK(at2("NPTS= 2, DT= .01", "1 2.5.1\n").error == "a.at2:5:3: error: '2.5.1' is not a number");
  CHECK(at2("NPTS= 2, DT= .01", "1 nan\n").error == "a.at2:5:3: error: 'nan' is not finite");
  CHECK(at2("NPTS= 2, DT= .01", "1 -inf\n").error == "a.at2:5:3: error: '-inf' is not finite");
  CHECK(at2("NPTS= 2, DT= .01", "1 0,25\n").error ==
        "a.at2:5:3: error: '0,25': write decimals with a point, and blanks between columns");
}

TEST_CASE("an empty or binary file is an error") {
  CHECK(read("a.at2", "").error == "a.at2:1:1: error: has no header line with NPTS and DT");
  CHECK(read("a.txt", "", 0.1, MotionUnit::g).error == "a.txt:1:1: error: holds no values");
  CHECK(read("a.txt", "# nothing\n\n", 0.1, MotionUnit::g).error == "a.txt:2:1: error: holds no values");
  CHECK(read("a.txt", std::string_view("1\n\0\1\2", 5), 0.1, MotionUnit::g).error ==
        "a.txt:2:1: error: is a binary file, not text");
  CHECK(read("a.txt", std::string(100000, '1'), 0.1, MotionUnit::g).error ==
        "a.txt:1:1: error: the line is longer than 65536 characters");
}

TEST_CASE("a record that isn't there is an error at the scene") {
  MotionTable motion;
  motion.file = {"none.at2", {"s.toml", 7, 8}};
  Diagnostics diagnostics;
  CHECK_FALSE(read_record(motion, "/nowhere", diagnostics));
  motion.file.name = "";
  motion.file.name = "..";  // a directory
  CHECK_FALSE(read_record(motion, "/", diagnostics));
  CHECK(diagnostics.messages() ==
        std::vector<std::string>{"s.toml:7:8: error: cannot open the record '/nowhere/none.at2'",
                                 "s.toml:7:8: error: cannot open the record '/..'"});
}

TEST_CASE("plain text has one column with dt from the scene, or time and acceleration") {
  const Reading one = read("a.txt", "# m/s2\n0.5\n\n-1\n", 0.02, MotionUnit::metres);
  CHECK(one.error == "");
  CHECK(one.record->dt == 0.02);
  CHECK(one.record->acceleration == std::vector<double>{0.5, -1});
  const Reading two = read("a.txt", "0.000 0.5\n0.005 1\n0.010 +2\n", {}, MotionUnit::g);
  CHECK(two.error == "");
  CHECK(two.record->dt == 0.005);
  CHECK(two.record->acceleration == std::vector<double>{0.5 * g, g, 2 * g});
}

TEST_CASE("plain text that leaves its step or unit open is an error") {
  CHECK(read("a.txt", "1\n2\n", {}, MotionUnit::g).error ==
        "s.toml:7:8: error: 'a.txt' has one column, its step dt must be given");
  CHECK(read("a.txt", "1\n2\n", 0.1).error ==
        "s.toml:7:8: error: 'a.txt' is plain text, its unit must be given (\"g\" or \"m/s2\")");
  CHECK(read("a.at2", "NPTS= 1, DT= .01\n1\n", 0.1).error ==
        "s.toml:7:8: error: 'a.at2' says its own step, dt must not be given");
  CHECK(read("a.at2", "NPTS= 1, DT= .01\n1\n", {}, MotionUnit::metres).error ==
        "s.toml:7:8: error: 'a.at2' is an AT2 record, in units of g");
}

TEST_CASE("times that don't rise from zero in equal steps are an error") {
  CHECK(read("a.txt", "0.1 1\n0.2 1\n", {}, MotionUnit::g).error ==
        "a.txt:1:1: error: the first time is 0.1, must be 0");
  CHECK(read("a.txt", "0 1\n0.1 1\n0.1 2\n", {}, MotionUnit::g).error == "a.txt:3:1: error: time 0.1 is not after 0.1");
  CHECK(read("a.txt", "0 1\n1 1\n3 2\n", {}, MotionUnit::g).error ==
        "a.txt:3:1: error: the step to time 3 is 2, not 1 as before");
  CHECK(read("a.txt", "0 1\n1 1\n", 0.5, MotionUnit::g).error ==
        "a.txt:2:1: error: the step is 1 s, the scene says dt = 0.5 s");
  CHECK(read("a.txt", "0 1\n", {}, MotionUnit::g).error ==
        "a.txt:1:1: error: one row of time and acceleration gives no step");
  CHECK(read("a.txt", "0 1\n1\n", {}, MotionUnit::g).error == "a.txt:2:1: error: 1 columns, must be 2 as before");
  CHECK(read("a.txt", "0 1 2\n", {}, MotionUnit::g).error == "a.txt:1:1: error: 3 columns, must be 1 or 2");
}

TEST_CASE("the record that ships with the program starts with the zero at t = 0") {
  MotionTable motion;
  motion.file.name = "el_centro_1940_ns.at2";
  Diagnostics diagnostics;
  const auto record = read_record(motion, NSFRAME_SOURCE_DIR "/examples/motions", diagnostics);
  REQUIRE(record);
  CHECK(record->dt == 0.02);
  REQUIRE(record->acceleration.size() == 1560);
  CHECK(record->acceleration[0] == 0);
  CHECK(record->acceleration[1] == 0.0063 * g);
  double peak = 0;
  for (const double a : record->acceleration) peak = std::max(peak, std::abs(a));
  CHECK(peak == doctest::Approx(0.3188 * g).epsilon(2e-4));  // four digits printed
  CHECK(std::abs(record->acceleration[102]) == peak);        // t = 2.04 s
}

TEST_CASE("records of the usual archives are read with their length, step and peak") {
  const char* directory = std::getenv("NSFRAME_RECORDS");
  if (!directory) {
    MESSAGE("skipped: the environment variable NSFRAME_RECORDS doesn't name a directory of records");
    return;
  }
  struct Expected {
    const char* file;
    std::size_t count;
    double dt, pga;  // [s], [g], four digits
  };
  for (const Expected& expected : {Expected{"el_centro_1940_180_peknold.at2", 1559, 0.02, 0.3188},
                                   Expected{"RSN6_IMPVALL_ELC180.AT2", 5372, 0.01, 0.2808},
                                   Expected{"RSN6_IMPVALL_ELC270.AT2", 5346, 0.01, 0.2107},
                                   Expected{"northridge_1994_castaic_090.at2", 3989, 0.01, 0.5683},
                                   Expected{"northridge_1994_arleta_360.at2", 2000, 0.02, 0.3081},
                                   Expected{"kobe_1995_takatori_000.at2", 4096, 0.01, 0.6177}}) {
    CAPTURE(expected.file);
    MotionTable motion;
    motion.file.name = expected.file;
    Diagnostics diagnostics;
    const auto record = read_record(motion, directory, diagnostics);
    CHECK(diagnostics.messages().empty());
    REQUIRE(record);
    CHECK(record->acceleration.size() == expected.count);
    CHECK(record->dt == expected.dt);
    double peak = 0;
    for (const double a : record->acceleration) peak = std::max(peak, std::abs(a));
    CHECK(peak / g == doctest::Approx(expected.pga).epsilon(5e-4));
  }
}
