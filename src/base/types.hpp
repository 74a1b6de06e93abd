// Names for the vectors and matrices used everywhere; all computing is in double precision, SI units.
#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <limits>
#include <vector>

namespace nsframe {

using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Vector12 = Eigen::Matrix<double, 12, 1>;
using VectorX = Eigen::VectorXd;
using Matrix3 = Eigen::Matrix3d;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix12 = Eigen::Matrix<double, 12, 12>;
using MatrixX = Eigen::MatrixXd;
using SparseMatrix = Eigen::SparseMatrix<double>;                       // by columns
using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;        // by rows

// Doubles of a line of cache and of the widest SIMD register: what begins at a multiple of these is read in one piece. All memory of
// Eigen's and of AlignedVector begins there (EIGEN_MAX_ALIGN_BYTES).
inline constexpr int aligned_doubles = 8;
using AlignedVector = std::vector<double, Eigen::aligned_allocator<double>>;

// The next multiple of aligned_doubles.
constexpr int aligned_size(int doubles) { return (doubles + aligned_doubles - 1) / aligned_doubles * aligned_doubles; }

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double machine_epsilon = std::numeric_limits<double>::epsilon();

}  // namespace nsframe
