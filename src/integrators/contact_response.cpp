#include "integrators/contact_response.hpp"

#include <algorithm>

namespace nsframe {

namespace {

constexpr double negligible_response = 1e-22;  // of a structure's largest: far below what rounding leaves of it, in any unit

}  // namespace

void ContactResponse::add(int first, const VectorX& values) {
  const double least = negligible_response * values.cwiseAbs().maxCoeff();
  Eigen::Index begin = 0, end = values.size();
  while (begin < end && std::abs(values[begin]) <= least) ++begin;
  while (end > begin && std::abs(values[end - 1]) <= least) --end;
  parts_.push_back({first, first + static_cast<int>(begin), values.segment(begin, end - begin), nullptr, {}});
  entries_ += static_cast<std::size_t>(end - begin);
}

void ContactResponse::add(int first, const VectorX& values, const MatrixX& columns, VectorX coefficients) {
  add(first, values);
  entries_ += static_cast<std::size_t>(coefficients.size());
  parts_.back().columns = &columns;
  parts_.back().coefficients = std::move(coefficients);
}

VectorX ContactResponse::vector() const {
  VectorX x = VectorX::Zero(dofs_);
  add_to(1, x);
  return x;
}

double ContactResponse::rate(const SparseRows& rows, Eigen::Index row) const {
  double sum = 0;
  for (SparseRows::InnerIterator entry(rows, row); entry; ++entry) {
    for (const Part& part : parts_) {
      const Eigen::Index near = entry.col() - part.near, own = entry.col() - part.first;
      if (near >= 0 && near < part.values.size()) sum += entry.value() * part.values[near];
      if (part.columns && own >= 0 && own < part.columns->rows()) sum -= entry.value() * part.columns->row(own).dot(part.coefficients);
    }
  }
  return sum;
}

void ContactResponse::add_to(double factor, VectorX& x) const {
  for (const Part& part : parts_) {
    x.segment(part.near, part.values.size()) += factor * part.values;
    if (part.columns) x.segment(part.first, part.columns->rows()).noalias() -= *part.columns * (factor * part.coefficients);
  }
}

void SummedResponses::add(double factor, const ContactResponse& response) {
  for (const ContactResponse::Part& part : response.parts_) {
    x_.segment(part.near, part.values.size()) += factor * part.values;
    if (!part.columns) continue;
    const auto known = std::find_if(modal_.begin(), modal_.end(), [&](const Modal& modal) { return modal.columns == part.columns; });
    if (known == modal_.end()) {
      modal_.push_back({part.first, part.columns, factor * part.coefficients});
    } else {
      known->coefficients += factor * part.coefficients;
    }
  }
}

void SummedResponses::finish() {
  for (const Modal& modal : modal_) x_.segment(modal.first, modal.columns->rows()).noalias() -= *modal.columns * modal.coefficients;
}

}  // namespace nsframe
