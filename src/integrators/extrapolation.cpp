#include "integrators/extrapolation.hpp"

namespace nsframe {

namespace {

constexpr std::size_t most_differences = 5;

}  // namespace

void Extrapolation::add(const VectorX& value) {
  work_ = value;
  for (VectorX& difference : differences_) {
    difference.swap(work_);       // the new one in its place, the old one in hand
    work_ = difference - work_;   // the new one of the next order
  }
  if (differences_.size() < most_differences) differences_.push_back(work_);
  foretell();
}

// The highest difference only judges the order below it.
void Extrapolation::foretell() {
  std::size_t best = 0;
  for (std::size_t k = 1; k + 1 < differences_.size(); ++k) {
    if (differences_[k + 1].squaredNorm() < differences_[best + 1].squaredNorm()) best = k;
  }
  next_ = differences_.front();
  for (std::size_t k = 1; k <= best; ++k) next_ += differences_[k];
}

void Extrapolation::save(const std::string& name, Snapshot& snapshot) const {
  std::vector<double> all;
  for (const VectorX& difference : differences_) all.insert(all.end(), difference.begin(), difference.end());
  snapshot.put(name, std::move(all));
}

void Extrapolation::restore(const std::string& name, Eigen::Index size, const Snapshot& snapshot) {
  clear();
  const std::vector<double>& all = snapshot.array(name);
  for (Eigen::Index first = 0; first < static_cast<Eigen::Index>(all.size()); first += size) {
    differences_.push_back(Eigen::Map<const VectorX>(all.data() + first, size));
  }
  if (!empty()) foretell();
}

}  // namespace nsframe
