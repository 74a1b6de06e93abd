// The few things of HDF5 that the histories need: a file that stays readable when the program dies, extendable
// data sets filled row by row through a buffer, texts and attributes. Every failure is an IoError with the path.
#pragma once

#include <hdf5.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace nsframe {

// HDF5 prints its errors unless told not to; within this scope it keeps them for hdf5_error().
class QuietHdf5 {
 public:
  QuietHdf5();
  ~QuietHdf5();
  QuietHdf5(const QuietHdf5&) = delete;
  QuietHdf5& operator=(const QuietHdf5&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

// Owns an HDF5 identifier. Closing may write what is still cached; a failure of that is the one of the last flush
// again, and stays silent.
class Hdf5Id {
 public:
  using Close = herr_t (*)(hid_t);
  Hdf5Id() = default;
  Hdf5Id(hid_t id, Close close) : id_(id), close_(close) {}
  Hdf5Id(Hdf5Id&& other) noexcept : id_(other.id_), close_(other.close_) { other.id_ = -1; }
  Hdf5Id& operator=(Hdf5Id&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Hdf5Id() {
    if (id_ < 0) return;
    const QuietHdf5 quiet;
    close_(id_);
  }
  operator hid_t() const { return id_; }

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

class Hdf5File {
 public:
  // `create` makes `<path>.partial`, to which publish() gives its name. `reopen` goes on with the file at `path`: what
  // is created again then replaces what is there, except groups and series, which stay.
  enum class Mode { create, reopen };
  explicit Hdf5File(std::filesystem::path path, Mode mode = Mode::create);
  ~Hdf5File();

  // From here on the file is at `path`, replacing an earlier one, and what was flushed can be read there.
  void publish();
  void flush();
  void sync();  // flushes, and waits until the disk has it
  void close();

  hid_t id() const { return file_; }
  const std::filesystem::path& path() const { return path_; }
  // Names from now on are below this group, e.g. "/static/push"; empty: below the root.
  void set_folder(std::string folder) { folder_ = std::move(folder); }
  std::string in_folder(const std::string& name) const { return folder_ + name; }
  bool has(const std::string& name) const;
  void remove(const std::string& name);  // an object that may exist
  void make_group(const std::string& name);
  void write_text(const std::string& name, const std::string& text);
  void write_texts(const std::string& name, const std::vector<std::string>& texts);
  // `shape`: of the data set, row by row; by default one-dimensional
  void write_numbers(const std::string& name, const std::vector<double>& values, std::vector<hsize_t> shape = {});
  void write_numbers(const std::string& name, const std::vector<int>& values, std::vector<hsize_t> shape = {});
  // Attributes of an existing object.
  void set_attribute(const std::string& object, const std::string& name, const std::string& text);
  void set_attribute(const std::string& object, const std::string& name, const std::vector<std::string>& texts);
  void set_attribute(const std::string& object, const std::string& name, double value);

  // Throws IoError when `result` is negative, and writes nothing to the file from then on.
  hid_t check(hid_t result, const std::string& doing) const;

 private:
  void write_array(const std::string& name, hid_t type, const void* values, std::vector<hsize_t> shape);
  void remove_attribute(const std::string& object, const std::string& name);
  void reserve_space() const;
  void cut_off() const;
  int descriptor() const;

  std::string folder_;
  std::filesystem::path path_, partial_;
  bool published_ = false;
  Hdf5Id file_, text_type_;
};

// A data set that grows along its first dimension, (rows, shape...), through a buffer of `block` rows.
template <class Value>
class Hdf5Series {
 public:
  Hdf5Series(Hdf5File& file, const std::string& name, std::vector<hsize_t> shape, hsize_t block);

  Value* add_row() {
    buffer_.resize(buffer_.size() + row_size_);
    return buffer_.data() + buffer_.size() - row_size_;
  }
  // Appends the buffered rows to the file.
  void write();
  // Drops what follows the first `rows` in a file that was opened again.
  void truncate(hsize_t rows);
  hsize_t rows() const { return rows_; }  // in the file

 private:
  void create(hsize_t block);
  void open();

  Hdf5File* file_;
  std::string name_;
  std::vector<hsize_t> shape_;
  std::size_t row_size_ = 1;
  hsize_t rows_ = 0;
  Hdf5Id data_set_;
  std::vector<Value> buffer_;
};

extern template class Hdf5Series<double>;
extern template class Hdf5Series<int>;

}  // namespace nsframe
