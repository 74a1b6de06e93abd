#include "output/hdf5_reader.hpp"

#include <fmt/format.h>

#include "base/errors.hpp"

namespace nsframe {

Hdf5Reader::Hdf5Reader(std::filesystem::path path) : path_(std::move(path)) {
  const QuietHdf5 quiet;
  file_ = Hdf5Id(check(H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "the file"), H5Fclose);
}

hid_t Hdf5Reader::check(hid_t result, const std::string& name) const {
  if (result < 0) throw IoError(fmt::format("error: '{}' is damaged or cannot be read: {}", path_.string(), name));
  return result;
}

Hdf5Id Hdf5Reader::open(const std::string& name) const {
  const QuietHdf5 quiet;
  return {check(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), name), H5Dclose};
}

bool Hdf5Reader::has(const std::string& name) const {
  const QuietHdf5 quiet;
  for (std::size_t slash = name.find('/', 1); slash != std::string::npos; slash = name.find('/', slash + 1)) {
    if (H5Lexists(file_, name.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
  }
  return H5Lexists(file_, name.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::string> Hdf5Reader::names() const { return names_in("/"); }

std::vector<std::string> Hdf5Reader::names_in(const std::string& group) const {
  const QuietHdf5 quiet;
  std::vector<std::string> names;
  const auto add = [](hid_t, const char* name, const H5L_info_t*, void* list) {
    static_cast<std::vector<std::string>*>(list)->push_back(name);
    return herr_t{0};
  };
  check(H5Literate_by_name(file_, group.c_str(), H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, add, &names, H5P_DEFAULT), group);
  return names;
}

std::vector<hsize_t> Hdf5Reader::shape(const std::string& name) const {
  const QuietHdf5 quiet;
  const Hdf5Id data = open(name), space(check(H5Dget_space(data), name), H5Sclose);
  std::vector<hsize_t> sizes(static_cast<std::size_t>(check(H5Sget_simple_extent_ndims(space), name)));
  check(H5Sget_simple_extent_dims(space, sizes.data(), nullptr), name);
  return sizes;
}

std::size_t Hdf5Reader::entries(hid_t data, const std::string& name) const {
  const Hdf5Id space(check(H5Dget_space(data), name), H5Sclose), type(check(H5Dget_type(data), name), H5Tclose);
  const hssize_t size = H5Sget_simple_extent_npoints(space);
  check(size < 0 ? -1 : 0, name);
  check(H5Dget_storage_size(data) >= H5Tget_size(type) * static_cast<hsize_t>(size) ? 0 : -1, name);
  return static_cast<std::size_t>(size);
}

std::vector<double> Hdf5Reader::numbers(const std::string& name) const {
  const QuietHdf5 quiet;
  const Hdf5Id data = open(name);
  std::vector<double> values(entries(data, name));
  if (!values.empty()) check(H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name);
  return values;
}

std::vector<int> Hdf5Reader::integers(const std::string& name) const {
  const QuietHdf5 quiet;
  const Hdf5Id data = open(name);
  std::vector<int> values(entries(data, name));
  if (!values.empty()) check(H5Dread(data, H5T_NATIVE_INT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name);
  return values;
}

void Hdf5Reader::read_rows(const std::string& name, hsize_t first, hsize_t count, std::vector<double>& values) const {
  std::vector<hsize_t> size = shape(name), start(size.size(), 0);
  const QuietHdf5 quiet;
  const Hdf5Id data = open(name), space(check(H5Dget_space(data), name), H5Sclose);
  check(size.empty() || first + count > size[0] ? -1 : 0, name);
  start[0] = first;
  size[0] = count;
  std::size_t total = 1;
  for (const hsize_t n : size) total *= n;
  values.resize(total);
  if (total == 0) return;
  check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr), name);
  const Hdf5Id memory(check(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), name), H5Sclose);
  check(H5Dread(data, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, values.data()), name);
}

std::vector<std::string> Hdf5Reader::texts(const std::string& name) const {
  const QuietHdf5 quiet;
  const Hdf5Id data = open(name), type(check(H5Dget_type(data), name), H5Tclose), space(check(H5Dget_space(data), name), H5Sclose);
  check(H5Tis_variable_str(type) - 1, name);
  std::vector<char*> raw(entries(data, name));
  if (raw.empty()) return {};
  check(H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, raw.data()), name);
  std::vector<std::string> values;
  for (const char* text : raw) values.emplace_back(text ? text : "");
  H5Dvlen_reclaim(type, space, H5P_DEFAULT, raw.data());
  return values;
}

std::string Hdf5Reader::text(const std::string& name) const {
  const std::vector<std::string> values = texts(name);
  check(values.size() == 1 ? 0 : -1, name);
  return values.front();
}

std::string Hdf5Reader::text_attribute(const std::string& name) const {
  const QuietHdf5 quiet;
  const Hdf5Id attribute(check(H5Aopen(file_, name.c_str(), H5P_DEFAULT), name), H5Aclose);
  const Hdf5Id type(check(H5Aget_type(attribute), name), H5Tclose);
  check(H5Tis_variable_str(type) - 1, name);
  char* raw = nullptr;
  check(H5Aread(attribute, type, &raw), name);
  std::string value = raw ? raw : "";
  H5free_memory(raw);
  return value;
}

}  // namespace nsframe
