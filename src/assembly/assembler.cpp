#include "assembly/assembler.hpp"

#include <algorithm>
#include <cmath>
#include <exception>

#include "base/parallel.hpp"
#include "elements/fiber_beam.hpp"
#include "elements/member_load.hpp"

namespace nsframe {

namespace {

constexpr std::size_t prefetched = 2;     // elements ahead of the one at work
constexpr int parallel_elements = 4;      // below this, threads cost more than they save

Vector12 gather(const ElementGroup& group, int element, const VectorX& full) {
  Vector12 u;
  const ElementNodes& nodes = group.nodes(element);
  for (int end = 0; end < 2; ++end) {
    const int node = nodes[static_cast<std::size_t>(end)];
    if (node >= 0) {
      u.segment<6>(6 * end) = full.segment<6>(6 * node);
    } else {
      u.segment<6>(6 * end).setZero();
    }
  }
  return u;
}

void add_to_nodes(const ElementGroup& group, int element, const Vector12& force, VectorX& full) {
  const ElementNodes& nodes = group.nodes(element);
  for (int end = 0; end < 2; ++end) {
    const int node = nodes[static_cast<std::size_t>(end)];
    if (node >= 0) full.segment<6>(6 * node) += force.segment<6>(6 * end);
  }
}

}  // namespace

Assembler::Assembler(const Model& model, int threads) : model_(model), threads_(std::max(1, threads)) {
  Eigen::setNbThreads(1);  // its threads would wait in loops between our products, which are too short for them
  for (const Structure& structure : model.structures) blocks_.push_back({structure.first_dof, structure.last_dof});
  std::vector<Eigen::Triplet<double>> pattern;
  for (std::size_t g = 0; g < model.groups.size(); ++g) {
    const ElementGroup& group = *model.groups[g];
    symmetric_ = symmetric_ && group.symmetric();
    for (int e = 0; e < group.size(); ++e) {
      Placed placed = place(group, e, model.history_begin[g] + group.history_begin(e));
      for (const int i : placed.dofs) {
        for (const int j : placed.dofs) pattern.emplace_back(i, j, 0.0);
      }
      if (const auto* beams = dynamic_cast<const FiberBeams*>(&group)) fibers_ += beams->fibers(e);
      if (group.rate_dependent()) rates_.push_back(nonlinear_.size());
      if (group.iterates() && !group.linear()) iterating_.push_back(nonlinear_.size());
      (group.linear() ? linear_ : nonlinear_).push_back(std::move(placed));
    }
  }
  const int size = model.dofs.size();
  for (int i = 0; i < size; ++i) pattern.emplace_back(i, i, 0.0);
  tangent_.resize(size, size);
  tangent_.setFromTriplets(pattern.begin(), pattern.end());
  tangent_.makeCompressed();
  for (auto* elements : {&linear_, &nonlinear_}) {
    for (Placed& placed : *elements) {
      for (const int j : placed.dofs) {
        for (const int i : placed.dofs) {
          const int* const begin = tangent_.innerIndexPtr() + tangent_.outerIndexPtr()[j];
          const int* const end = tangent_.innerIndexPtr() + tangent_.outerIndexPtr()[j + 1];
          placed.position.push_back(static_cast<int>(std::lower_bound(begin, end, i) - tangent_.innerIndexPtr()));
        }
      }
    }
  }
  linear_values_.assign(static_cast<std::size_t>(tangent_.nonZeros()), 0.0);
  for (const Placed& placed : linear_) {
    Vector12 force;
    Matrix12 stiffness;
    VectorX history(std::max(1, model.history_size())), trial(history.size());
    placed.group->initialize_history(placed.element, history.data());
    placed.group->respond(placed.element, Vector12::Zero(), history.data(), trial.data(), force, &stiffness);
    scatter(placed, stiffness, linear_values_.data());
  }
  std::copy(linear_values_.begin(), linear_values_.end(), tangent_.valuePtr());
  linear_operator_ = BlockOperator(tangent_, blocks_, dense_block_limit);
  linear_operator_.set_threads(threads_for(threads_, size));
  forces_.resize(nonlinear_.size());
  failures_.resize(nonlinear_.size());
  tangents_.resize(nonlinear_.size());
}

Assembler::Placed Assembler::place(const ElementGroup& group, int element, int history_begin) const {
  Placed placed{&group, element, history_begin, {}, {}, {}, {}};
  const SparseRows& T = model_.dofs.transformation;
  const ElementNodes& nodes = group.nodes(element);
  std::vector<std::array<int, 2>> entries;  // local DOF, free DOF
  std::vector<double> factors;
  for (int i = 0; i < 12; ++i) {
    const int node = nodes[static_cast<std::size_t>(i / 6)];
    if (node < 0) continue;
    for (SparseRows::InnerIterator entry(T, 6 * node + i % 6); entry; ++entry) {
      entries.push_back({i, static_cast<int>(entry.col())});
      factors.push_back(entry.value());
      placed.dofs.push_back(static_cast<int>(entry.col()));
    }
  }
  std::sort(placed.dofs.begin(), placed.dofs.end());
  placed.dofs.erase(std::unique(placed.dofs.begin(), placed.dofs.end()), placed.dofs.end());
  placed.map = MatrixX::Zero(12, static_cast<Eigen::Index>(placed.dofs.size()));
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const auto column = std::lower_bound(placed.dofs.begin(), placed.dofs.end(), entries[k][1]) - placed.dofs.begin();
    placed.map(entries[k][0], column) = factors[k];
  }
  const bool selection = entries.size() == placed.dofs.size() &&
                         std::all_of(factors.begin(), factors.end(), [](double factor) { return factor == 1; });
  for (Eigen::Index column = 0; selection && column < placed.map.cols(); ++column) {
    Eigen::Index row = 0;
    placed.map.col(column).maxCoeff(&row);
    placed.local.push_back(static_cast<int>(row));
  }
  return placed;
}

void Assembler::scatter(const Placed& placed, const Matrix12& tangent, double* values) const {
  if (!placed.local.empty()) {
    const int* position = placed.position.data();
    for (const int j : placed.local) {
      for (const int i : placed.local) values[*position++] += tangent(i, j);
    }
    return;
  }
  MatrixX half;
  const Eigen::Index n = placed.map.cols();
  MatrixX reduced(n, n);
  half.noalias() = tangent * placed.map;
  reduced.noalias() = placed.map.transpose() * half;
  const double* const entries = reduced.data();
  for (std::size_t k = 0; k < placed.position.size(); ++k) values[placed.position[k]] += entries[k];
}

VectorX Assembler::virgin_history() const {
  VectorX history = VectorX::Zero(model_.history_size());
  for (std::size_t g = 0; g < model_.groups.size(); ++g) {
    const ElementGroup& group = *model_.groups[g];
    for (int e = 0; e < group.size(); ++e) {
      group.initialize_history(e, history.data() + model_.history_begin[g] + group.history_begin(e));
    }
  }
  return history;
}

void Assembler::start_step(const VectorX& committed, VectorX& trial) const {
  for (const Placed& placed : nonlinear_) {
    placed.group->start_step(placed.element, committed.data() + placed.history_begin, trial.data() + placed.history_begin);
  }
}

long Assembler::quiet_fibers(const VectorX& history) const {
  long count = 0;
  for (const Placed& placed : nonlinear_) {
    count += placed.group->quiet_fibers(placed.element, history.data() + placed.history_begin);
  }
  return count;
}

std::vector<std::string> Assembler::softened_members(const VectorX& history) const {
  std::vector<std::string> names;
  for (const Placed& placed : nonlinear_) {
    if (placed.group->softened(placed.element, history.data() + placed.history_begin)) names.push_back(placed.group->id(placed.element));
  }
  return names;
}

double Assembler::load_factor(const VectorX& history) const {
  for (const Placed& placed : nonlinear_) {
    const MemberLoad* const load = placed.group->load(placed.element);
    if (load && !load->empty()) return placed.group->load_part(placed.element, history.data() + placed.history_begin);
  }
  return 1;
}

void Assembler::set_load_factor(double factor, VectorX& history) const {
  for (const Placed& placed : nonlinear_) {
    if (double* const own = placed.group->load_factor(placed.element, history.data() + placed.history_begin)) *own = factor;
  }
}

VectorX Assembler::member_loads(const VectorX& displacement, const VectorX& history) {
  constexpr double change = 1e-4;
  const double part = load_factor(history);
  VectorX trial = history, more, less;
  set_load_factor(part + change, trial);
  if (trial == history) return VectorX::Zero(displacement.size());
  for (const double side : {1.0, -1.0}) {
    start_step(history, trial);
    set_load_factor(part + side * change, trial);
    internal_force(displacement, history, trial, side > 0 ? more : less, false);
  }
  return (less - more) / (2 * change);
}

void Assembler::internal_force(const VectorX& displacement, const VectorX& committed, VectorX& trial, VectorX& force,
                               bool with_tangent, StateDetermination how) {
  nonlinear_force(displacement, committed, trial, nonlinear_force_, with_tangent, how);
  linear_operator_.multiply(displacement, force);
  force += nonlinear_force_;
}

void Assembler::nonlinear_force(const VectorX& displacement, const VectorX& committed, VectorX& trial, VectorX& force, bool with_tangent,
                                StateDetermination how) {
  if (nonlinear_.empty()) {
    force.setZero(displacement.size());
    if (support_force_.size() > 0) force += support_force_;
    return;
  }
  const bool rest = how == StateDetermination::remaining;
  if (rest) with_tangent = tangent_is_current_;
  tangent_is_current_ = with_tangent;
  full_displacement_.noalias() = model_.dofs.transformation * displacement;
  if (support_displacement_.size() > 0) full_displacement_ += support_displacement_;
  const int count = static_cast<int>(rest ? unsettled_.size() : nonlinear_.size());
  parallel_for(count, count < parallel_elements ? 1 : threads_, [&](int i) {
    const std::size_t at = rest ? unsettled_[static_cast<std::size_t>(i)] : static_cast<std::size_t>(i);
    const Placed& placed = nonlinear_[at];
    if (!rest && at + prefetched < nonlinear_.size()) {
      const Placed& later = nonlinear_[at + prefetched];
      later.group->prefetch(later.element, committed.data() + later.history_begin, trial.data() + later.history_begin);
    }
    try {
      const Vector12 u = gather(*placed.group, placed.element, full_displacement_);
      const double* const from = committed.data() + placed.history_begin;
      double* const to = trial.data() + placed.history_begin;
      Matrix12* const tangent = with_tangent ? &tangents_[at] : nullptr;
      if (how == StateDetermination::one_pass) {
        placed.group->respond_once(placed.element, u, from, to, forces_[at], tangent);
      } else {
        placed.group->respond(placed.element, u, from, to, forces_[at], tangent);
      }
    } catch (...) {
      failures_[at] = std::current_exception();
    }
  });
  const auto failed = std::find_if(failures_.begin(), failures_.end(), [](const std::exception_ptr& failure) { return failure != nullptr; });
  if (failed != failures_.end()) {
    const std::exception_ptr first = *failed;
    std::fill(failures_.begin(), failures_.end(), nullptr);
    std::rethrow_exception(first);
  }
  if (rest) {
    const std::vector<std::size_t> evaluated = unsettled_;  // which the count finds anew
    count_work(trial, evaluated, how);
  } else if (!iterating_.empty()) {
    count_work(trial, iterating_, how);
  }
  if (with_tangent) std::copy(linear_values_.begin(), linear_values_.end(), tangent_.valuePtr());
  full_force_.setZero(model_.dofs.full);
  for (std::size_t i = 0; i < nonlinear_.size(); ++i) {
    const Placed& placed = nonlinear_[i];
    add_to_nodes(*placed.group, placed.element, forces_[i], full_force_);
    if (with_tangent) scatter(placed, tangents_[i], tangent_.valuePtr());
  }
  force.noalias() = model_.dofs.transformation_transposed * full_force_;
  if (support_force_.size() > 0) force += support_force_;
}

SparseMatrix Assembler::linear_stiffness() const {
  SparseMatrix stiffness = tangent_;
  std::copy(linear_values_.begin(), linear_values_.end(), stiffness.valuePtr());
  return stiffness;
}

void Assembler::count_work(const VectorX& trial, const std::vector<std::size_t>& evaluated, StateDetermination how) {
  unsettled_.clear();
  for (const std::size_t i : evaluated) {
    const Placed& placed = nonlinear_[i];
    const StateWork work = placed.group->state_work(placed.element, trial.data() + placed.history_begin);
    ++(how == StateDetermination::remaining ? work_.finished : work_.evaluations);
    work_.passes += work.passes;
    if (work.passes > 1) ++work_.iterated;
    if (work.unsettled <= 1) continue;
    unsettled_.push_back(i);
    ++work_.carried;
  }
}

RateEnergy Assembler::rate_force(const VectorX& committed, VectorX& trial, const StepSpan& step, VectorX& force) {
  rate_values_.assign(static_cast<std::size_t>(tangent_.nonZeros()), 0.0);
  full_rate_force_.setZero(model_.dofs.full);
  RateEnergy sum;
  Vector12 at_nodes;
  Matrix12 tangent;
  for (const std::size_t i : rates_) {
    const Placed& placed = nonlinear_[i];
    const Vector12 u = gather(*placed.group, placed.element, full_displacement_);
    const RateEnergy energy = placed.group->respond_rate(placed.element, u, committed.data() + placed.history_begin,
                                                         trial.data() + placed.history_begin, step, at_nodes, tangent);
    sum.dissipated += energy.dissipated;
    sum.stored += energy.stored;
    add_to_nodes(*placed.group, placed.element, at_nodes, full_rate_force_);
    scatter(placed, tangent, rate_values_.data());
  }
  force.noalias() = model_.dofs.transformation_transposed * full_rate_force_;
  return sum;
}

void Assembler::add_rate_tangent(double factor, SparseMatrix& stiffness) const {
  for (std::size_t k = 0; k < rate_values_.size(); ++k) stiffness.valuePtr()[k] += factor * rate_values_[k];
}

SparseMatrix Assembler::geometric_change(const VectorX& displacement, const VectorX& step, double load_step, const VectorX& committed,
                                         VectorX& trial) const {
  const VectorX full = model_.dofs.transformation * displacement, full_step = model_.dofs.transformation * step;
  SparseMatrix change = tangent_;
  std::fill_n(change.valuePtr(), change.nonZeros(), 0.0);
  for (const Placed& placed : nonlinear_) {
    scatter(placed,
            placed.group->geometric_change(placed.element, gather(*placed.group, placed.element, full),
                                           gather(*placed.group, placed.element, full_step), load_step,
                                           committed.data() + placed.history_begin, trial.data() + placed.history_begin),
            change.valuePtr());
  }
  return change;
}

std::string Assembler::worst_element(const VectorX& residual) const {
  const VectorX full = model_.dofs.transformation * residual;
  double largest = -1;
  std::string name;
  for (const auto* elements : {&nonlinear_, &linear_}) {
    if (largest > 0) break;
    for (const Placed& placed : *elements) {
      const double share = gather(*placed.group, placed.element, full).norm();
      if (!std::isfinite(share)) return placed.group->id(placed.element);
      if (share > largest) {
        largest = share;
        name = placed.group->id(placed.element);
      }
    }
  }
  return name;
}

}  // namespace nsframe
