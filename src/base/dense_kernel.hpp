// Products of small dense matrices and of chunks of four rows, by the widest SIMD the machine has (Highway, chosen at run time).
#pragma once

namespace nsframe {

inline constexpr int dense_row_padding = 8;  // rows of A are padded to a multiple of this

// Column-major values; `padded_rows`, a multiple of dense_row_padding, from one column to the next, of which `rows` count.
struct DenseArray {
  const double* values;
  int padded_rows, rows, columns;
};
// y = A x. x: `columns`; y: `rows`.
void dense_multiply(const DenseArray& A, const double* x, double* y);
// y = start + A x and y2 = A x2 in one pass over A; without `start` where it is null.
void dense_multiply(const DenseArray& A, const double* start, const double* x, const double* x2, double* y, double* y2);

// Chunk after chunk as they are stored, the last rows first where `backward`: y of its four rows = sum over its columns of four values
// times x[column], columns counted from its first row (chunked_rows.hpp). x and y may be the same: a chunk then reads what those before it
// have written.
void apply_chunks(int chunks, bool backward, const int* begin, const int* end, const int* columns, const double* values, const double* x,
                  double* y);

}  // namespace nsframe
