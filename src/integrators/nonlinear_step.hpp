// One step of a nonlinear problem R(x) = 0, static or in time, as the solution algorithms see it.
//
// An algorithm commands changes of x; the step applies them and evaluates anew. Where contact takes part, `move` projects
// onto the contact law with the factors in use, so that x and the impulses obey it at every iterate whatever the
// algorithm commands; R includes the impulses, and changes with the commanded change as without contact (theory.md, 90).
#pragma once

#include "base/types.hpp"
#include "elements/element_group.hpp"

namespace nsframe {

enum class Tangent { current, initial };

class NonlinearStep {
 public:
  virtual ~NonlinearStep() = default;

  virtual void restart() = 0;                     // x at its first guess, R evaluated there
  virtual const VectorX& residual() const = 0;    // R
  virtual double error() const = 0;               // of R over what is tolerated: at most 1 when converged
  virtual void factor(Tangent which) = 0;         // J = dR/dx at x, or from the initial stiffness
  virtual void solve(const VectorX& rhs, VectorX& x) = 0;  // x = J^-1 rhs
  virtual void move(const VectorX& change) = 0;   // x += change, R evaluated there

  // The first guess is one that may solve the step, as if an iteration had been made.
  virtual bool guess_may_stand() const { return false; }

  // Elements that iterate for their own balance may leave what is out of it to the next evaluation, until settle(): for algorithms that
  // need R at a point once only, since another evaluation there differs by what was left (theory.md, 387).
  void carry(bool may) { determination_ = may ? StateDetermination::one_pass : StateDetermination::iterated; }
  // Iterates at x what elements have left, and evaluates R anew; error() before that says nothing final.
  virtual void settle() {}

  // Factors of an earlier step may serve; and the reduction of R by an iteration above which they no longer do.
  virtual bool has_factors() const { return false; }
  virtual double slow_reduction() const { return 0; }

 protected:
  StateDetermination determination() const { return determination_; }

 private:
  StateDetermination determination_ = StateDetermination::iterated;
};

}  // namespace nsframe
