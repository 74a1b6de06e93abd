// Acceleration records of the usual archives. A file is read in pieces of fixed size, and a record has at most
// max_record_samples values, so memory stays bounded whatever the file is.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.hpp"
#include "base/errors.hpp"
#include "motion/units.hpp"

namespace nsframe {

inline constexpr std::size_t max_record_samples = 10'000'000;

struct Record {
  double dt = 0;                     // [s]
  std::vector<double> acceleration;  // [m/s2]; the first value is at t = 0
  std::string format;                // name of its format, "at2"
  std::string description;           // what the file says of event, station, component
  std::vector<std::string> notes;    // what was done in reading, "mean of ... taken off"
};

// What is said about a file from outside. What a file says itself must not be contradicted.
struct ReadOptions {
  std::optional<double> dt;  // [s]
  std::optional<AccelerationUnit> unit;
  std::optional<int> channel;  // from 1, of a file with several
  std::string format;          // name; empty: found from the name and the beginning of the file
};

// A fault of a record: in its file at `at`, or, when at.line is 0, in what is said about the file.
struct RecordError : InputError {
  RecordError(Location place, const std::string& message);
  Location at;
  std::string text;
};

// Throws RecordError with the first fault, IoError when the file cannot be opened.
Record read_record(const std::filesystem::path& file, const ReadOptions& options = {});

// Names of the formats, in the order in which a file is tried for them.
std::vector<std::string> record_formats();

}  // namespace nsframe
