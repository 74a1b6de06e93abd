#include "output/hdf5_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "base/errors.hpp"
#include "output/files.hpp"

namespace nsframe {
namespace {

// The innermost message, which names the cause ("No space left on device").
herr_t keep_description(unsigned, const H5E_error2_t* error, void* text) {
  if (error->desc) *static_cast<std::string*>(text) = error->desc;
  return 0;
}

std::string hdf5_error() {
  std::string text;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, keep_description, &text);
  const auto begin = text.find("error message = '");
  if (begin == std::string::npos) return text;
  const auto first = begin + 17;
  return text.substr(first, text.find('\'', first) - first);
}

template <class Value>
hid_t native_type();
template <>
hid_t native_type<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
hid_t native_type<int>() {
  return H5T_NATIVE_INT;
}

// Metadata goes to the file only with a flush: between two of them, the file on disk is the one of the last.
// Formats up to 1.8 have no mark "open for writing", with which readers refuse a file whose writer died.
Hdf5Id file_access() {
  Hdf5Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_V18);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  H5AC_cache_config_t cache;
  cache.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  H5Pget_mdc_config(access, &cache);
  cache.evictions_enabled = false;
  cache.incr_mode = H5C_incr__off;
  cache.flash_incr_mode = H5C_flash_incr__off;
  cache.decr_mode = H5C_decr__off;
  H5Pset_mdc_config(access, &cache);
  return access;
}

// Without times of creation, so that equal runs give equal files.
Hdf5Id data_set_properties() {
  Hdf5Id properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(properties, false);
  return properties;
}

Hdf5Id simple_space(hsize_t size) { return {H5Screate_simple(1, &size, nullptr), H5Sclose}; }

std::vector<const char*> pointers(const std::vector<std::string>& texts) {
  std::vector<const char*> starts;
  for (const auto& text : texts) starts.push_back(text.c_str());
  return starts;
}

}  // namespace

QuietHdf5::QuietHdf5() {
  H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

QuietHdf5::~QuietHdf5() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }

Hdf5File::Hdf5File(std::filesystem::path path, Mode mode)
    : path_(std::move(path)), partial_(path_), published_(mode == Mode::reopen) {
  const QuietHdf5 quiet;
  partial_ += ".partial";
  const Hdf5Id access = file_access();
  const hid_t file = published_ ? H5Fopen(path_.c_str(), H5F_ACC_RDWR, access)
                                : H5Fcreate(partial_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  file_ = Hdf5Id(check(file, published_ ? "opening the file" : "creating the file"), H5Fclose);
  text_type_ = Hdf5Id(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(text_type_, H5T_VARIABLE);
  H5Tset_cset(text_type_, H5T_CSET_UTF8);
}

Hdf5File::~Hdf5File() {
  const QuietHdf5 quiet;
  file_ = Hdf5Id();
  if (published_) return;
  std::error_code ignored;
  std::filesystem::remove(partial_, ignored);
}

hid_t Hdf5File::check(hid_t result, const std::string& doing) const {
  if (result >= 0) return result;
  const std::string reason = hdf5_error();
  cut_off();
  throw IoError(fmt::format("cannot write '{}' ({}): {}", path_.string(), doing, reason));
}

int Hdf5File::descriptor() const {
  void* handle = nullptr;
  if (file_ < 0 || H5Fget_vfd_handle(file_, H5P_DEFAULT, &handle) < 0 || !handle) return -1;
  return *static_cast<int*>(handle);
}

// After a failure HDF5 would still try to write its metadata on closing, leave them torn, and crash at exit. So the
// file on the disk stays as the last flush left it, and what HDF5 still writes goes to memory that nobody reads.
void Hdf5File::cut_off() const {
  const int file = descriptor();
  if (file < 0) return;
  const int nowhere = memfd_create("nsframe", 0);
  if (nowhere < 0) return;
  dup2(nowhere, file);
  ::close(nowhere);
}

// A flush that finds the disk full halfway would tear the metadata: the space is claimed before it begins.
void Hdf5File::reserve_space() const {
  const int file = descriptor();
  hsize_t size = 0;
  struct stat now;
  if (file < 0 || H5Fget_filesize(file_, &size) < 0 || fstat(file, &now) != 0) return;
  const auto needed = static_cast<off_t>(size) - now.st_size;
  if (needed <= 0) return;
  const int error = posix_fallocate(file, now.st_size, needed);
  if (error == 0 || error == EOPNOTSUPP || error == EINVAL) return;
  cut_off();
  throw IoError(fmt::format("cannot write '{}': {}", path_.string(), std::strerror(error)));
}

void Hdf5File::publish() {
  flush();
  replace_file(partial_, path_);
  published_ = true;
}

void Hdf5File::flush() {
  const QuietHdf5 quiet;
  reserve_space();
  check(H5Fflush(file_, H5F_SCOPE_GLOBAL), "writing to the disk");
}

void Hdf5File::sync() {
  flush();
  if (fsync(descriptor()) != 0 && errno != EINVAL) {
    throw IoError(fmt::format("cannot write '{}': {}", path_.string(), std::strerror(errno)));
  }
}

void Hdf5File::close() {
  flush();
  file_ = Hdf5Id();
}

bool Hdf5File::has(const std::string& name) const {
  const QuietHdf5 quiet;
  return H5Lexists(file_, in_folder(name).c_str(), H5P_DEFAULT) > 0;
}

void Hdf5File::remove(const std::string& name) {
  if (!has(name)) return;
  const QuietHdf5 quiet;
  check(H5Ldelete(file_, in_folder(name).c_str(), H5P_DEFAULT), name);
}

void Hdf5File::remove_attribute(const std::string& object, const std::string& name) {
  if (H5Aexists_by_name(file_, in_folder(object).c_str(), name.c_str(), H5P_DEFAULT) <= 0) return;
  check(H5Adelete_by_name(file_, in_folder(object).c_str(), name.c_str(), H5P_DEFAULT), object);
}

void Hdf5File::make_group(const std::string& name) {
  if (has(name)) return;
  const QuietHdf5 quiet;
  const Hdf5Id links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links, 1);
  const Hdf5Id properties(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  H5Pset_obj_track_times(properties, false);
  const Hdf5Id group(check(H5Gcreate2(file_, in_folder(name).c_str(), links, properties, H5P_DEFAULT), name), H5Gclose);
}

void Hdf5File::write_text(const std::string& name, const std::string& text) {
  remove(name);
  const QuietHdf5 quiet;
  const Hdf5Id space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Id properties = data_set_properties();
  const Hdf5Id data(
      check(H5Dcreate2(file_, in_folder(name).c_str(), text_type_, space, H5P_DEFAULT, properties, H5P_DEFAULT), name), H5Dclose);
  const char* start = text.c_str();
  check(H5Dwrite(data, text_type_, H5S_ALL, H5S_ALL, H5P_DEFAULT, &start), name);
}

void Hdf5File::write_texts(const std::string& name, const std::vector<std::string>& texts) {
  remove(name);
  const QuietHdf5 quiet;
  const Hdf5Id space = simple_space(texts.size());
  const Hdf5Id properties = data_set_properties();
  const Hdf5Id data(
      check(H5Dcreate2(file_, in_folder(name).c_str(), text_type_, space, H5P_DEFAULT, properties, H5P_DEFAULT), name), H5Dclose);
  if (!texts.empty()) check(H5Dwrite(data, text_type_, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers(texts).data()), name);
}

void Hdf5File::write_numbers(const std::string& name, const std::vector<double>& values, std::vector<hsize_t> shape) {
  if (shape.empty()) shape = {values.size()};
  write_array(name, H5T_NATIVE_DOUBLE, values.empty() ? nullptr : values.data(), std::move(shape));
}

void Hdf5File::write_numbers(const std::string& name, const std::vector<int>& values, std::vector<hsize_t> shape) {
  if (shape.empty()) shape = {values.size()};
  write_array(name, H5T_NATIVE_INT, values.empty() ? nullptr : values.data(), std::move(shape));
}

void Hdf5File::write_array(const std::string& name, hid_t type, const void* values, std::vector<hsize_t> shape) {
  remove(name);
  const QuietHdf5 quiet;
  const Hdf5Id space(check(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), name), H5Sclose);
  const Hdf5Id properties = data_set_properties();
  const Hdf5Id data(
      check(H5Dcreate2(file_, in_folder(name).c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT), name), H5Dclose);
  if (values) check(H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), name);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name, const std::string& text) {
  const QuietHdf5 quiet;
  remove_attribute(object, name);
  const Hdf5Id space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Id attribute(check(H5Acreate_by_name(file_, in_folder(object).c_str(), name.c_str(), text_type_, space, H5P_DEFAULT,
                                                 H5P_DEFAULT, H5P_DEFAULT),
                               object),
                         H5Aclose);
  const char* start = text.c_str();
  check(H5Awrite(attribute, text_type_, &start), object);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name,
                             const std::vector<std::string>& texts) {
  const QuietHdf5 quiet;
  remove_attribute(object, name);
  const Hdf5Id space = simple_space(texts.size());
  const Hdf5Id attribute(check(H5Acreate_by_name(file_, in_folder(object).c_str(), name.c_str(), text_type_, space, H5P_DEFAULT,
                                                 H5P_DEFAULT, H5P_DEFAULT),
                               object),
                         H5Aclose);
  check(H5Awrite(attribute, text_type_, pointers(texts).data()), object);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name, double value) {
  const QuietHdf5 quiet;
  remove_attribute(object, name);
  const Hdf5Id space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Id attribute(check(H5Acreate_by_name(file_, in_folder(object).c_str(), name.c_str(), H5T_NATIVE_DOUBLE, space,
                                                 H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                               object),
                         H5Aclose);
  check(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value), object);
}

template <class Value>
Hdf5Series<Value>::Hdf5Series(Hdf5File& file, const std::string& name, std::vector<hsize_t> shape, hsize_t block)
    : file_(&file), name_(file.in_folder(name)), shape_(std::move(shape)) {
  for (const hsize_t size : shape_) row_size_ *= size;
  if (file.has(name)) {
    open();
  } else {
    create(block);
  }
  buffer_.reserve(row_size_ * block);
}

template <class Value>
void Hdf5Series<Value>::create(hsize_t block) {
  const QuietHdf5 quiet;
  std::vector<hsize_t> now{0}, most{H5S_UNLIMITED}, chunk{block};
  for (const hsize_t size : shape_) {
    now.push_back(size);
    most.push_back(size);
    chunk.push_back(std::max<hsize_t>(size, 1));  // a chunk may not be empty, a row may
  }
  const Hdf5Id space(file_->check(H5Screate_simple(int(now.size()), now.data(), most.data()), name_), H5Sclose);
  const Hdf5Id properties = data_set_properties();
  file_->check(H5Pset_chunk(properties, int(chunk.size()), chunk.data()), name_);
  const Hdf5Id links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links, 1);
  data_set_ = Hdf5Id(
      file_->check(H5Dcreate2(file_->id(), name_.c_str(), native_type<Value>(), space, links, properties, H5P_DEFAULT),
                   name_),
      H5Dclose);
}

template <class Value>
void Hdf5Series<Value>::open() {
  const QuietHdf5 quiet;
  data_set_ = Hdf5Id(file_->check(H5Dopen2(file_->id(), name_.c_str(), H5P_DEFAULT), name_), H5Dclose);
  const Hdf5Id space(file_->check(H5Dget_space(data_set_), name_), H5Sclose);
  std::vector<hsize_t> size(shape_.size() + 1);
  const bool same = H5Sget_simple_extent_ndims(space) == int(size.size()) &&
                    H5Sget_simple_extent_dims(space, size.data(), nullptr) >= 0 &&
                    std::equal(shape_.begin(), shape_.end(), size.begin() + 1);
  if (!same) throw IoError(fmt::format("'{}' is not a history of this scene: '{}' has another shape", file_->path().string(), name_));
  rows_ = size[0];
}

template <class Value>
void Hdf5Series<Value>::truncate(hsize_t rows) {
  if (rows_ < rows) {
    throw IoError(fmt::format("'{}' has lost rows: '{}' has {}, the checkpoint needs {}", file_->path().string(), name_, rows_, rows));
  }
  const QuietHdf5 quiet;
  std::vector<hsize_t> size{rows};
  size.insert(size.end(), shape_.begin(), shape_.end());
  file_->check(H5Dset_extent(data_set_, size.data()), name_);
  rows_ = rows;
  buffer_.clear();
}

template <class Value>
void Hdf5Series<Value>::write() {
  if (buffer_.empty()) return;
  const QuietHdf5 quiet;
  const hsize_t added = buffer_.size() / row_size_;
  std::vector<hsize_t> size{rows_ + added}, count{added}, start(shape_.size() + 1, 0);
  size.insert(size.end(), shape_.begin(), shape_.end());
  count.insert(count.end(), shape_.begin(), shape_.end());
  start[0] = rows_;
  file_->check(H5Dset_extent(data_set_, size.data()), name_);
  const Hdf5Id space(H5Dget_space(data_set_), H5Sclose);
  file_->check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr), name_);
  const Hdf5Id memory(H5Screate_simple(int(count.size()), count.data(), nullptr), H5Sclose);
  file_->check(H5Dwrite(data_set_, native_type<Value>(), memory, space, H5P_DEFAULT, buffer_.data()), name_);
  rows_ += added;
  buffer_.clear();
}

template class Hdf5Series<double>;
template class Hdf5Series<int>;

}  // namespace nsframe
