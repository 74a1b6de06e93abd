// checkpoint.h5: from where `nsframe run --resume` goes on. Written whole and then renamed, so that at any moment the
// file is a complete one, and after the other results were brought to the disk.
#pragma once

#include <filesystem>
#include <string>

#include "models/snapshot.hpp"

namespace nsframe {

struct Checkpoint {
  std::string scene;    // complete, as text
  std::string version;  // of the program that wrote it
  Snapshot snapshot;
};

// Layout: one data set of doubles an array of the snapshot; /scene; attributes program, version, checksum.
// Throws IoError; an earlier file is then still there.
void write_checkpoint(const std::filesystem::path& path, const std::string& scene, const Snapshot& snapshot);

// Throws IoError when the file cannot be read or is not what was written.
Checkpoint read_checkpoint(const std::filesystem::path& path);

}  // namespace nsframe
