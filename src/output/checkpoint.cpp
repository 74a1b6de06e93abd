#include "output/checkpoint.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstdint>

#include "base/errors.hpp"
#include "output/hdf5_reader.hpp"

namespace nsframe {
namespace {

// FNV-1a over names, sizes and bits (public domain, Fowler, Noll and Vo).
class Checksum {
 public:
  void add(std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte) {
      sum_ = (sum_ ^ (word >> (8 * byte) & 0xffU)) * 0x100000001b3U;
    }
  }
  void add(const std::string& text) {
    add(text.size());
    for (const char letter : text) add(static_cast<std::uint64_t>(static_cast<unsigned char>(letter)));
  }
  std::string text() const { return fmt::format("{:016x}", sum_); }

 private:
  std::uint64_t sum_ = 0xcbf29ce484222325U;
};

std::string checksum(const std::string& scene, const Snapshot& snapshot) {
  Checksum sum;
  sum.add(scene);
  for (const auto& [name, values] : snapshot.arrays) {
    sum.add(name);
    sum.add(values.size());
    for (const double value : values) sum.add(std::bit_cast<std::uint64_t>(value));
  }
  return sum.text();
}

[[noreturn]] void damaged(const std::filesystem::path& path) {
  throw IoError(fmt::format("error: the checkpoint '{}' is damaged or cannot be read: it cannot be resumed", path.string()));
}

Checkpoint contents(const std::filesystem::path& path) {
  const Hdf5Reader reader(path);
  Checkpoint checkpoint{reader.text("/scene"), reader.text_attribute("version"), {}};
  for (const std::string& name : reader.names()) {
    if (name != "scene") checkpoint.snapshot.arrays[name] = reader.numbers(name);
  }
  if (checksum(checkpoint.scene, checkpoint.snapshot) != reader.text_attribute("checksum")) damaged(path);
  return checkpoint;
}

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const std::string& scene, const Snapshot& snapshot) {
  Hdf5File file(path);
  file.set_attribute("/", "program", "nsframe");
  file.set_attribute("/", "version", NSFRAME_VERSION);
  file.set_attribute("/", "checksum", checksum(scene, snapshot));
  file.write_text("/scene", scene);
  for (const auto& [name, values] : snapshot.arrays) file.write_numbers("/" + name, values);
  file.sync();
  file.publish();
}

Checkpoint read_checkpoint(const std::filesystem::path& path) {
  try {
    return contents(path);
  } catch (const IoError&) {
    damaged(path);
  }
}

}  // namespace nsframe
