#include "motion/record.hpp"

#include <doctest/doctest.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <istream>
#include <streambuf>

#include "motion/formats.hpp"
#include "tests/support/files.hpp"

using namespace nsframe;

namespace {

constexpr double g = 9.80665;  // [m/s2]
const std::string samples = NSFRAME_SOURCE_DIR "/tests/motion/samples";
const std::string shipped = NSFRAME_SOURCE_DIR "/examples/motions/el_centro_1940_ns.at2";
const ReadOptions in_g{0.1, AccelerationUnit::g, {}, ""};

// What reading `text` gives: the record, or the message without the directory.
struct Reading {
  std::optional<Record> record;
  std::string error;
};

Reading read(const std::string& name, std::string_view text, const ReadOptions& options = {}) {
  const test::TemporaryFolder directory;
  const std::filesystem::path file = directory.write(name, text);
  try {
    return {read_record(file, options), ""};
  } catch (const RecordError& fault) {
    std::string message = fault.what();
    const std::string prefix = directory.path().string() + "/";
    if (message.starts_with(prefix)) message.erase(0, prefix.size());
    return {std::nullopt, message};
  }
}

std::string errors_of(const std::filesystem::path& file, const ReadOptions& options = in_g) {
  try {
    read_record(file, options);
    return "no error";
  } catch (const RecordError& fault) {
    return fault.what();
  }
}

// A stream of "1.5\n" without end.
class Endless : public std::streambuf {
 public:
  Endless() {
    for (int i = 0; i < 1024; ++i) text_ += "1.5\n";
  }

 private:
  int_type underflow() override {
    setg(text_.data(), text_.data(), text_.data() + text_.size());
    return traits_type::to_int_type(*gptr());
  }
  std::string text_;
};

// Largest resident memory of this process so far [kB].
long peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
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
  CHECK(at2("NPTS= 2, DT= .01", "1 1e999\n").error == "a.at2:5:3: error: '1e999' is out of the range of numbers");
  CHECK(at2("NPTS= 2, DT= .01", "1 0,25\n").error ==
        "a.at2:5:3: error: '0,25': write decimals with a point, and blanks between columns");
}

TEST_CASE("an empty or binary file is an error") {
  CHECK(read("a.at2", "").error == "a.at2:1:1: error: has no header line with NPTS and DT");
  CHECK(read("a.txt", "", in_g).error == "a.txt:1:1: error: holds no values");
  CHECK(read("a.txt", "# nothing\n\n", in_g).error == "a.txt:2:1: error: holds no values");
  CHECK(read("a.txt", std::string_view("1\n\0\1\2", 5), in_g).error == "a.txt:2:1: error: is a binary file, not text");
  CHECK(read("a.txt", std::string(100000, '1'), in_g).error ==
        "a.txt:1:1: error: the line is longer than 65536 characters");
  CHECK_THROWS_AS(read_record("/nowhere/none.at2"), IoError);
  CHECK_THROWS_AS(read_record("/"), IoError);  // a directory
}

TEST_CASE("a file of a gigabyte ends in an error, in bounded memory") {
  const test::TemporaryFolder directory;
  const std::filesystem::path file = directory.write("a.txt", "");
  std::filesystem::resize_file(file, std::uintmax_t{1} << 30);  // sparse: zeros that take no place on the disk
  CHECK(errors_of(file).find("a.txt:1:1: error: is a binary file") != std::string::npos);
  // a line of digits and no end before the zeros, and values without end: the same reader reads what a stream brings
  {
    std::ofstream stream(file, std::ios::binary | std::ios::in);
    stream << "0.5\n" << std::string(70000, '7');
  }
  CHECK(errors_of(file).find("a.txt:2:1: error: the line is longer than 65536") != std::string::npos);
  const long before = peak_memory();
  Endless endless;
  std::istream stream(&endless);
  LineReader lines(stream);
  try {
    plain_text.read(lines, in_g);
    FAIL("values without end were read");
  } catch (const RecordFault& fault) {
    CHECK(fault.line == static_cast<int>(max_record_samples) + 1);
    CHECK(fault.text == "more than 10000000 values");
  }
  CHECK(peak_memory() - before < 600000);  // [kB]: 80 MB of values, and what was freed while the array grew
}

TEST_CASE("plain text has one column with dt from outside or from a comment, or time and acceleration") {
  const Reading one = read("a.txt", "# m/s2\n0.5\n\n-1\n", {0.02, AccelerationUnit::metres, {}, ""});
  CHECK(one.error == "");
  CHECK(one.record->dt == 0.02);
  CHECK(one.record->acceleration == std::vector<double>{0.5, -1});
  const Reading two = read("a.txt", "0.000 0.5\n0.005 1\n0.010 +2\n", {{}, AccelerationUnit::g, {}, ""});
  CHECK(two.error == "");
  CHECK(two.record->dt == 0.005);
  CHECK(two.record->acceleration == std::vector<double>{0.5 * g, g, 2 * g});
  const Reading says = read("a.txt", "# unit: cm/s^2\n# the dt = 0.01\n100\n-50.0\n");
  CHECK(says.error == "");
  CHECK(says.record->dt == 0.01);
  CHECK(says.record->acceleration == std::vector<double>{1, -0.5});
}

TEST_CASE("CSV is separated by commas or semicolons, and its heading may say the unit") {
  for (const char* text : {"time [s], acceleration [m/s2]\n0,0.5\n0.1,-1\n", "t (s);a (m/s^2)\n0;0.5\n0.1;-1\n",
                           "0.0 , 0.5\n0.1 , -1\n", "\"t\",\"a\"\n0,0.5\n0.1,-1\n"}) {
    CAPTURE(text);
    const Reading r = read("a.csv", text, {{}, AccelerationUnit::metres, {}, ""});
    CHECK(r.error == "");
    REQUIRE(r.record);
    CHECK(r.record->dt == 0.1);
    CHECK(r.record->acceleration == std::vector<double>{0.5, -1});
  }
  CHECK(read("a.csv", "t [s],a [g]\n0,1.0\n1,1\n", {{}, AccelerationUnit::metres, {}, ""}).error ==
        "error: 'a.csv' (plain text or CSV) is in units of g, not m/s2");
  CHECK(read("a.csv", "t [ms],a [g]\n0,1.0\n1,1\n").error == "a.csv:1:1: error: times must be in s, not 'ms'");
  CHECK(read("a.csv", "t [s],v [cm/s]\n0,1.0\n1,1\n").error ==
        "a.csv:1:1: error: 'cm/s' is no unit of acceleration; known: g, m/s2, cm/s2, mm/s2, in/s2, ft/s2");
}

TEST_CASE("decimal commas are found out, not read as columns") {
  const ReadOptions two{{}, AccelerationUnit::g, {}, ""};
  CHECK(read("a.txt", "0,00 0,5\n0,01 0,7\n", two).error ==
        "a.txt:1:1: error: '0,00': write decimals with a point, and blanks between columns");
  CHECK(read("a.csv", "0,00;0,5\n0,01;0,7\n", two).error ==
        "a.csv:1:1: error: '0,00': write decimals with a point, and blanks between columns");
  CHECK(read("a.csv", "0,5\n0,7\n", in_g).error ==
        "a.csv:2:1: error: time 0 is not after 0 (are these decimal commas? write points)");
  CHECK(read("a.csv", "0,1\n1,2\n2,3\n", two).error ==
        "a.csv:1:1: error: commas between columns or decimal commas? write decimals with a point");
}

TEST_CASE("plain text that leaves its step or unit open is an error that says how to declare them") {
  CHECK(read("a.txt", "1\n2\n", {{}, AccelerationUnit::g, {}, ""}).error ==
        "error: 'a.txt' (plain text or CSV) doesn't say its step, which must be given: dt = \"...\" in a scene, --dt "
        "on the command line");
  CHECK(read("a.txt", "1\n2\n", {0.1, {}, {}, ""}).error ==
        "error: 'a.txt' (plain text or CSV) doesn't say its unit, which must be given: unit = \"...\" in a scene, "
        "--unit on the command "
        "line; one of g, m/s2, cm/s2, mm/s2, in/s2, ft/s2");
  CHECK(read("a.at2", "NPTS= 1, DT= .01\n1\n", {0.1, {}, {}, ""}).error ==
        "error: an AT2 record says its own step, dt must not be given");
  CHECK(read("a.at2", "NPTS= 1, DT= .01\n1\n", {{}, AccelerationUnit::metres, {}, ""}).error ==
        "error: 'a.at2' (PEER AT2) is in units of g, not m/s2");
  CHECK(read("a.txt", "1\n", {0.1, AccelerationUnit::g, {}, "at"}).error ==
        "error: format 'at' is not known; did you mean 'at2'?");
}

TEST_CASE("times that don't rise from zero in equal steps are an error") {
  const ReadOptions two{{}, AccelerationUnit::g, {}, ""};
  CHECK(read("a.txt", "0.1 1\n0.2 1\n", two).error == "a.txt:1:1: error: the first time is 0.1, must be 0");
  CHECK(read("a.txt", "0 1\n0.1 1\n0.1 2\n", two).error == "a.txt:3:1: error: time 0.1 is not after 0.1");
  CHECK(read("a.txt", "0 1\n1 1\n3 2\n", two).error == "a.txt:3:1: error: the step to time 3 is 2, not 1 as before");
  CHECK(read("a.txt", "0 1\n1 1\n", {0.5, AccelerationUnit::g, {}, ""}).error ==
        "a.txt:2:1: error: the step is 1 s, not dt = 0.5 s as given");
  CHECK(read("a.txt", "0 1\n", two).error == "a.txt:1:1: error: one row of time and acceleration gives no step");
  CHECK(read("a.txt", "0 1\n1\n", two).error == "a.txt:2:1: error: 1 columns, must be 2 as before");
  CHECK(read("a.txt", "0 1 2\n", two).error == "a.txt:1:1: error: 3 columns, must be 1 or 2");
}

TEST_CASE("the record that ships with the program starts with the zero at t = 0") {
  const Record record = read_record(shipped);
  CHECK(record.dt == 0.02);
  REQUIRE(record.acceleration.size() == 1560);
  CHECK(record.acceleration[0] == 0);
  CHECK(record.acceleration[1] == 0.0063 * g);
  double peak = 0;
  for (const double a : record.acceleration) peak = std::max(peak, std::abs(a));
  CHECK(peak == doctest::Approx(0.3188 * g).epsilon(2e-4));  // four digits printed
  CHECK(std::abs(record.acceleration[102]) == peak);         // t = 2.04 s
}

TEST_CASE("the sample of every format gives the values of the record that it was made from") {
  const std::vector<double> wanted = read_record(shipped).acceleration;
  double mean = 0;  // over the 400 values of the sample, which the K-NET reader takes off
  for (std::size_t i = 0; i < 400; ++i) mean += wanted[i] / 400;
  struct Sample {
    const char *file, *format;
    ReadOptions options;
    double offset, rounding, factor;  // [m/s2], [m/s2]: half a unit of the last digit
  };
  for (const auto& [file, format, options, offset, rounding, factor] :
       {Sample{"el_centro.V2c", "cosmos", {{}, {}, 1, ""}, 0, 0.5e-7, 1},
        Sample{"el_centro.V2c", "cosmos", {{}, {}, 2, ""}, 0, 0.5e-7, 0.5},
        Sample{"el_centro.V2", "csmip", {}, 0, 0.5e-5, 1}, Sample{"el_centro.esm.asc", "esm", {}, 0, 0.5e-8, 1},
        Sample{"el_centro.NS", "k-net", {}, -mean, 2.4e-6, 1}, Sample{"el_centro.csv", "text", {}, 0, 0.5e-6, 1},
        Sample{"el_centro.txt", "text", {0.02, {}, {}, ""}, 0, 1e-15, 1}}) {
    CAPTURE(file);
    const Record record = read_record(std::filesystem::path(samples) / file, options);
    CHECK(record.format == format);
    CHECK(record.dt == doctest::Approx(0.02).epsilon(1e-12));
    REQUIRE(record.acceleration.size() == 400);
    double worst = 0;
    for (std::size_t i = 0; i < 400; ++i)
      worst = std::max(worst, std::abs(record.acceleration[i] - factor * wanted[i] - offset));
    CHECK(worst < 1.001 * rounding);
  }
  const Record knet = read_record(std::filesystem::path(samples) / "el_centro.NS");
  REQUIRE(knet.notes.size() == 1);  // the peak of the header comes out
  CHECK(knet.notes[0].find("cm/s2 taken off") != std::string::npos);
}

TEST_CASE("a file with several channels is read by the number of the channel only") {
  const std::filesystem::path file = std::filesystem::path(samples) / "el_centro.V2c";
  const std::string none = errors_of(file, {});
  CHECK(none.find("a second channel begins here (Sta Chan   2: 180 deg") != std::string::npos);
  CHECK(none.find("--channel") != std::string::npos);
  CHECK(errors_of(file, {{}, {}, 3, ""}).find("holds 2 channels of acceleration, not 3") != std::string::npos);
}

TEST_CASE("truncated and contradictory files of every format are errors with their place") {
  const auto changed = [&](const char* file, const std::string& from, const std::string& to,
                           const ReadOptions& options = {}) {
    std::string text = test::file_text(std::filesystem::path(samples) / file);
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    text.replace(at, to.empty() ? std::string::npos : from.size(), to);
    return read(file, text, options).error;
  };
  CHECK(changed("el_centro.NS", "Scale Factor      2000(gal)", "Scale Factor      2000(kine)") ==
        "el_centro.NS:14:1: error: the scale factor must be written as 3920(gal)/6182761");
  CHECK(changed("el_centro.NS", "Sampling Freq(Hz)", "Sampling Rate    ") ==
        "el_centro.NS:17:1: error: the header has no 'Sampling Freq(Hz)'");
  CHECK(changed("el_centro.NS", "Duration Time(s)  8", "Duration Time(s)  9") ==
        "el_centro.NS:67:1: error: ends after 400 of 450 values");
  CHECK(changed("el_centro.NS", "Duration Time(s)  8", "Duration Time(s)  7") ==
        "el_centro.NS:61:59: error: more values than 350");
  CHECK(changed("el_centro.NS", "Memo.", "") == "el_centro.NS:16:1: error: ends within the 17 lines of the header");
  CHECK(changed("el_centro.esm.asc", "NDATA: 400", "NDATA: 401") ==
        "el_centro.esm.asc:415:1: error: ends after 400 of 401 values");
  CHECK(changed("el_centro.esm.asc", "NDATA: 400", "NDATA: 399") ==
        "el_centro.esm.asc:415:1: error: more values than NDATA = 399");
  CHECK(changed("el_centro.esm.asc", "DATA_TYPE: ACC", "DATA_TYPE: RAW ACC") == "");
  CHECK(changed("el_centro.esm.asc", "DATA_TYPE: ACCELERATION", "DATA_TYPE: VELOCITY") ==
        "el_centro.esm.asc:14:1: error: is not an acceleration record: DATA_TYPE is VELOCITY");
  CHECK(
      changed("el_centro.esm.asc", "UNITS: cm/s^2", "UNITS: counts") ==
      "el_centro.esm.asc:10:1: error: 'counts' is no unit of acceleration; known: g, m/s2, cm/s2, mm/s2, in/s2, ft/s2");
  CHECK(changed("el_centro.V2", "400 points of accel", "401 points of accel") ==
        "el_centro.V2:97:4: error: '400 poi' is not a number");
  CHECK(changed("el_centro.V2", "in cm/sec2.", "in counts. ").find("doesn't say its unit") != std::string::npos);
  CHECK(changed("el_centro.V2", "  400 points of accel", "") == "el_centro.V2:46:1: error: holds no accelerations");
  CHECK(read("el_centro.V2", test::file_text(std::filesystem::path(samples) / "el_centro.V2").substr(0, 3000)).error ==
        "el_centro.V2:62:1: error: ends after 123 of 400 values");
  CHECK(changed("el_centro.V2c", "units=cm/sec2", "units=counts ", {{}, {}, 1, ""}) ==
        "el_centro.V2c:37:1: error: 'counts' is no unit of acceleration; known: g, m/s2, cm/s2, mm/s2, in/s2, ft/s2");
  CHECK(changed("el_centro.V2c", "    20.000000", "    10.000000", {{}, {}, 1, ""}).find("two sampling intervals") !=
        std::string::npos);
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
    const Record record = read_record(std::filesystem::path(directory) / expected.file);
    CHECK(record.format == "at2");
    CHECK(record.acceleration.size() == expected.count);
    CHECK(record.dt == expected.dt);
    double peak = 0;
    for (const double a : record.acceleration) peak = std::max(peak, std::abs(a));
    CHECK(peak / g == doctest::Approx(expected.pga).epsilon(5e-4));
  }
}
