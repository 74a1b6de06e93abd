// Krylov-subspace acceleration of modified Newton (Carlson and Miller, SIAM J. Sci. Comput. 19, 1998, 728-765; for
// structures Scott and Fenves, J. Struct. Eng. 136, 2010, 476-480): corrections f = -J0^-1 R of earlier iterates tell by
// their differences what the tangent has become; the part of f in their span is corrected by what was seen there.
#include <utility>

#include "base/decompositions.hpp"
#include "integrators/algorithms.hpp"

namespace nsframe {

namespace {

class Krylov : public Algorithm {
 public:
  int patience() const override { return 3; }
  void start() override { moves_.clear(); }

  void iterate(NonlinearStep& step) override {
    if (moves_.empty() || static_cast<int>(moves_.size()) == dimension) {
      moves_.clear();
      changes_.clear();
      step.factor(Tangent::current);
      step.solve(step.residual(), correction_);
      correction_ = -correction_;
    } else {
      step.solve(step.residual(), next_);
      next_ = -next_;
      changes_.push_back(correction_ - next_);
      std::swap(correction_, next_);
    }
    VectorX move = correction_;
    if (!changes_.empty()) {
      const auto count = static_cast<Eigen::Index>(changes_.size());
      MatrixX changes(correction_.size(), count), moves(correction_.size(), count);
      for (Eigen::Index i = 0; i < count; ++i) {
        changes.col(i) = changes_[static_cast<std::size_t>(i)];
        moves.col(i) = moves_[static_cast<std::size_t>(i)];
      }
      const VectorX c = changes.colPivHouseholderQr().solve(correction_);
      move += (moves - changes) * c;
    }
    moves_.push_back(move);
    step.move(move);
  }

 private:
  static constexpr int dimension = 6;  // of the subspace, after which the tangent is formed anew
  std::vector<VectorX> moves_, changes_;  // of x, and of the corrections they brought
  VectorX correction_, next_;
};

}  // namespace

std::unique_ptr<Algorithm> make_krylov() { return std::make_unique<Krylov>(); }

}  // namespace nsframe
