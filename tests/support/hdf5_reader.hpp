// Data sets, units and attributes of an HDF5 file.
#pragma once

#include <doctest/doctest.h>
#include <hdf5.h>

#include <filesystem>
#include <string>
#include <vector>

namespace nsframe::test {

// Reads with the C API alone, as another program would.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(const std::filesystem::path& path) : file_(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)) {
    REQUIRE(file_ >= 0);
  }
  ~Hdf5Reader() { H5Fclose(file_); }
  bool has(const char* name) const { return H5Lexists(file_, name, H5P_DEFAULT) > 0; }
  std::vector<hsize_t> shape(const char* name) const {
    const hid_t data = H5Dopen2(file_, name, H5P_DEFAULT);
    REQUIRE_MESSAGE(data >= 0, name);
    const hid_t space = H5Dget_space(data);
    std::vector<hsize_t> sizes(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
    H5Sget_simple_extent_dims(space, sizes.data(), nullptr);
    H5Sclose(space);
    H5Dclose(data);
    return sizes;
  }
  std::vector<double> numbers(const char* name) const {
    std::size_t size = 1;
    for (const hsize_t n : shape(name)) size *= n;
    std::vector<double> values(size);
    const hid_t data = H5Dopen2(file_, name, H5P_DEFAULT);
    REQUIRE(H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
    H5Dclose(data);
    return values;
  }
  std::vector<std::string> texts(const char* name) const {
    const hid_t data = H5Dopen2(file_, name, H5P_DEFAULT), type = H5Dget_type(data), space = H5Dget_space(data);
    std::vector<char*> raw(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    REQUIRE(H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, raw.data()) >= 0);
    std::vector<std::string> values(raw.begin(), raw.end());
    H5Dvlen_reclaim(type, space, H5P_DEFAULT, raw.data());
    H5Sclose(space);
    H5Tclose(type);
    H5Dclose(data);
    return values;
  }
  double attribute(const char* object, const char* name) const {
    double value = -1;
    const hid_t attribute = H5Aopen_by_name(file_, object, name, H5P_DEFAULT, H5P_DEFAULT);
    REQUIRE(attribute >= 0);
    H5Aread(attribute, H5T_NATIVE_DOUBLE, &value);
    H5Aclose(attribute);
    return value;
  }
  std::string units(const char* object) const {
    const hid_t attribute = H5Aopen_by_name(file_, object, "units", H5P_DEFAULT, H5P_DEFAULT);
    REQUIRE(attribute >= 0);
    const hid_t type = H5Aget_type(attribute);
    char* text = nullptr;
    H5Aread(attribute, type, &text);
    const std::string value = text;
    H5free_memory(text);
    H5Tclose(type);
    H5Aclose(attribute);
    return value;
  }

 private:
  hid_t file_;
};

}  // namespace nsframe::test
