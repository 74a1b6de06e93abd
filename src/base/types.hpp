// Names for the vectors and matrices used everywhere; all computing is in double precision, SI units.
#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <limits>

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

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double machine_epsilon = std::numeric_limits<double>::epsilon();

}  // namespace nsframe
