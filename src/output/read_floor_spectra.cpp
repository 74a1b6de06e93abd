#include "output/read_floor_spectra.hpp"

#include <fmt/format.h>

#include "base/errors.hpp"
#include "output/hdf5_file.hpp"

namespace nsframe {

namespace {

hid_t require(hid_t id, const std::filesystem::path& file, const char* what) {
  if (id < 0) throw IoError(fmt::format("error: cannot read {} of '{}'", what, file.string()));
  return id;
}

std::size_t size_of(const Hdf5Id& set) {
  const Hdf5Id space(H5Dget_space(set), H5Sclose);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  return count < 0 ? 0 : static_cast<std::size_t>(count);
}

std::vector<double> numbers(const Hdf5Id& root, const char* name, const std::filesystem::path& file) {
  const Hdf5Id set(require(H5Dopen2(root, name, H5P_DEFAULT), file, name), H5Dclose);
  std::vector<double> out(size_of(set));
  require(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, out.data()), file, name);
  return out;
}

std::vector<std::string> texts(const Hdf5Id& root, const char* name, const std::filesystem::path& file) {
  const Hdf5Id set(require(H5Dopen2(root, name, H5P_DEFAULT), file, name), H5Dclose);
  const Hdf5Id type(H5Dget_type(set), H5Tclose);
  if (H5Tis_variable_str(type) <= 0) throw IoError(fmt::format("error: {} of '{}' are no texts", name, file.string()));
  std::vector<char*> raw(size_of(set));
  require(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, raw.data()), file, name);
  std::vector<std::string> out(raw.begin(), raw.end());
  const Hdf5Id space(H5Dget_space(set), H5Sclose);
  H5Dvlen_reclaim(type, space, H5P_DEFAULT, raw.data());
  return out;
}

}  // namespace

FloorSpectraTable read_floor_spectra(const std::filesystem::path& file) {
  const QuietHdf5 quiet;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
    throw IoError(fmt::format("error: there is no '{}': is this a folder of results?", file.string()));
  const Hdf5Id root(require(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), file, "the contents"), H5Fclose);
  if (H5Lexists(root, "/floor_spectra", H5P_DEFAULT) <= 0)
    throw InputError(
        fmt::format("error: '{}' has no floor spectra: the scene must ask for them, output.floor_spectra = {{ nodes = "
                    "[\"floors\"] }}",
                    file.string()));
  FloorSpectraTable out;
  const Hdf5Id group(require(H5Gopen2(root, "/floor_spectra", H5P_DEFAULT), file, "floor_spectra"), H5Gclose);
  const Hdf5Id damping(require(H5Aopen(group, "damping", H5P_DEFAULT), file, "the damping"), H5Aclose);
  require(H5Aread(damping, H5T_NATIVE_DOUBLE, &out.damping), file, "the damping");
  out.nodes = texts(root, "/floor_spectra/node", file);
  out.periods = numbers(root, "/floor_spectra/period", file);
  out.displacement = numbers(root, "/floor_spectra/displacement", file);
  if (out.displacement.size() != 3 * out.nodes.size() * out.periods.size())
    throw IoError(fmt::format("error: the floor spectra of '{}' are incomplete", file.string()));
  return out;
}

}  // namespace nsframe
