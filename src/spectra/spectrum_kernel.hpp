// What the SIMD kernel of spectra works on.
#pragma once

#include <cstddef>
#include <span>

namespace nsframe {

inline constexpr std::size_t block_periods = 16;

// Oscillators of one block; unused places repeat the last period.
struct SpectrumBlock {
  double piece = 0;  // [s]
  int pieces = 1;    // of a step of the record
  alignas(64) double uu[block_periods], uv[block_periods], ua[block_periods], ub[block_periods];
  alignas(64) double vu[block_periods], vv[block_periods], va[block_periods], vb[block_periods];
  alignas(64) double u[block_periods] = {}, v[block_periods] = {}, peak[block_periods] = {};
};

// Over the whole record; peaks at its samples, or also between them.
void run_block(SpectrumBlock& block, std::span<const double> acceleration, bool at_samples);

}  // namespace nsframe
