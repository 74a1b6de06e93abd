// The motion of chosen nodes from the free DOFs, at the cost of those nodes only.
#pragma once

#include <string>
#include <vector>

#include "models/model.hpp"

namespace nsframe {

// Rows of the transformation u = T q, packed in the order they are asked for.
class TransformationRows {
 public:
  TransformationRows() = default;
  TransformationRows(const DofMap& dofs, const std::vector<int>& full_dofs);

  int size() const { return static_cast<int>(begin_.size()) - 1; }
  double value(int row, const double* q) const {
    double sum = 0;
    for (int k = begin_[static_cast<std::size_t>(row)]; k < begin_[static_cast<std::size_t>(row) + 1]; ++k) {
      sum += factor_[static_cast<std::size_t>(k)] * q[column_[static_cast<std::size_t>(k)]];
    }
    return sum;
  }
  void multiply(const double* q, double* values) const {
    for (int row = 0; row < size(); ++row) values[row] = value(row, q);
  }

 private:
  std::vector<int> begin_{0};
  std::vector<int> column_;
  std::vector<double> factor_;
};

// Indices of the named nodes ("structure.node"), in that order; all nodes when `names` is empty. Throws InputError
// with the nearest name for one that does not exist.
std::vector<int> find_nodes(const Nodes& nodes, const std::vector<std::string>& names);

// The chosen directions (0..5) of each of the nodes, node by node.
std::vector<int> full_dofs(const std::vector<int>& nodes, const std::vector<int>& directions);

// Velocity and acceleration of the base at `time`, summed over the motions [m/s], [m/s2].
Vector3 ground_velocity(const Model& model, double time);
Vector3 ground_acceleration(const Model& model, double time);

}  // namespace nsframe
