#include "integrators/exponential.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/errors.hpp"

namespace nsframe {

namespace {

constexpr int most_rest_evaluations = 40;  // until what has no mass rests
constexpr double follow_up = 0.1;        // part of its motion over a step that may be left to the next one
constexpr double largest_rest = 1e-4;    // of the largest displacement, that may be left
constexpr double slow_following = 0.3;   // memory from which a tangent is worth its factorization
constexpr double room_to_double = 0.2;   // of the allowed error: twice the length makes at least four times of it
constexpr double forgetting = 0.02;      // of what `memory_` lacks to 1, a step: it is measured again and again

// 1 / w^2 of oscillators, also of those that damping ties together.
VectorX static_flexibility(const ExactModes& modes) {
  VectorX flexibility = modes.flexibility;
  for (const DampingCoupling& coupling : modes.couplings) {
    for (Eigen::Index i = 0; i < coupling.square.size(); ++i) {
      if (coupling.square[i] > 1) flexibility[coupling.places[static_cast<std::size_t>(i)]] = 1 / coupling.square[i];
    }
  }
  return flexibility;
}

SparseMatrix symmetric_part(const SparseMatrix& matrix) { return 0.5 * (matrix + SparseMatrix(matrix.transpose())); }

const System& accepted(const System& system) {
  const char* why = nullptr;
  if (system.assembler.rate_dependent()) why = "has elements whose force depends on the rate of deformation";
  if (system.damping.follows_tangent()) why = "has Rayleigh damping on the committed or current stiffness";
  if (why) throw InputError(fmt::format("error: scheme 'exponential' cannot take this scene: it {}; use scheme = \"moreau-jean\"", why));
  return system;
}

}  // namespace

Exponential::Exponential(const AnalysisOptions& options, const System& system)
    : options_(options), flow_(options, accepted(system), symmetric_part(system.initial_stiffness)),
      stiffness_(symmetric_part(system.initial_stiffness), system.assembler.blocks(), dense_block_limit),
      nonlinear_stiffness_(SparseMatrix((symmetric_part(system.initial_stiffness) - system.assembler.linear_stiffness()).pruned()),
                           system.assembler.blocks(), 0) {
  const ExactModes& modes = flow_.modes();
  for (int c = 0; c < modes.pairs(); ++c) {
    if (!modes.compliant[static_cast<std::size_t>(c)]) continue;
    throw InputError(fmt::format("error: scheme 'exponential' cannot take this scene: contact pair '{}' meets DOFs without mass; give them "
                                 "mass, or use scheme = \"moreau-jean\"",
                                 system.contacts().pairs[static_cast<std::size_t>(c)].name));
  }
  for (const DampingCoupling& coupling : modes.couplings) {
    if (coupling.rate.size() == 0) continue;
    throw InputError(fmt::format("error: scheme 'exponential' cannot take this scene: structure '{}' has dashpots at DOFs without mass; give them "
                                 "mass, or use scheme = \"event-split\" or \"moreau-jean\"",
                                 coupling.structure));
  }
  flexibility_ = static_flexibility(modes);
  const auto largest_displacement = [&](const VectorX& modal) {
    modes.shape.multiply(modal, displacement_);
    return displacement_.cwiseAbs().maxCoeff();
  };
  scale_ = largest_displacement(flexibility_.cwiseProduct(modes.static_load));
  for (std::size_t i = 0; i < system.model.motions.size(); ++i) {
    double largest = 0;
    for (const double a : system.model.motions[i].acceleration) largest = std::max(largest, std::abs(a));
    scale_ += largest * largest_displacement(flexibility_.cwiseProduct(modes.motion_load[i]));
  }
  find_modes(system);
}

void Exponential::project(Residual& r) {
  flow_.modes().shape_transposed.multiply(r.force, r.modal);
}

void Exponential::evaluate(System& system, const VectorX& x, const VectorX& massless, const VectorX& committed, VectorX& trial) {
  const ExactModes& modes = flow_.modes();
  const MatrixX& N = modes.massless_basis;
  modes.shape.multiply(x, displacement_);
  displacement_ += modes.rest - massless;
  massless_ = massless;
  system.assembler.start_step(committed, trial);
  next_.massless.setZero(modes.dofs);
  bool tangent = false;
  double last_change = 0;
  for (int i = 0; i < most_rest_evaluations; ++i) {
    system.assembler.nonlinear_force(displacement_, committed, trial, nonlinear_force_, tangent);
    ++evaluations_;
    nonlinear_stiffness_.multiply(displacement_, next_.force);
    next_.force = nonlinear_force_ - next_.force;
    project(next_);
    if (!modes.follows()) return;
    modes.massless_flexibility.multiply(next_.force, next_.massless);
    follow_ = next_.massless - massless_;  // F (P - p): F K leaves what has no mass and takes nothing from the modes
    if (tangent) {
      massless_stiffness_ = N.transpose() * (system.assembler.tangent() * N);
      massless_tangent_.compute(massless_stiffness_);
    }
    if (massless_stiffness_.size() > 0) {
      stiffness_.multiply(displacement_, internal_);
      internal_ += next_.force;
      follow_ = N * massless_tangent_.solve(VectorX(N.transpose() * (internal_ - system.static_load)));
    }
    const double change = follow_.cwiseAbs().maxCoeff();
    if (i > 0 && last_change > 0 && !tangent) memory_ = std::min(1.0, change / last_change);
    const double motion = (next_.massless - now_.massless).cwiseAbs().maxCoeff(), size = std::max(peak_, scale_);
    if (memory_ * change <= std::min(follow_up * motion, largest_rest * size) || change <= exponential_rest * size) {
      if (i == 0) memory_ += forgetting * (1 - memory_);
      return;
    }
    tangent = i > 0 && memory_ > slow_following;
    displacement_ -= follow_;
    massless_ += follow_;
    last_change = change;
  }
  throw ConvergenceError(modes.left_out > 0 ? "what has no mass, or the modes above highest_frequency, do not come to rest: raise it, or use scheme = \"moreau-jean\""
                                            : "what has no mass does not come to rest: give it mass, or use scheme = \"moreau-jean\"");
}

void Exponential::start(System& system, const State& committed) {
  const ExactModes& modes = flow_.modes();
  flow_.clear_force();
  flow_.start(system, committed);
  history_ = committed.history;
  if (begins_) {
    stiffness_.multiply(committed.displacement, start_force_);
    start_force_ = committed.internal_force - start_force_;
  }
  now_.force = start_force_;
  project(now_);
  now_.massless.setZero(modes.dofs);
  if (modes.follows()) modes.massless_flexibility.multiply(now_.force, now_.massless);
  modal_rate_ = VectorX::Zero(now_.modal.size());
  massless_rate_ = VectorX::Zero(now_.massless.size());
  level_ = 0;
  span_ = {0, 0, 1, span_.most};
  // the first peak, from rest position and velocity
  modes.shape.multiply(VectorX(flow_.modal().y.cwiseProduct(flexibility_.cwiseSqrt())), displacement_);
  peak_ = std::max(committed.displacement.cwiseAbs().maxCoeff(), displacement_.cwiseAbs().maxCoeff());
  memory_ = 1;
  massless_stiffness_.resize(0, 0);
  follow_ = VectorX::Zero(modes.dofs);
  if (!modes.follows()) return;
  evaluate(system, flow_.modal().x, now_.massless, committed.history, history_);
  now_ = next_;
}

void Exponential::show(const ModalState& end, double s, bool in_contact, VectorX& shown) {
  shown = end.x;
  if (fastest_ * s <= farthest_turn) return;
  load_ = end.f0;
  if (in_contact) flow_.add_contact_load(load_);
  shown = (flow_.modes().square.array() * (s * s) > farthest_turn * farthest_turn).select(flexibility_.cwiseProduct(load_), shown);
}

double Exponential::foresee(System& system, double time, double s, bool starting, const VectorX& from, VectorX& to) {
  flow_.set_force(now_.modal, modal_rate_, time);
  expected_massless_ = now_.massless + s * massless_rate_;
  if (!starting && flow_.glide(system, time, s, expected_)) {
    show(expected_, s, false, shown_);
    evaluate(system, shown_, expected_massless_, from, to);
  } else {
    flow_.copy_to(before_);
    tried_.clear();
    flow_.travel(system, time, s, starting, tried_);
    show(flow_.modal(), s, true, shown_);
    evaluate(system, shown_, expected_massless_, from, to);
    flow_.go_back(before_);
  }
  return error_ratio(next_.modal - now_.modal - s * modal_rate_, s);
}

void Exponential::take_rates(double s) {
  modal_rate_ = (next_.modal - now_.modal) / s;
  massless_rate_ = (next_.massless - now_.massless) / s;
  flow_.set_force_slope(modal_rate_);
}

void Exponential::add_rest_work(double part, StepResult& result) const {
  const double work = -part * flow_.modes().rest.dot(next_.force - now_.force);
  result.strain += work;
  result.input += work;
}

bool Exponential::advance(System& system, double time, double s, bool starting, const VectorX& committed, VectorX& trial,
                          StepResult& result) {
  const double error = foresee(system, time, s, starting, committed, trial);
  if (error > 1 && level_ < exponential_levels) {
    ++level_;
    return false;
  }
  take_rates(s);
  flow_.travel(system, time, s, starting, result);
  add_rest_work(1, result);
  std::swap(now_, next_);
  if (level_ == 0) {
    span_.wanted = steps_after(1, error);
  } else if (error < room_to_double) {
    --level_;
  }
  return true;
}

void Exponential::begin_span(System& system, const State& committed, double h, StepResult& result) {
  if (level_ > 0) return;
  while (std::min(span_.wanted, span_.most) > 1) {
    const int steps = std::min(span_.wanted, span_.most);
    const double length = steps * h, error = foresee(system, committed.time, length, false, committed.history, history_);
    const int next = steps_after(steps, error);
    if (error > 1) {
      span_.wanted = next;
      ++result.rejected_parts;
      continue;
    }
    take_rates(length);
    span_.steps = steps;
    if (steps == span_.wanted || next < steps) span_.wanted = next;
    return;
  }
}

void Exponential::go_on_in_span(System& system, const State& committed, State& trial, double h, StepResult& result) {
  result.histories_behind = span_.done > 0;
  flow_.travel(system, committed.time, h, false, result);
  add_rest_work(1.0 / span_.steps, result);
  result.histories_behind = ++span_.done < span_.steps;
  if (result.histories_behind) return;
  span_.steps = span_.done = 0;
  std::swap(now_, next_);
  std::swap(trial.history, history_);
}

void Exponential::step(System& system, const State& committed, State& trial, double h, StepResult& result) {
  result.clear();
  const bool fresh = !std::exchange(goes_on_, false);  // a step that fails leaves the flow somewhere: the next one then begins afresh
  if (fresh) {
    start(system, committed);
  } else {
    start_force_ = now_.force;
  }
  flow_.clear_impulse();
  evaluations_ = 0;
  if (span_.steps == 0 && !fresh && h == options_.dt) begin_span(system, committed, h, result);
  if (span_.steps > 0) {
    go_on_in_span(system, committed, trial, h, result);
  } else {
    make_parts(system, committed, trial, h, fresh, result);
  }
  result.evaluations = evaluations_;
  trial.time = committed.time + h;
  flow_.write(trial.displacement, trial.velocity);
  trial.displacement -= now_.massless;
  trial.velocity -= massless_rate_;
  if (span_.done > 0) trial.displacement -= span_.done * h * massless_rate_;
  trial.acceleration = (trial.velocity - committed.velocity) / h;
  trial.impulse = flow_.impulse();
  result.kinetic = flow_.kinetic_energy();
  peak_ = std::max(peak_, trial.displacement.cwiseAbs().maxCoeff());
  goes_on_ = true;
  begins_ = false;
}

void Exponential::make_parts(System& system, const State& committed, State& trial, double h, bool fresh, StepResult& result) {
  // parts of h / 2^level, in units of h / 2^exponential_levels
  constexpr long whole = 1L << exponential_levels;
  const VectorX* from = &committed.history;
  VectorX *to = &trial.history, *other = &history_;
  for (long done = 0; done < whole;) {
    long part = whole >> level_;
    while (done % part != 0) part /= 2;
    const double time = committed.time + h * static_cast<double>(done) / whole, s = h * static_cast<double>(part) / whole;
    if (advance(system, time, s, fresh && done == 0, *from, *to, result)) {
      done += part;
      from = to;
      std::swap(to, other);
    } else {
      ++result.rejected_parts;
    }
  }
  if (from != &trial.history) std::swap(trial.history, history_);
}

void Exponential::save(Snapshot& snapshot) const {
  flow_.save(snapshot);
  snapshot.put("exponential.force", now_.force);
  snapshot.put("exponential.massless", now_.massless);
  snapshot.put("exponential.modal_rate", modal_rate_);
  snapshot.put("exponential.massless_rate", massless_rate_);
  snapshot.put("exponential.peak", peak_);
  snapshot.put("exponential.memory", memory_);
  snapshot.put("exponential.massless_stiffness", VectorX(massless_stiffness_.reshaped()));
  snapshot.put("exponential.level", static_cast<double>(level_));
  snapshot.put("exponential.span", static_cast<double>(span_.wanted));
  snapshot.put("exponential.begins", begins_ ? 1.0 : 0.0);
  snapshot.put("exponential.goes_on", goes_on_ ? 1.0 : 0.0);
}

void Exponential::restore(System& system, const Snapshot& snapshot) {
  flow_.restore(snapshot);
  const ExactModes& modes = flow_.modes();
  now_.force = now_.massless = massless_rate_ = VectorX::Zero(modes.dofs);
  modal_rate_ = VectorX::Zero(modes.padded);
  snapshot.read("exponential.force", now_.force);
  snapshot.read("exponential.massless", now_.massless);
  snapshot.read("exponential.modal_rate", modal_rate_);
  snapshot.read("exponential.massless_rate", massless_rate_);
  begins_ = snapshot.number("exponential.begins") != 0;
  goes_on_ = snapshot.number("exponential.goes_on") != 0;
  peak_ = snapshot.number("exponential.peak");
  memory_ = snapshot.number("exponential.memory");
  massless_stiffness_ = MatrixX();
  if (const auto& kept = snapshot.array("exponential.massless_stiffness"); !kept.empty()) {
    massless_stiffness_ = Eigen::Map<const MatrixX>(kept.data(), modes.massless_basis.cols(), modes.massless_basis.cols());
    massless_tangent_.compute(massless_stiffness_);
  }
  level_ = static_cast<int>(snapshot.number("exponential.level"));
  span_.wanted = static_cast<int>(snapshot.number("exponential.span"));
  project(now_);
  history_ = system.assembler.virgin_history();
  follow_ = VectorX::Zero(modes.dofs);
}

std::vector<std::string> Exponential::describe() const {
  std::vector<std::string> lines = flow_.describe();
  lines.emplace_back("the stiffness at rest exactly, the rest of the internal force as a load, from one evaluation of the elements a step");
  if (resting_frequency() > 0) {
    lines.push_back(fmt::format("at whole steps nonlinear elements see modes above {:.3g} Hz where they would rest: these turn by more than {:g} rad, "
                                "and would grow; parts of steps where they swing far",
                                resting_frequency() / (2 * pi), farthest_turn));
  }
  if (options_.accuracy > 0) {
    lines.push_back(fmt::format("parts of steps, or over up to {} of them, by an error estimate, accuracy {:g} of the peak", exponential_steps, options_.accuracy));
  }
  return lines;
}

}  // namespace nsframe
