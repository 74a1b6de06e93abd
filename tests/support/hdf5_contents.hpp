// All that an HDF5 file holds, to compare two files bit by bit: data sets and attributes by their paths.
#pragma once

#include <doctest/doctest.h>
#include <hdf5.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace nsframe::test {

// Shape, then bytes of the numbers or the texts, in one string each.
using Hdf5Contents = std::map<std::string, std::string>;

namespace detail {

template <class Read>
std::string read_value(hid_t type, hid_t space, const Read& read) {
  std::string value;
  std::vector<hsize_t> size(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, size.data(), nullptr);
  for (const hsize_t n : size) value += std::to_string(n) + " ";
  const auto count = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space));
  if (H5Tis_variable_str(type) > 0) {
    std::vector<char*> texts(count);
    REQUIRE(read(texts.data()) >= 0);
    for (const char* text : texts) value += std::string(text) + "\n";
    H5Dvlen_reclaim(type, space, H5P_DEFAULT, texts.data());
    return value;
  }
  const std::size_t begin = value.size();
  value.resize(begin + count * H5Tget_size(type));
  if (count > 0) REQUIRE(read(value.data() + begin) >= 0);
  return value;
}

inline herr_t add_attribute(hid_t object, const char* name, const H5A_info_t*, void* found) {
  auto& [contents, path] = *static_cast<std::pair<Hdf5Contents&, std::string>*>(found);
  const hid_t attribute = H5Aopen(object, name, H5P_DEFAULT), type = H5Aget_type(attribute), space = H5Aget_space(attribute);
  contents[path + "@" + name] = read_value(type, space, [&](void* to) { return H5Aread(attribute, type, to); });
  H5Sclose(space);
  H5Tclose(type);
  H5Aclose(attribute);
  return 0;
}

inline herr_t add_object(hid_t file, const char* name, const H5O_info_t* info, void* contents) {
  const hid_t object = H5Oopen(file, name, H5P_DEFAULT);
  std::pair<Hdf5Contents&, std::string> found{*static_cast<Hdf5Contents*>(contents), name};
  if (info->type == H5O_TYPE_DATASET) {
    const hid_t type = H5Dget_type(object), space = H5Dget_space(object);
    found.first[name] = read_value(type, space, [&](void* to) { return H5Dread(object, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, to); });
    H5Sclose(space);
    H5Tclose(type);
  }
  H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, add_attribute, &found);
  H5Oclose(object);
  return 0;
}

}  // namespace detail

inline Hdf5Contents hdf5_contents(const std::filesystem::path& path) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  REQUIRE(file >= 0);
  Hdf5Contents contents;
  H5Ovisit(file, H5_INDEX_NAME, H5_ITER_INC, detail::add_object, &contents);
  H5Fclose(file);
  return contents;
}

inline void check_same_contents(const std::filesystem::path& one, const std::filesystem::path& other) {
  const Hdf5Contents a = hdf5_contents(one), b = hdf5_contents(other);
  CHECK(a.size() > 10);
  CHECK(a.size() == b.size());
  for (const auto& [name, value] : a) {
    const auto found = b.find(name);
    REQUIRE_MESSAGE(found != b.end(), name);
    CHECK_MESSAGE(found->second == value, name);
  }
}

}  // namespace nsframe::test
