#include "contact/profile_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace nsframe {

namespace {

constexpr double wide = 0.3;  // share of entries from which another order is tried

using Segment = Eigen::Map<const VectorX>;

// Cuthill and McKee's order, reversed, of the graph of the entries above `negligible`; empty where these are many.
std::vector<int> near_order(const MatrixX& W, const VectorX& scale, double negligible) {
  const auto n = static_cast<int>(W.rows());
  std::vector<std::vector<int>> neighbours(static_cast<std::size_t>(n));
  double entries = 0;
  for (int j = 0; j < n; ++j) {
    std::vector<int>& near = neighbours[static_cast<std::size_t>(j)];
    for (int i = 0; i < n; ++i) {
      if (i != j && std::abs(W(i, j)) * scale[i] * scale[j] > negligible) near.push_back(i);
    }
    entries += static_cast<double>(near.size());
    if (entries > wide * n * n) return {};
  }
  const auto fewer = [&](int a, int b) { return neighbours[static_cast<std::size_t>(a)].size() < neighbours[static_cast<std::size_t>(b)].size(); };
  std::vector<int> by_degree(static_cast<std::size_t>(n)), order;
  std::iota(by_degree.begin(), by_degree.end(), 0);
  std::stable_sort(by_degree.begin(), by_degree.end(), fewer);
  std::vector<bool> seen(static_cast<std::size_t>(n), false);
  for (const int start : by_degree) {
    if (seen[static_cast<std::size_t>(start)]) continue;
    seen[static_cast<std::size_t>(start)] = true;
    order.push_back(start);
    for (std::size_t at = order.size() - 1; at < order.size(); ++at) {
      const std::size_t begin = order.size();
      for (const int next : neighbours[static_cast<std::size_t>(order[at])]) {
        if (seen[static_cast<std::size_t>(next)]) continue;
        seen[static_cast<std::size_t>(next)] = true;
        order.push_back(next);
      }
      std::stable_sort(order.begin() + static_cast<std::ptrdiff_t>(begin), order.end(), fewer);
    }
  }
  std::reverse(order.begin(), order.end());
  return order;
}

}  // namespace

ProfileMatrix::ProfileMatrix(const MatrixX& W, const VectorX& scale, double negligible) : order_(static_cast<std::size_t>(W.rows())) {
  std::iota(order_.begin(), order_.end(), 0);
  find_profile(W, scale, negligible);
  if (share() > wide) {
    const std::vector<int> near = near_order(W, scale, negligible);
    if (!near.empty()) {
      const std::vector<int> natural = std::exchange(order_, near);
      const std::size_t before = begin_.back();
      find_profile(W, scale, negligible);
      if (begin_.back() >= before) {
        order_ = natural;
        find_profile(W, scale, negligible);
      }
    }
  }
  values_.resize(begin_.back());
  for (int i = 0; i < rows(); ++i) {
    const int row = order_[static_cast<std::size_t>(i)];
    double* const to = values_.data() + begin_[static_cast<std::size_t>(i)];
    for (int j = first(i); j <= last_[static_cast<std::size_t>(i)]; ++j) {
      const int column = order_[static_cast<std::size_t>(j)];
      to[j - first(i)] = W(column, row) * (scale[column] * scale[row]);  // by columns of W, as it is symmetric
    }
  }
}

void ProfileMatrix::find_profile(const MatrixX& W, const VectorX& scale, double negligible) {
  const int n = rows();
  first_.resize(static_cast<std::size_t>(n));
  last_.resize(static_cast<std::size_t>(n));
  begin_.assign(1, 0);
  for (int i = 0; i < n; ++i) {
    const int row = order_[static_cast<std::size_t>(i)];
    const double* const column = W.col(row).data();
    const double least = negligible / scale[row];
    const auto counts = [&](int j) {
      const int other = order_[static_cast<std::size_t>(j)];
      return std::abs(column[other]) * scale[other] > least;
    };
    int first = 0, last = n - 1;
    while (first < i && !counts(first)) ++first;
    while (last > i && !counts(last)) --last;
    first_[static_cast<std::size_t>(i)] = first;
    last_[static_cast<std::size_t>(i)] = last;
    begin_.push_back(begin_.back() + static_cast<std::size_t>(last - first + 1));
  }
}

double ProfileMatrix::share() const { return static_cast<double>(begin_.back()) / (static_cast<double>(rows()) * rows()); }

double ProfileMatrix::entry(int row, int column) const {
  const auto i = static_cast<std::size_t>(row);
  return column < first_[i] || column > last_[i] ? 0 : values_[begin_[i] + static_cast<std::size_t>(column - first_[i])];
}

void ProfileMatrix::gather(int row, const std::vector<int>& columns, double* to) const {
  for (const int column : columns) *to++ = entry(row, column);
}

bool ProfileMatrix::symmetric(double tolerance) const {
  for (int i = 0; i < rows(); ++i) {
    for (int j = first(i); j < i; ++j) {
      if (std::abs(entry(i, j) - entry(j, i)) > tolerance) return false;
    }
    for (int j = i + 1; j <= last_[static_cast<std::size_t>(i)]; ++j) {
      if (first(j) > i && std::abs(entry(i, j)) > tolerance) return false;
    }
  }
  return true;
}

void ProfileMatrix::multiply(const VectorX& p, VectorX& product, VectorX& size) const {
  product.resize(rows());
  size.resize(rows());
  const VectorX magnitude = p.cwiseAbs();
  for (int i = 0; i < rows(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const Eigen::Index count = last_[at] - first_[at] + 1;
    const Segment row(values_.data() + begin_[at], count);
    product[i] = row.dot(p.segment(first_[at], count));
    size[i] = row.cwiseAbs().dot(magnitude.segment(first_[at], count));
  }
}

bool ProfileFactor::compute(const ProfileMatrix& matrix, const std::vector<int>& set, double least) {
  const auto n = static_cast<int>(set.size());
  first_.resize(set.size());
  begin_.assign(1, 0);
  for (int k = 0; k < n; ++k) {
    const int row_first = matrix.first(set[static_cast<std::size_t>(k)]);
    const auto from = static_cast<int>(std::lower_bound(set.begin(), set.begin() + k, row_first) - set.begin());
    first_[static_cast<std::size_t>(k)] = from;
    begin_.push_back(begin_.back() + static_cast<std::size_t>(k - from + 1));
  }
  values_.resize(begin_.back());
  for (int k = 0; k < n; ++k) {
    const int begin = first_[static_cast<std::size_t>(k)], at = set[static_cast<std::size_t>(k)];
    double* const L = values_.data() + begin_[static_cast<std::size_t>(k)];
    double pivot = matrix.entry(at, at);
    for (int j = begin; j < k; ++j) {
      const int other = first_[static_cast<std::size_t>(j)], shared = std::max(begin, other);
      const Segment own(L + (shared - begin), j - shared), earlier(row(j) + (shared - other), j - shared);
      L[j - begin] = (matrix.entry(at, set[static_cast<std::size_t>(j)]) - own.dot(earlier)) / row(j)[j - other];
      pivot -= L[j - begin] * L[j - begin];
    }
    if (!(pivot > least)) return false;
    L[k - begin] = std::sqrt(pivot);
  }
  return true;
}

void ProfileFactor::solve(VectorX& x) const {
  const auto n = static_cast<int>(first_.size());
  for (int k = 0; k < n; ++k) {
    const int begin = first_[static_cast<std::size_t>(k)];
    x[k] = (x[k] - Segment(row(k), k - begin).dot(x.segment(begin, k - begin))) / row(k)[k - begin];
  }
  for (int k = n - 1; k >= 0; --k) {
    const int begin = first_[static_cast<std::size_t>(k)];
    x[k] /= row(k)[k - begin];
    x.segment(begin, k - begin) -= x[k] * Segment(row(k), k - begin);
  }
}

}  // namespace nsframe
