// Readers of acceleration records: PEER AT2 and plain text. A file is read in pieces of fixed size, and a record has at
// most max_record_samples values, so memory stays bounded whatever the file is.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "base/diagnostics.hpp"
#include "scene/tables.hpp"

namespace nsframe {

inline constexpr std::size_t max_record_samples = 10'000'000;

struct Record {
  double dt = 0;                     // [s]
  std::vector<double> acceleration;  // [m/s2]; the first value is at t = 0
};

// Reads the file of `motion`, relative to `directory`; pga and factor are not applied. What is wrong with the file is
// reported at its line, what is missing in the scene at the motion.
std::optional<Record> read_record(const MotionTable& motion, const std::filesystem::path& directory,
                                  Diagnostics& diagnostics);

}  // namespace nsframe
