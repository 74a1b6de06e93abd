// Floor spectra of a finished run, from its results.h5.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace nsframe {

struct FloorSpectraTable {
  double damping = 0;
  std::vector<std::string> nodes;
  std::vector<double> periods;       // [s]
  std::vector<double> displacement;  // largest, relative to the floor [m]: node by node, x y z, period by period
  std::vector<double> along(std::size_t node, int direction) const {
    const auto first = displacement.begin() +
                       static_cast<std::ptrdiff_t>((3 * node + static_cast<std::size_t>(direction)) * periods.size());
    return {first, first + static_cast<std::ptrdiff_t>(periods.size())};
  }
};

// Throws IoError when there is no such file, InputError when it has no floor spectra.
FloorSpectraTable read_floor_spectra(const std::filesystem::path& file);

}  // namespace nsframe
