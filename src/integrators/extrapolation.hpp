// Extrapolation of a sequence of vectors by backward differences, with the order that would have foretold the last one best:
// the error of order k is the difference of order k + 1 (as in variable-order Adams methods; Shampine and Gordon 1975).
#pragma once

#include <string>
#include <vector>

#include "models/snapshot.hpp"

namespace nsframe {

class Extrapolation {
 public:
  void clear() { differences_.clear(); }
  bool empty() const { return differences_.empty(); }
  void add(const VectorX& value);
  // The next one, as far as can be told; not when empty.
  const VectorX& next() const { return next_; }

  void save(const std::string& name, Snapshot& snapshot) const;
  void restore(const std::string& name, Eigen::Index size, const Snapshot& snapshot);

 private:
  void foretell();
  std::vector<VectorX> differences_;  // of order 0, 1, ... at the last value
  VectorX next_, work_;
};

}  // namespace nsframe
