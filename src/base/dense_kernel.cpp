#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "base/dense_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/dense_kernel.hpp"

HWY_BEFORE_NAMESPACE();
namespace nsframe {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A block of `vectors` SIMD registers of rows, all columns: the sums stay in registers.
template <int vectors>
void multiply_rows(const double* A, int rows, int columns, const double* x, double* y) {
  const hn::ScalableTag<double> tag;
  const auto width = static_cast<int>(hn::Lanes(tag));
  hn::Vec<decltype(tag)> sum[vectors];
  for (int k = 0; k < vectors; ++k) sum[k] = hn::Zero(tag);
  for (int j = 0; j < columns; ++j) {
    const auto factor = hn::Set(tag, x[j]);
    const double* const column = A + static_cast<long>(j) * rows;
    for (int k = 0; k < vectors; ++k) sum[k] = hn::MulAdd(hn::LoadU(tag, column + k * width), factor, sum[k]);
  }
  for (int k = 0; k < vectors; ++k) hn::StoreU(sum[k], tag, y + k * width);
}

void multiply_target(const double* A, int rows, int columns, const double* x, double* y) {
  const auto width = static_cast<int>(hn::Lanes(hn::ScalableTag<double>()));
  int row = 0;
  for (; row + 8 * width <= rows; row += 8 * width) multiply_rows<8>(A + row, rows, columns, x, y + row);
  for (; row + 4 * width <= rows; row += 4 * width) multiply_rows<4>(A + row, rows, columns, x, y + row);
  for (; row + width <= rows; row += width) multiply_rows<1>(A + row, rows, columns, x, y + row);
}

}  // namespace HWY_NAMESPACE
}  // namespace nsframe
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nsframe {

HWY_EXPORT(multiply_target);

void dense_multiply(const double* A, int rows, int columns, const double* x, double* y) {
  HWY_DYNAMIC_DISPATCH(multiply_target)(A, rows, columns, x, y);
}

}  // namespace nsframe
#endif
