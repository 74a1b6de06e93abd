#include "calibration/calibrate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/errors.hpp"
#include "calibration/least_squares.hpp"
#include "models/mode_names.hpp"

namespace nsframe {

namespace {

constexpr int most_identifications = 4;
constexpr double short_step = 1e-3;  // of ln p: below it modes are followed by likeness alone, however little that is

// Follows the modes of the targets from one accepted point to the next.
class Follower {
 public:
  Follower(const CalibrationProblem& problem, const VectorX& values)
      : problem_(problem), resting_(resting_model(problem.model(values))), modes_(identify(problem, resting_)), values_(values) {
    for (std::size_t s = 0; s < resting_.structures.size(); ++s) {
      int highest = 0;
      for (const IdentifiedMode& target : modes_.targets)
        if (target.structure == s) highest = std::max(highest, target.mode + 1);
      count_.push_back(highest == 0 ? 0 : 2 * highest + 6);
    }
  }

  // The modes at `values`; nothing where they cannot be told from those before, or there is no model.
  std::optional<Identification> follow(const VectorX& values) {
    std::optional<RestingModel> trial;
    try {
      trial = resting_model(problem_.model(values));
    } catch (const InputError&) {
      return std::nullopt;
    } catch (const ConvergenceError&) {
      return std::nullopt;
    }
    const bool close = (values.array() / values_.array()).log().abs().maxCoeff() < short_step;
    Identification found = modes_;
    for (std::size_t s = 0; s < count_.size(); ++s) {
      if (count_[s] == 0) continue;
      const MatrixX before = shapes_of_targets(s);
      if (trial->structures[s].mass.rows() != before.rows()) return std::nullopt;
      found.modes[s] = aligned_modes(*trial, s, count_[s], before);
      const std::vector<int> match = match_shapes(before, found.modes[s].shape, trial->structures[s].mass, close ? 0 : alike);
      std::size_t next = 0;
      for (IdentifiedMode& target : found.targets) {
        if (target.structure != s || target.mode < 0) continue;
        target.mode = match[next++];
        if (target.mode < 0) return std::nullopt;
      }
    }
    trial_ = std::move(trial);
    return found;
  }

  void accept(const VectorX& values, Identification modes) {
    if (trial_) resting_ = std::move(*trial_);
    trial_.reset();
    modes_ = std::move(modes);
    values_ = values;
  }

  const Identification& modes() const { return modes_; }
  const RestingModel& resting() const { return resting_; }

  // Shapes of the targets of a structure, in their order.
  MatrixX shapes_of_targets(std::size_t structure) const {
    std::vector<Eigen::Index> columns;
    for (const IdentifiedMode& target : modes_.targets)
      if (target.structure == structure && target.mode >= 0) columns.push_back(target.mode);
    return modes_.modes[structure].shape(Eigen::all, columns);
  }

 private:
  const CalibrationProblem& problem_;
  RestingModel resting_;
  std::optional<RestingModel> trial_;
  Identification modes_;
  VectorX values_;
  std::vector<int> count_;
};

double frequency_of(const Identification& modes, std::size_t target) {
  const IdentifiedMode& mode = modes.targets[target];
  return mode.mode < 0 ? 0 : modes.modes[mode.structure].circular_frequency[mode.mode] / (2 * pi);
}

VectorX residuals(const CalibrationProblem& problem, const Identification& modes) {
  VectorX out = VectorX::Zero(static_cast<Eigen::Index>(problem.targets.size()));
  for (std::size_t i = 0; i < problem.targets.size(); ++i) {
    const double f = frequency_of(modes, i);
    if (modes.targets[i].mode >= 0)
      out[static_cast<Eigen::Index>(i)] = std::sqrt(problem.targets[i].weight) * std::log(f / problem.targets[i].frequency);
  }
  return out;
}

bool all_move(const CalibrationProblem& problem, const Identification& modes) {
  for (std::size_t i = 0; i < problem.targets.size(); ++i)
    if (modes.targets[i].mode >= 0 && !(frequency_of(modes, i) > 0)) return false;
  return true;
}

// Rows of d ln f / d ln p times the square root of their weights.
MatrixX weighted(const CalibrationProblem& problem, MatrixX sensitivity) {
  for (std::size_t i = 0; i < problem.targets.size(); ++i)
    sensitivity.row(static_cast<Eigen::Index>(i)) *= std::sqrt(problem.targets[i].weight);
  return sensitivity;
}

LeastSquaresResult fit(const CalibrationProblem& problem, Follower& follower, const VectorX& start, int iterations_left) {
  std::optional<Identification> found = follower.modes();
  LeastSquaresProblem squares;
  squares.value = [&, first = true](const VectorX& x) mutable -> std::optional<VectorX> {
    if (!first) found = follower.follow(x.array().exp().matrix());
    first = false;
    if (!found || !all_move(problem, *found)) return std::nullopt;
    return residuals(problem, *found);
  };
  squares.jacobian = [&](const VectorX& x) {
    const VectorX values = x.array().exp().matrix();
    follower.accept(values, *found);
    return weighted(problem, frequency_sensitivity(problem, values, follower.modes()));
  };
  const auto count = static_cast<Eigen::Index>(problem.parameters.size());
  squares.lower.resize(count);
  squares.upper.resize(count);
  for (Eigen::Index j = 0; j < count; ++j) {
    squares.lower[j] = std::log(problem.parameters[static_cast<std::size_t>(j)].lower);
    squares.upper[j] = std::log(problem.parameters[static_cast<std::size_t>(j)].upper);
  }
  LeastSquaresOptions options;
  options.max_iterations = iterations_left;
  return solve_least_squares(squares, start.array().log().matrix(), options);
}

VectorX start_values(const CalibrationProblem& problem) {
  VectorX out(static_cast<Eigen::Index>(problem.parameters.size()));
  for (std::size_t j = 0; j < problem.parameters.size(); ++j) out[static_cast<Eigen::Index>(j)] = problem.parameters[j].start;
  return out;
}

// Targets whose mode is another one in the second identification; both are of one model.
std::vector<std::size_t> differing(const RestingModel& resting, const Identification& a, const Identification& b) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < a.targets.size(); ++i) {
    const IdentifiedMode &one = a.targets[i], &other = b.targets[i];
    const std::size_t s = one.structure;
    const bool both = one.mode >= 0 && other.mode >= 0;
    if ((!both && one.mode != other.mode) ||
        (both && modal_assurance(a.modes[s].shape.col(one.mode), b.modes[s].shape.col(other.mode), resting.structures[s].mass) < alike))
      out.push_back(i);
  }
  return out;
}

void add_unmeasured(const CalibrationProblem& problem, const RestingModel& resting, const Identification& modes, Calibration& out) {
  for (std::size_t s = 0; s < modes.modes.size(); ++s) {
    std::set<int> measured;
    double highest = 0;
    for (std::size_t i = 0; i < problem.targets.size(); ++i) {
      if (modes.targets[i].structure != s || modes.targets[i].mode < 0) continue;
      measured.insert(modes.targets[i].mode);
      highest = std::max(highest, frequency_of(modes, i));
    }
    for (int m = 0; m < modes.modes[s].size(); ++m) {
      const double f = modes.modes[s].circular_frequency[m] / (2 * pi);
      if (f < highest && !measured.contains(m))
        out.unmeasured.push_back({resting.model.structures[s].name, modes.names[s][static_cast<std::size_t>(m)], f});
    }
  }
}

std::string reason_of(const CalibrationProblem& problem, const LeastSquaresResult& result, const std::vector<std::size_t>& renamed,
                      const Identification& modes) {
  std::vector<std::string> missing;
  for (std::size_t i = 0; i < problem.targets.size(); ++i) {
    const CalibrationTarget& target = problem.targets[i];
    if (modes.targets[i].mode < 0)
      missing.push_back(fmt::format("{:.4g} Hz of '{}'", target.frequency, target.structure));
  }
  if (!missing.empty()) return fmt::format("no mode has a shape like the measured one of {}", fmt::join(missing, ", "));
  if (!result.converged) return fmt::format("no least squares after {} iteration{}", result.iterations, result.iterations == 1 ? "" : "s");
  std::vector<std::string> names;
  for (const std::size_t i : renamed) names.push_back(problem.targets[i].structure + "." + problem.targets[i].mode);
  return renamed.empty() ? "" : fmt::format("the modes {} change places again and again as the fit goes on", fmt::join(names, ", "));
}

}  // namespace

VectorX Calibration::values() const {
  VectorX out(static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t j = 0; j < parameters.size(); ++j) out[static_cast<Eigen::Index>(j)] = parameters[j].fitted;
  return out;
}

MatrixX frequency_sensitivity(const CalibrationProblem& problem, const VectorX& values, const Identification& modes) {
  const MatrixDerivatives derivatives = matrix_derivatives(problem, values);
  MatrixX out = MatrixX::Zero(static_cast<Eigen::Index>(problem.targets.size()), values.size());
  for (Eigen::Index i = 0; i < out.rows(); ++i) {
    const IdentifiedMode& target = modes.targets[static_cast<std::size_t>(i)];
    if (target.mode < 0) continue;
    const Modes& all = modes.modes[target.structure];
    const double w = all.circular_frequency[target.mode];
    for (Eigen::Index j = 0; j < out.cols(); ++j) {
      const StructureMatrices& derivative = derivatives[static_cast<std::size_t>(j)][target.structure];
      out(i, j) = values[j] * eigenvalue_derivative(derivative, w, all.shape.col(target.mode)) / (2 * w * w);
    }
  }
  return out;
}

Calibration calibrate(const CalibrationProblem& problem) {
  Calibration out;
  out.accuracy = problem.accuracy;
  VectorX values = start_values(problem);
  std::optional<Follower> follower;
  follower.emplace(problem, values);
  const Identification named_at_start = follower->modes();
  LeastSquaresResult result;
  std::vector<std::size_t> renamed;
  while (true) {
    result = fit(problem, *follower, values, problem.max_iterations - out.iterations);
    out.iterations += result.iterations;
    out.rejected += result.rejected;
    ++out.identifications;
    values = result.x.array().exp().matrix();
    const Identification named = identify(problem, follower->resting());
    renamed = differing(follower->resting(), follower->modes(), named);
    if (renamed.empty() || out.identifications == most_identifications || out.iterations >= problem.max_iterations) break;
    follower.emplace(problem, values);
  }
  const Identification& modes = follower->modes();
  Identification with_names = modes;
  for (std::size_t s = 0; s < modes.modes.size(); ++s)
    if (modes.modes[s].size() > 0)
      with_names.names[s] = name_modes(follower->resting().model, follower->resting().model.structures[s], modes.modes[s].shape);
  out.reason = reason_of(problem, result, renamed, modes);
  out.converged = out.reason.empty();
  out.sensitivity = frequency_sensitivity(problem, values, modes);
  out.identifiability = identifiability(weighted(problem, out.sensitivity), problem.accuracy);
  for (std::size_t j = 0; j < problem.parameters.size(); ++j) {
    const auto at = static_cast<Eigen::Index>(j);
    const CalibrationParameter& p = problem.parameters[j];
    const Bound bound = result.x[at] <= std::log(p.lower) ? Bound::lower : result.x[at] >= std::log(p.upper) ? Bound::upper : Bound::none;
    out.parameters.push_back({p,
                              bound == Bound::lower   ? p.lower
                              : bound == Bound::upper ? p.upper
                                                      : values[at],
                              bound, out.identifiability.error[at]});
  }
  for (std::size_t i = 0; i < problem.targets.size(); ++i) {
    const CalibrationTarget& target = problem.targets[i];
    const IdentifiedMode &before = named_at_start.targets[i], &now = modes.targets[i];
    FittedFrequency& f = out.frequencies.emplace_back();
    f.structure = target.structure;
    f.mode = target.mode.empty() ? before.name : target.mode;
    f.measured = target.frequency;
    f.weight = target.weight;
    f.start = frequency_of(named_at_start, i);
    f.matched = now.mode >= 0;
    if (!f.matched) {
      f.likeness = now.likeness;
      f.name = now.name;
      continue;
    }
    f.fitted = frequency_of(modes, i);
    f.name = with_names.names[now.structure][static_cast<std::size_t>(now.mode)];
    const VectorX shape = modes.modes[now.structure].shape.col(now.mode);
    if (before.mode >= 0)
      f.likeness_to_start = modal_assurance(named_at_start.modes[now.structure].shape.col(before.mode), shape,
                                            follower->resting().structures[now.structure].mass);
    if (!target.shape.empty()) f.likeness = likeness_to_measured(follower->resting(), now.structure, target, shape);
  }
  add_unmeasured(problem, follower->resting(), with_names, out);
  return out;
}

}  // namespace nsframe
