// y = A x for a small dense matrix, by the widest SIMD the machine has (Highway, chosen at run time).
#pragma once

namespace nsframe {

inline constexpr int dense_row_padding = 8;  // rows of A are padded to a multiple of this

// A: column-major, `rows` a multiple of dense_row_padding; x: `columns`; y: `rows`.
void dense_multiply(const double* A, int rows, int columns, const double* x, double* y);
// y = A x and y2 = A x2 in one pass over A.
void dense_multiply(const double* A, int rows, int columns, const double* x, const double* x2, double* y, double* y2);

}  // namespace nsframe
