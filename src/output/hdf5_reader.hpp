// Reads what this program wrote to an HDF5 file. Every failure is an IoError with the path and the name.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "output/hdf5_file.hpp"

namespace nsframe {

class Hdf5Reader {
 public:
  explicit Hdf5Reader(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }
  bool has(const std::string& name) const;
  std::vector<std::string> names() const;  // of the objects below the root
  std::vector<std::string> names_in(const std::string& group) const;
  std::vector<hsize_t> shape(const std::string& name) const;
  std::vector<double> numbers(const std::string& name) const;
  std::vector<int> integers(const std::string& name) const;
  // Rows [first, first + count) along the first dimension, one after the other.
  void read_rows(const std::string& name, hsize_t first, hsize_t count, std::vector<double>& values) const;
  std::string text(const std::string& name) const;
  std::vector<std::string> texts(const std::string& name) const;
  std::string text_attribute(const std::string& name) const;  // of the root

 private:
  hid_t check(hid_t result, const std::string& name) const;
  Hdf5Id open(const std::string& name) const;
  // Entries of a data set; throws where its size is more than the file holds, so that a damaged one isn't taken for memory to claim.
  std::size_t entries(hid_t data, const std::string& name) const;

  std::filesystem::path path_;
  Hdf5Id file_;
};

}  // namespace nsframe
