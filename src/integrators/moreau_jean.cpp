#include "integrators/moreau_jean.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "integrators/mode_response.hpp"
#include "integrators/position_projection.hpp"

namespace nsframe {

namespace {

// Residual reduction of one iteration above which the tangent is factored anew.
constexpr double slow_reduction = 0.005;

// Newton's law can ask a body between two pairs with different e to leave both.
std::string hint_of_restitution(const Contacts& contacts) {
  const bool differ = contacts.restitution.maxCoeff() > contacts.restitution.minCoeff();
  return differ ? "; where e differs, Newton's law may have no solution: impact_law = \"poisson\" has one" : "";
}

}  // namespace

MoreauJean::MoreauJean(const AnalysisOptions& options, const System& system)
    : options_(options), matrix_(system), ladder_(options.algorithm), forces_(system), least_scale_(system.negligible_force()),
      description_(forces_.describe(system.contacts())) {
  if (!options.projection) return;
  description_.emplace_back("penetrations are moved back to gap 0 after each step");
  if (!system.assembler.rate_dependent()) return;
  throw InputError("error: analysis.projection moves displacements without a rate, and this scene has elements whose force depends on "
                   "the rate of deformation; set projection = false");
}

void MoreauJean::find_active_pairs(const System& system, const State& committed, double h, StepResult& result) {
  const Contacts& contacts = system.contacts();
  active_.clear();
  if (contacts.size() == 0) return;
  system.gaps(committed.displacement, committed.time, gap_);
  system.gap_rates(committed.velocity, committed.time, rate_);
  support_rate_.resize(0);
  if (system.model.moves_supports()) system.gap_rates(VectorX::Zero(committed.velocity.size()), committed.time + h, support_rate_);
  result.least_gap = gap_.minCoeff();
  const double closed = options_.projection ? closed_gap : 0;  // a projected gap is 0 but for rounding
  for (int i = 0; i < contacts.size(); ++i) {
    if (!forces_.is_force(i) && gap_[i] + options_.gamma * h * rate_[i] < closed) active_.push_back(i);
  }
  forces_.start_step(contacts, committed, gap_, rate_, h, options_.theta);
}

void MoreauJean::predict(const System& system, const State& committed, double h, State& trial, StepResult& result) {
  // v+ - v = J^-1 (G - h P - a d + M v/theta) - v/theta
  free_residual_ = load_ - h * committed.internal_force;
  if (!departure_.empty()) free_residual_ -= (options_.theta * h) * departure_.next();
  free_residual_.noalias() += system.mass() * (committed.velocity / options_.theta);
  matrix_.solve(free_residual_, mid_velocity_);
  ++result.solves;
  mid_velocity_ -= committed.velocity / options_.theta;
  update_velocity(system, mid_velocity_, trial, result);
}

void MoreauJean::evaluate(System& system, const State& committed, State& trial, double h, bool with_tangent, StateDetermination how) {
  const double theta = options_.theta;
  mid_velocity_ = (1 - theta) * committed.velocity + theta * trial.velocity;
  trial.displacement = committed.displacement + h * mid_velocity_;
  system.place_supports(committed.time + h);
  system.assembler.internal_force(trial.displacement, committed.history, trial.history, trial.internal_force, with_tangent, how);
  momentum_change_.noalias() = system.mass() * (trial.velocity - committed.velocity);
  free_residual_ = momentum_change_ + h * ((1 - theta) * committed.internal_force + theta * trial.internal_force) - load_;
  if (system.damping.follows_tangent()) system.damping.form_tangent(committed.damping_stiffness, system.assembler.tangent());
  dissipated_ = system.damping.add_force(system.assembler.blocks(), h, mid_velocity_, free_residual_);
  if (!system.assembler.rate_dependent()) return;
  rate_energy_ = system.assembler.rate_force(committed.history, trial.history, {h, theta}, rate_force_);
  free_residual_ += h * rate_force_;
}

void MoreauJean::update_velocity(const System& system, const VectorX& change, State& trial, StepResult& result) {
  trial.velocity += change;
  if (in_contact()) solve_contact(system, trial, result);
}

void MoreauJean::solve_contact(const System& system, State& trial, StepResult& result) {
  const Contacts& contacts = system.contacts();
  forces_.add_velocity(contacts, matrix_, -1, trial.velocity);
  if (!impulse_.isZero(0)) {  // R knows of the impulses so far: they are found anew
    matrix_.respond(contacts, active_, impulse_, contact_change_);
    trial.velocity -= contact_change_;
  }
  if (contacts.frictional()) add_friction_response(contacts, -1, trial.velocity);
  const auto count = static_cast<Eigen::Index>(active_.size());
  ContactProblem problem{MatrixX(count, count), VectorX(count)};
  for (Eigen::Index b = 0; b < count; ++b) {
    const int pair = active_[static_cast<std::size_t>(b)];
    problem.rhs[b] = contacts.jacobian.row(pair).dot(trial.velocity);
    if (support_rate_.size() > 0) problem.rhs[b] += support_rate_[pair];
    problem.delassus.col(b) = matrix_.rates_by(contacts, pair)(active_);
  }
  problem.rhs -= target_rates(system, problem.delassus);
  const ContactOptions contact_options{options_.contact_tolerance, options_.max_contact_sweeps};
  const auto solve = [&](const ContactProblem& impulses, const VectorX& guess) {
    return options_.contact_solver == ContactSolverKind::active_set ? solve_active_set(impulses, contact_options, guess)
                                                                    : solve_gauss_seidel(impulses, contact_options, guess);
  };
  ContactSolution solution =
      contacts.frictional() ? solve_with_friction(system, problem, trial)
      : forces_.active()    ? forces_.solve(contacts, matrix_, trial.velocity, active_, problem, impulse_, contact_options, solve)
                            : solve(problem, impulse_);
  result.complementarity_error = solution.error;
  if (!solution.converged) {
    Eigen::Index worst = 0;
    if (!contacts.frictional()) (problem.delassus * solution.impulse + problem.rhs).minCoeff(&worst);
    throw ConvergenceError(fmt::format("the contact problem{} did not converge (error {:.1e} after {} iterations), {} pair {}{}",
                                       contacts.frictional() ? " with friction" : "", solution.error, solution.iterations,
                                       contacts.frictional() ? "first" : "worst",
                                       contacts.pairs[static_cast<std::size_t>(active_[static_cast<std::size_t>(worst)])].name,
                                       hint_of_restitution(contacts)));
  }
  impulse_ = std::move(solution.impulse);
  delassus_ = std::move(problem.delassus);
  contact_change_.resize(0);
  if (!impulse_.isZero(0)) {
    matrix_.respond(contacts, active_, impulse_, contact_change_);
    if (contacts.frictional()) add_friction_response(contacts, 1, contact_change_);
    trial.velocity += contact_change_;
  }
  forces_.add_velocity(contacts, matrix_, 1, trial.velocity);
}

void MoreauJean::add_impulses(const System& system) {
  residual_ = free_residual_;
  for (std::size_t a = 0; a < active_.size(); ++a) {
    residual_ -= impulse_[static_cast<Eigen::Index>(a)] * system.contacts().jacobian.row(active_[a]).transpose();
  }
  if (system.contacts().frictional()) add_friction(system.contacts(), -1, residual_);
  forces_.subtract_impulses(system.contacts(), residual_);
}

double MoreauJean::force_scale(const State& trial, double h) const {
  return h * least_scale_ + momentum_change_.norm() + h * trial.internal_force.norm() + load_.norm();
}

void MoreauJean::fail(const System& system, const State& committed, const StepResult& result) const {
  const bool contact = !active_.empty() && impulse_.size() > 0 && impulse_.maxCoeff() > 0;
  throw ConvergenceError(fmt::format("the step at t = {:.6g} s did not converge {}{}; tried: {}", committed.time,
                                     told_residual(result.residual, system.assembler.worst_element(free_residual_)),
                                     contact ? ", while pair " + system.contacts().pairs[static_cast<std::size_t>(active_[0])].name + " is in contact" : "",
                                     tried(result.attempts)));
}

// The step as the solution algorithms see it: x is the velocity.
class MoreauJean::Step : public NonlinearStep {
 public:
  Step(MoreauJean& scheme, System& system, const State& committed, State& trial, double h, StepResult& result)
      : scheme_(scheme), system_(system), committed_(committed), trial_(trial), h_(h), result_(result) {}

  void restart() override {
    scheme_.impulse_ = VectorX::Zero(static_cast<Eigen::Index>(scheme_.active_.size()));
    scheme_.friction_impulse_ = VectorX::Zero(system_.contacts().frictional() ? 2 * scheme_.impulse_.size() : 0);
    scheme_.forces_.restart();
    system_.assembler.start_step(committed_.history, trial_.history);
    trial_.velocity = committed_.velocity;
    predicted_ = has_factors();
    if (predicted_) {
      scheme_.predict(system_, committed_, h_, trial_, result_);
    } else {
      trial_.velocity += h_ * committed_.acceleration;
    }
    evaluate(system_.damping.follows_tangent(), determination());
    if (predicted_ && !system_.linear()) error_of_guess_ = residual() / (scheme_.options_.theta * h_);
  }
  const VectorX& residual() const override { return scheme_.in_contact() ? scheme_.residual_ : scheme_.free_residual_; }
  bool guess_may_stand() const override { return predicted_; }
  // The prediction of a linear step is its solution, as an iteration would find it from the committed velocity with one product by K more.
  bool solved_at_once() const { return predicted_ && system_.linear(); }
  double error() const override { return result_.residual / scheme_.options_.newton_tolerance; }
  void factor(Tangent which) override {
    if (which == Tangent::current && !system_.assembler.tangent_is_current()) evaluate(true, determination());
    factored_ = true;
    const bool initial = which == Tangent::initial;
    const SparseMatrix& K = initial ? system_.initial_stiffness : system_.assembler.tangent();
    const double theta = scheme_.options_.theta;
    if (!system_.assembler.rate_dependent()) return scheme_.matrix_.factor(system_, K, theta * h_);
    SparseMatrix moving = K;  // dR/dv = h theta h dF/dq of the forces that R holds at the theta point (theory.md, 131)
    system_.assembler.add_rate_tangent(1 / theta, moving);
    scheme_.matrix_.factor(system_, moving, theta * h_);
  }
  void solve(const VectorX& rhs, VectorX& x) override {
    scheme_.matrix_.solve(rhs, x);
    ++result_.solves;
  }
  void move(const VectorX& change) override {
    scheme_.update_velocity(system_, change, trial_, result_);
    evaluate(system_.damping.follows_tangent(), determination());
  }
  void settle() override {
    if (system_.assembler.unsettled()) evaluate(system_.damping.follows_tangent(), StateDetermination::remaining);
  }
  bool has_factors() const override { return scheme_.matrix_.ready(scheme_.options_.theta * h_); }
  double slow_reduction() const override {
    return system_.linear() ? std::numeric_limits<double>::infinity() : nsframe::slow_reduction;
  }

  // What the step shows of P beyond the factored stiffness, for the guess of the next one.
  void keep_departure() {
    if (system_.linear()) return;
    Extrapolation& departure = scheme_.departure_;
    if (factored_ || !predicted_) return departure.clear();
    if (!departure.empty()) error_of_guess_ += departure.next();
    departure.add(error_of_guess_);
  }

 private:
  void evaluate(bool with_tangent, StateDetermination how) {
    scheme_.evaluate(system_, committed_, trial_, h_, with_tangent, how);
    if (scheme_.in_contact()) scheme_.add_impulses(system_);
    result_.residual = residual().norm() / std::max(scheme_.force_scale(trial_, h_), 1e-300);
  }

  MoreauJean& scheme_;
  System& system_;
  const State& committed_;
  State& trial_;
  double h_;
  StepResult& result_;
  bool predicted_ = false, factored_ = false;
  VectorX error_of_guess_;  // of P [N]
};

void MoreauJean::step(System& system, const State& committed, State& trial, double h, StepResult& result) {
  result.clear();
  contact_change_.resize(0);
  find_active_pairs(system, committed, h, result);
  result.active_pairs = static_cast<int>(active_.size()) + forces_.count();
  system.load_impulse(committed.time, committed.time + h, load_);
  Step problem(*this, system, committed, trial, h, result);
  if (!ladder_.climb(problem, options_.max_newton, result.attempts)) fail(system, committed, result);
  problem.keep_departure();
  for (const Attempt& attempt : result.attempts) result.newton_iterations += attempt.iterations;
  if (problem.solved_at_once()) ++result.newton_iterations;
  result.guess_stood = result.newton_iterations == 0;
  trial.time = committed.time + h;
  if (active_.empty()) {
    trial.acceleration = (trial.velocity - committed.velocity) / h;
  } else {
    trial.acceleration.setZero(trial.velocity.size());
  }
  report(system, committed, trial, h, result);
  if (options_.projection) project(system, committed, trial, h, result);
  if (system.damping.follows_tangent()) {
    const SparseMatrix& K = system.assembler.tangent();
    trial.damping_stiffness = Eigen::Map<const VectorX>(K.valuePtr(), K.nonZeros());
  }
}

// Pairs that carry an impulse, and those that closed in this step unforeseen. What the shift does to internal forces and loads is
// work of the scheme, not of the contact.
void MoreauJean::project(System& system, const State& committed, State& trial, double h, StepResult& result) {
  const Contacts& contacts = system.contacts();
  if (contacts.size() == 0) return;
  VectorX gap;
  system.gaps(trial.displacement, committed.time + h, gap);
  std::vector<ProjectedPair> pairs;
  std::size_t next = 0;  // of active_, which rises
  for (int i = 0; i < contacts.size(); ++i) {
    const bool active = next < active_.size() && active_[next] == i;
    if (active) ++next;
    if (!active && (gap[i] >= 0 || forces_.is_force(i))) continue;
    pairs.push_back({i, gap[i], trial.impulse[i] > 0 || gap_[i] >= -closed_gap});
  }
  const VectorX shift = shift_to_closed(contacts, matrix_, pairs);
  if (shift.size() == 0) return;
  const VectorX force = trial.internal_force;
  trial.displacement += shift;
  system.assembler.internal_force(trial.displacement, committed.history, trial.history, trial.internal_force, system.damping.follows_tangent());
  const double strain = 0.5 * shift.dot(force + trial.internal_force), input = shift.dot(load_) / h;
  result.strain += strain;
  result.input += input;
  result.numerical -= strain - input;
}

// Impacts and the energy of the step (theory.md, "Energy balance"): v_theta' R = 0 split into its terms, the part of the
// inertia, internal and contact forces that theta > 1/2 dissipates apart.
void MoreauJean::report(const System& system, const State& committed, State& trial, double h, StepResult& result) const {
  const Contacts& contacts = system.contacts();
  result.strain = 0.5 * h * mid_velocity_.dot(committed.internal_force + trial.internal_force);
  result.input = load_.dot(mid_velocity_);
  result.numerical = momentum_change_.dot(trial.velocity - committed.velocity) + h * mid_velocity_.dot(trial.internal_force - committed.internal_force);
  result.damping = dissipated_;
  trial.impulse.setZero(contacts.size());
  for (std::size_t k = 0; k < active_.size(); ++k) {
    const double p = impulse_[static_cast<Eigen::Index>(k)];
    if (p <= 0) continue;
    const int pair = active_[k];
    const double own_after = contacts.jacobian.row(pair).dot(trial.velocity);
    const double before = rate_[pair], after = own_after + (support_rate_.size() > 0 ? support_rate_[pair] : 0);
    const double own_before = support_rate_.size() > 0 ? contacts.jacobian.row(pair).dot(committed.velocity) : before;
    result.contact -= 0.5 * p * (before + after);
    result.input -= 0.5 * p * (before - own_before + after - own_after);  // work of the pair on moved supports
    result.numerical -= p * (own_after - own_before);
    trial.impulse[pair] = p;
    result.impacts.push_back({trial.time, pair, -before, p, before, after});
  }
  report_simultaneous(system, committed, trial, h, result);
  result.numerical *= options_.theta - 0.5;
  forces_.report(contacts, committed, rate_, trial, result);
  if (system.assembler.rate_dependent()) {
    result.damping += rate_energy_.dissipated;
    result.strain += rate_energy_.stored;
    result.numerical += h * rate_force_.dot(mid_velocity_) - rate_energy_.dissipated - rate_energy_.stored;
  }
  // q+ = q + h v + theta h (v+ - v): as if the velocity jumped here
  if (contact_change_.size() > 0) result.jumps.push_back({committed.time + (1 - options_.theta) * h, contact_change_});
}

std::vector<Impact> MoreauJean::open_contacts(const System& system, const State& state) const {
  return forces_.open_contacts(system.contacts(), state);
}

void MoreauJean::save(Snapshot& snapshot) const {
  matrix_.save(snapshot);
  departure_.save("moreau_jean.departure", snapshot);
}

void MoreauJean::restore(System& system, const Snapshot& snapshot) {
  matrix_.restore(system, snapshot);
  departure_.restore("moreau_jean.departure", system.mass().rows(), snapshot);
}

Scheme::ModeResponse MoreauJean::mode_response(double w, double xi, double h) const { return theta_method_response(options_.theta, w, xi, h); }

}  // namespace nsframe
