// J^-1 h' of a row h of contact with a factored matrix J = J0 + U U' a (theory.md, 200-202): of J0^-1 h', which dies out from story to
// story, the DOFs around the pair; of the modal damping, which reaches all, its few coefficients on the columns of J0^-1 U.
#pragma once

#include <vector>

#include "base/types.hpp"

namespace nsframe {

class ContactResponse {
 public:
  ContactResponse() = default;
  // Of so many DOFs, zero.
  explicit ContactResponse(Eigen::Index dofs) : dofs_(dofs) {}
  // Adds a structure of DOFs from `first` on: values - columns * coefficients. `columns` must outlive this. What is negligible at both ends
  // of `values` is left out.
  void add(int first, const VectorX& values);
  void add(int first, const VectorX& values, const MatrixX& columns, VectorX coefficients);

  Eigen::Index size() const { return dofs_; }
  std::size_t entries() const { return entries_; }  // stored
  VectorX vector() const;
  // rows.row(row) times it.
  double rate(const SparseRows& rows, Eigen::Index row) const;
  // x += factor times it.
  void add_to(double factor, VectorX& x) const;

 private:
  friend class SummedResponses;
  struct Part {
    int first = 0, near = 0;           // DOFs at which the structure and `values` begin
    VectorX values;
    const MatrixX* columns = nullptr;  // null without modal damping
    VectorX coefficients;
  };
  Eigen::Index dofs_ = 0;
  std::size_t entries_ = 0;
  std::vector<Part> parts_;
};

// x = the sum of responses times factors, with one product by a structure's columns for all of them.
class SummedResponses {
 public:
  SummedResponses(VectorX& x, Eigen::Index dofs) : x_(x) { x_.setZero(dofs); }
  void add(double factor, const ContactResponse& response);
  void finish();

 private:
  struct Modal {
    int first = 0;
    const MatrixX* columns = nullptr;
    VectorX coefficients;
  };
  VectorX& x_;
  std::vector<Modal> modal_;
};

}  // namespace nsframe
