// Internal force and tangent of the whole model in free DOFs: linear elements are assembled once, the others are
// evaluated in parallel and summed in a fixed order, so results do not depend on the number of threads.
#pragma once

#include <exception>
#include <vector>

#include "base/block_operator.hpp"
#include "models/model.hpp"
#include "models/results.hpp"
#include "models/state.hpp"

namespace nsframe {

class Assembler {
 public:
  explicit Assembler(const Model& model, int threads = 1);

  // No element needs to be evaluated again: P = K q.
  bool linear() const { return nonlinear_.empty(); }
  bool symmetric() const { return symmetric_; }
  const std::vector<BlockRange>& blocks() const { return blocks_; }
  int threads() const { return threads_; }
  long fibers() const { return fibers_; }
  // Of the stiffness of linear elements.
  StoredEntries stiffness_entries() const { return linear_operator_.entries(); }
  int linear_elements() const { return static_cast<int>(linear_.size()); }
  // Fibers in quiet sections (screening.hpp).
  long quiet_fibers(const VectorX& history) const;
  // Names of the members that may have had several states at one deformation (theory.md, 173).
  std::vector<std::string> softened_members(const VectorX& history) const;

  VectorX virgin_history() const;

  // To be called before the first internal_force() of every attempted step.
  void start_step(const VectorX& committed_history, VectorX& trial_history) const;

  // The part of the loads on members that is in the history of nonlinear ones (0 in a virgin history), and its change.
  double load_factor(const VectorX& history) const;
  void set_load_factor(double factor, VectorX& history) const;
  // What a unit of that part gives to the nodes in a state [N, N m], by differences; zero without loads on nonlinear members.
  VectorX member_loads(const VectorX& displacement, const VectorX& history);

  // P(q) [N, N m], less the loads on nonlinear members, at `displacement`; writes the trial history, and keeps the tangent
  // for tangent() where it is wanted: it costs about as much as the force. A state that is to be kept needs its elements iterated: at
  // once, or in a last call for the `remaining` ones, `with_tangent` as in the call before.
  void internal_force(const VectorX& displacement, const VectorX& committed_history, VectorX& trial_history, VectorX& force,
                      bool with_tangent = true, StateDetermination how = StateDetermination::iterated);
  // The same force without what linear elements carry; tangent() has them all the same.
  void nonlinear_force(const VectorX& displacement, const VectorX& committed_history, VectorX& trial_history, VectorX& force, bool with_tangent,
                       StateDetermination how = StateDetermination::iterated);
  // The last internal_force() left elements with more out of balance than they tolerate.
  bool unsettled() const { return !unsettled_.empty(); }
  // Of elements that iterate for their own balance, since the program began.
  const StateWorkSums& state_work() const { return work_; }
  void set_state_work(const StateWorkSums& sums) { work_ = sums; }
  // What moved supports add to every internal_force() from now on: displacements of nodes, for the elements that are evaluated, full
  // DOFs, and the force of the others [N, N m], free DOFs. Empty: nothing.
  void move_supports(const VectorX& displacement, const VectorX& force) {
    support_displacement_ = displacement;
    support_force_ = force;
  }
  // Forces at nodes of the elements that the last internal_force() evaluated, full DOFs [N, N m].
  const VectorX& evaluated_force() const { return full_force_; }
  // The part of P(q) that linear elements carry.
  void linear_force(const VectorX& displacement, VectorX& force) const { linear_operator_.multiply(displacement, force); }
  SparseMatrix linear_stiffness() const;  // of linear elements, in the pattern of tangent()
  // dP/dq at the last internal_force() with tangent; same pattern always.
  const SparseMatrix& tangent() const { return tangent_; }
  // That was the last internal_force() of all.
  bool tangent_is_current() const { return tangent_is_current_; }

  // Some element's force depends on the rate of deformation. Then, after internal_force(): what the step that leads from
  // the committed history to its displacement adds, at the theta point of the step [N, N m]; writes its part of the trial
  // history, and keeps the derivative by the displacement.
  bool rate_dependent() const { return !rates_.empty(); }
  RateEnergy rate_force(const VectorX& committed_history, VectorX& trial_history, const StepSpan& step, VectorX& force);
  // Adds the derivative to a matrix of the pattern of tangent().
  void add_rate_tangent(double factor, SparseMatrix& stiffness) const;

  // Half the change of the tangent from `displacement` - `step` to + `step` while the material keeps its tangents at
  // `displacement`; overwrites the trial history.
  SparseMatrix geometric_change(const VectorX& displacement, const VectorX& step, double load_step, const VectorX& committed_history,
                                VectorX& trial_history) const;

  // The element whose nodes carry the largest part of `residual` (free DOFs), for messages.
  std::string worst_element(const VectorX& residual) const;

 private:
  struct Placed {                    // an element with its place in the reduced system
    const ElementGroup* group;
    int element;
    int history_begin;
    std::vector<int> dofs;           // free DOFs it acts on
    MatrixX map;                     // 12 x dofs: u = map q
    std::vector<int> position;       // of every entry (column-major, dofs x dofs) in tangent_.valuePtr()
    std::vector<int> local;          // without constraints: the local DOF of every free DOF, and `map` is a selection
  };
  void count_work(const VectorX& trial, const std::vector<std::size_t>& evaluated, StateDetermination how);
  Placed place(const ElementGroup& group, int element, int history_begin) const;
  void scatter(const Placed& placed, const Matrix12& tangent, double* values) const;

  const Model& model_;
  int threads_;
  bool symmetric_ = true;
  long fibers_ = 0;
  std::vector<BlockRange> blocks_;
  std::vector<Placed> linear_, nonlinear_;
  std::vector<std::size_t> rates_;   // of nonlinear_, those with rate-dependent forces
  std::vector<std::size_t> iterating_;  // of nonlinear_, those that iterate for their own balance
  std::vector<std::size_t> unsettled_;  // of these, those that the last evaluation left out of balance
  StateWorkSums work_;
  SparseMatrix tangent_;
  bool tangent_is_current_ = true;
  std::vector<double> rate_values_;
  std::vector<double> linear_values_;
  BlockOperator linear_operator_;
  std::vector<Vector12> forces_;
  std::vector<std::exception_ptr> failures_;
  std::vector<Matrix12, Eigen::aligned_allocator<Matrix12>> tangents_;
  VectorX full_displacement_, full_force_, full_rate_force_, nonlinear_force_;
  VectorX support_displacement_, support_force_;
};

}  // namespace nsframe
