// BFGS with the tangent of the step's start (Matthies and Strang, Int. J. Num. Meth. Eng. 14, 1979, 1613-1626), its
// updates applied by the two-loop recursion of Nocedal (Math. Comp. 35, 1980, 773-782). A pair of move s and change of the
// residual y counts where s'y > 0; else the tangent is formed anew. The updates are symmetric: P-Delta and the row of a
// control, which are not, cost iterations, never the root.
#include <vector>

#include "integrators/algorithms.hpp"

namespace nsframe {

namespace {

class Bfgs : public Algorithm {
 public:
  int patience() const override { return 3; }
  void start() override { pairs_.clear(); }

  void iterate(NonlinearStep& step) override {
    if (pairs_.empty() || static_cast<int>(pairs_.size()) == most_updates) {
      pairs_.clear();
      step.factor(Tangent::current);
    }
    const VectorX before = step.residual();
    VectorX reduced = before, move;
    for (auto pair = pairs_.rbegin(); pair != pairs_.rend(); ++pair) {
      pair->share = pair->move.dot(reduced) / pair->work;
      reduced -= pair->share * pair->change;
    }
    step.solve(reduced, move);
    for (const Pair& pair : pairs_) move += (pair.share - pair.change.dot(move) / pair.work) * pair.move;
    move = -move;
    step.move(move);
    const VectorX change = step.residual() - before;
    const double work = move.dot(change);
    if (work > least_cosine * move.norm() * change.norm()) {
      pairs_.push_back({move, change, work, 0});
    } else {
      pairs_.clear();
    }
  }

 private:
  static constexpr int most_updates = 15;  // after which the tangent is formed anew
  static constexpr double least_cosine = 1e-8;
  struct Pair {
    VectorX move, change;
    double work;   // move' change
    double share;  // of the residual, in the recursion
  };
  std::vector<Pair> pairs_;
};

}  // namespace

std::unique_ptr<Algorithm> make_bfgs() { return std::make_unique<Bfgs>(); }

}  // namespace nsframe
