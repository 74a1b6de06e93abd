#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "base/dense_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "base/dense_kernel.hpp"

HWY_BEFORE_NAMESPACE();
namespace nsframe {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Writes a register at y + at, or what of it lies below `end`.
template <class D, class V>
void store_below(int end, D tag, V value, double* y, int at) {
  const auto width = static_cast<int>(hn::Lanes(tag));
  if (at + width <= end) {
    hn::StoreU(value, tag, y + at);
  } else if (at < end) {
    HWY_ALIGN double last[hn::MaxLanes(tag)];
    hn::Store(value, tag, last);
    std::copy_n(last, end - at, y + at);
  }
}

// A register of y + at, or what of it lies below `end`, and zeros.
template <class D>
hn::Vec<D> load_below(int end, D tag, const double* y, int at) {
  if (at + static_cast<int>(hn::Lanes(tag)) <= end) return hn::LoadU(tag, y + at);
  HWY_ALIGN double last[hn::MaxLanes(tag)] = {};
  if (at < end) std::copy_n(y + at, end - at, last);
  return hn::Load(tag, last);
}

// A block of `vectors` SIMD registers of rows from `row` on, all columns, for one or two right-hand sides: the sums stay in registers.
template <int vectors>
void multiply_rows(const DenseArray& A, int row, const double* x, double* y) {
  const hn::ScalableTag<double> tag;
  const auto width = static_cast<int>(hn::Lanes(tag));
  hn::Vec<decltype(tag)> sum[vectors];
  for (int k = 0; k < vectors; ++k) sum[k] = hn::Zero(tag);
  for (int j = 0; j < A.columns; ++j) {
    const double* const column = A.values + static_cast<long>(j) * A.padded_rows + row;
    const auto factor = hn::Set(tag, x[j]);
    for (int k = 0; k < vectors; ++k) sum[k] = hn::MulAdd(hn::LoadU(tag, column + k * width), factor, sum[k]);
  }
#pragma GCC unroll 8  // or the sums would stand in memory
  for (int k = 0; k < vectors; ++k) store_below(A.rows, tag, sum[k], y, row + k * width);
}

template <int vectors>
void multiply_rows(const DenseArray& A, int row, const double* start, const double* x, const double* x2, double* y, double* y2) {
  const hn::ScalableTag<double> tag;
  const auto width = static_cast<int>(hn::Lanes(tag));
  hn::Vec<decltype(tag)> sum[vectors], sum2[vectors];
#pragma GCC unroll 8  // or the sums would stand in memory
  for (int k = 0; k < vectors; ++k) {
    sum[k] = start ? load_below(A.rows, tag, start, row + k * width) : hn::Zero(tag);
    sum2[k] = hn::Zero(tag);
  }
  for (int j = 0; j < A.columns; ++j) {
    const double* const column = A.values + static_cast<long>(j) * A.padded_rows + row;
    const auto factor = hn::Set(tag, x[j]), factor2 = hn::Set(tag, x2[j]);
    for (int k = 0; k < vectors; ++k) {
      const auto entry = hn::LoadU(tag, column + k * width);
      sum[k] = hn::MulAdd(entry, factor, sum[k]);
      sum2[k] = hn::MulAdd(entry, factor2, sum2[k]);
    }
  }
#pragma GCC unroll 8
  for (int k = 0; k < vectors; ++k) {
    store_below(A.rows, tag, sum[k], y, row + k * width);
    store_below(A.rows, tag, sum2[k], y2, row + k * width);
  }
}

// Calls block<n>(row) for blocks of at most `most` registers, all of nearly one size: a short last block would wait for its sums.
template <int n, class Block>
void call_block(int size, int row, const Block& block) {
  if constexpr (n > 0) {
    if (size == n) {
      block.template operator()<n>(row);
    } else {
      call_block<n - 1>(size, row, block);
    }
  }
}

template <int most, class Block>
void over_rows(int rows, const Block& block) {
  const auto width = static_cast<int>(hn::Lanes(hn::ScalableTag<double>()));
  int left = rows / width, row = 0;
  for (int blocks = (left + most - 1) / most; blocks > 0; --blocks) {
    const int size = (left + blocks - 1) / blocks;
    call_block<most>(size, row, block);
    row += size * width;
    left -= size;
  }
}

void multiply_target(const DenseArray& A, const double* x, double* y) {
  over_rows<8>(A.padded_rows, [&]<int n>(int row) { multiply_rows<n>(A, row, x, y); });
}

void multiply_two_target(const DenseArray& A, const double* start, const double* x, const double* x2, double* y, double* y2) {
  over_rows<6>(A.padded_rows, [&]<int n>(int row) { multiply_rows<n>(A, row, start, x, x2, y, y2); });
}

void chunks_target(int chunks, bool backward, const int* begins, const int* ends, const int* columns, const double* values, const double* x,
                   double* y) {
  const hn::CappedTag<double, 4> tag;
  constexpr int width = static_cast<int>(hn::MaxLanes(hn::CappedTag<double, 4>())), vectors = 4 / width, ways = 4;
  for (int i = 0; i < chunks; ++i) {
    int j = begins[i];
    const int end = ends[i];
    const long row = 4L * (backward ? chunks - 1 - i : i);
    const double* const from = x + row;
    hn::Vec<decltype(tag)> sum[ways][vectors];
    for (auto& way : sum) {
      for (auto& part : way) part = hn::Zero(tag);
    }
    for (; j + ways <= end; j += ways) {
      for (int way = 0; way < ways; ++way) {
        const auto factor = hn::Set(tag, from[columns[j + way]]);
        const double* const column = values + 4L * (j + way);
        for (int k = 0; k < vectors; ++k) sum[way][k] = hn::MulAdd(hn::LoadU(tag, column + k * width), factor, sum[way][k]);
      }
    }
    for (; j < end; ++j) {
      const auto factor = hn::Set(tag, from[columns[j]]);
      for (int k = 0; k < vectors; ++k) sum[0][k] = hn::MulAdd(hn::LoadU(tag, values + 4L * j + k * width), factor, sum[0][k]);
    }
    for (int k = 0; k < vectors; ++k) {
      hn::StoreU(hn::Add(hn::Add(sum[0][k], sum[1][k]), hn::Add(sum[2][k], sum[3][k])), tag, y + row + k * width);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace nsframe
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nsframe {

HWY_EXPORT(multiply_target);
HWY_EXPORT(multiply_two_target);
HWY_EXPORT(chunks_target);

void dense_multiply(const DenseArray& A, const double* x, double* y) { HWY_DYNAMIC_DISPATCH(multiply_target)(A, x, y); }

void dense_multiply(const DenseArray& A, const double* start, const double* x, const double* x2, double* y, double* y2) {
  HWY_DYNAMIC_DISPATCH(multiply_two_target)(A, start, x, x2, y, y2);
}

void apply_chunks(int chunks, bool backward, const int* begin, const int* end, const int* columns, const double* values, const double* x,
                  double* y) {
  HWY_DYNAMIC_DISPATCH(chunks_target)(chunks, backward, begin, end, columns, values, x, y);
}

}  // namespace nsframe
#endif
