#include "output/checkpoint.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstdint>

#include "base/errors.hpp"
#include "output/hdf5_file.hpp"

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

class Reader {
 public:
  explicit Reader(const std::filesystem::path& path)
      : path_(path), file_(check(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)), H5Fclose) {}

  std::string text(const char* name) const {
    const Hdf5Id data(check(H5Dopen2(file_, name, H5P_DEFAULT)), H5Dclose);
    const Hdf5Id type(check(H5Dget_type(data)), H5Tclose);
    check(H5Tis_variable_str(type) - 1);
    char* raw = nullptr;
    check(H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &raw));
    return owned(raw);
  }
  std::string attribute(const char* name) const {
    const Hdf5Id attribute(check(H5Aopen(file_, name, H5P_DEFAULT)), H5Aclose);
    const Hdf5Id type(check(H5Aget_type(attribute)), H5Tclose);
    check(H5Tis_variable_str(type) - 1);
    char* raw = nullptr;
    check(H5Aread(attribute, type, &raw));
    return owned(raw);
  }
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    const auto add = [](hid_t, const char* name, const H5L_info_t*, void* list) {
      static_cast<std::vector<std::string>*>(list)->push_back(name);
      return herr_t{0};
    };
    check(H5Literate(file_, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, add, &names));
    return names;
  }
  std::vector<double> numbers(const std::string& name) const {
    const Hdf5Id data(check(H5Dopen2(file_, name.c_str(), H5P_DEFAULT)), H5Dclose);
    const Hdf5Id space(check(H5Dget_space(data)), H5Sclose);
    const hssize_t size = H5Sget_simple_extent_npoints(space);
    check(size < 0 ? -1 : 0);
    // a damaged size must not be taken for memory to claim
    check(H5Dget_storage_size(data) == sizeof(double) * static_cast<hsize_t>(size) ? 0 : -1);
    std::vector<double> values(static_cast<std::size_t>(size));
    if (size > 0) check(H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
    return values;
  }
  [[noreturn]] void damaged() const {
    throw IoError(fmt::format("error: the checkpoint '{}' is damaged or cannot be read: it cannot be resumed", path_.string()));
  }

 private:
  hid_t check(hid_t result) const {
    if (result < 0) damaged();
    return result;
  }
  static std::string owned(char* raw) {
    std::string text = raw ? raw : "";
    H5free_memory(raw);
    return text;
  }

  std::filesystem::path path_;
  Hdf5Id file_;
};

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
  const QuietHdf5 quiet;
  const Reader reader(path);
  Checkpoint checkpoint{reader.text("/scene"), reader.attribute("version"), {}};
  for (const std::string& name : reader.names()) {
    if (name != "scene") checkpoint.snapshot.arrays[name] = reader.numbers(name);
  }
  if (checksum(checkpoint.scene, checkpoint.snapshot) != reader.attribute("checksum")) reader.damaged();
  return checkpoint;
}

}  // namespace nsframe
