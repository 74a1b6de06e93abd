#include "elements/section_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "base/errors.hpp"

namespace nsframe {

namespace {

double strain_at(const Vector2& point, const Vector3& deformation) {
  return deformation[0] - point.x() * deformation[1] + point.y() * deformation[2];
}

// Directions of (kz, ky), and of (Mz, My), about the axis of bending and about the one across.
struct Axes {
  explicit Axes(double angle) : along(std::cos(angle), std::sin(angle)), across(-along.y(), along.x()) {
    for (Vector2* axis : {&along, &across})
      for (double& component : *axis)
        if (std::abs(component) < 1e-15) component = 0;  // 90 deg is the y axis
  }
  Vector2 along, across;
};

// A section with its history, driven by axial strain, curvature and curvature across.
class Driver {
 public:
  Driver(const AnalysedSection& section, const MomentCurvatureOptions& options)
      : section_(section),
        options_(options),
        axes_(options.angle),
        committed_(static_cast<std::size_t>(section.fibers.history_size)),
        trial_(committed_.size()) {
    initialize_history(section.fibers, committed_.data());
    const Matrix3 k = initial_tangent(section.fibers);
    // 1e-12 of the force at a strain of 1e-5: far above the rounding of the sum over fibers
    constexpr double least = 1e-300;  // of a section without initial stiffness
    tolerance_ = 1e-12 * (std::abs(options.axial_force) + 1e-5 * k(0, 0)) + least;
    moment_tolerance_ = 1e-12 * 1e-5 * std::sqrt(k(0, 0) * std::max(k(1, 1), k(2, 2))) + least;
    unknown_ = Vector2::Zero();
    previous_ = Vector2::Zero();
  }

  // Equilibrium at a curvature and axial force; commits it and says true, or changes nothing.
  bool go_to(double curvature, double axial_force, Vector2 guess) {
    if (!newton(curvature, axial_force, guess) &&
        (options_.free_axis || !bisect(curvature, axial_force, guess = unknown_)))
      return false;
    previous_ = unknown_;
    unknown_ = guess;
    last_curvature_ = curvature_;
    curvature_ = curvature;
    committed_.swap(trial_);
    return true;
  }

  // The same in as many halvings as needed.
  bool walk_to(double curvature, double axial_force) {
    constexpr int finest = 10;  // halvings
    const double start = curvature_;
    double done = 0, part = 1;
    while (done < 1) {
      const double next = std::min(done + part, 1.0);
      const double to = next == 1 ? curvature : start + next * (curvature - start);
      if (go_to(to, axial_force, extrapolate(to))) {
        done = next;
      } else if ((part /= 2) < std::ldexp(1.0, -finest)) {
        return false;
      }
    }
    return true;
  }

  BendingState state() const {
    BendingState out;
    out.curvature = curvature_;
    out.deformation = deformation(curvature_, unknown_);
    out.force = force_;
    out.moment = axes_.along.dot(force_.tail<2>());
    out.transverse_moment = axes_.across.dot(force_.tail<2>());
    for (const SectionPart& part : section_.parts) out.strain.push_back(strain_range(part, out.deformation));
    return out;
  }

  Vector2 unknown() const { return unknown_; }

 private:
  Vector3 deformation(double curvature, const Vector2& unknown) const {
    Vector3 e;
    e << unknown[0], curvature * axes_.along + unknown[1] * axes_.across;
    return e;
  }

  Vector2 extrapolate(double curvature) const {
    const double before = curvature_ - last_curvature_;
    if (before == 0 || (curvature - curvature_) * before < 0) return unknown_;
    return unknown_ + (curvature - curvature_) / before * (unknown_ - previous_);
  }

  // Residual (N - N0, moment across) and its tangent; the second equation says 0 = 0 when the axis is held.
  Vector2 residual(double curvature, double axial_force, const Vector2& unknown, Eigen::Matrix2d& tangent) {
    const SectionResponse r =
        respond(section_.fibers, deformation(curvature, unknown), committed_.data(), trial_.data());
    force_ = r.force;
    const Vector2 row = r.tangent.block<1, 2>(0, 1).transpose();
    tangent << r.tangent(0, 0), 0, 0, 1;
    if (!options_.free_axis) return {r.force[0] - axial_force, 0};
    const Eigen::Matrix2d bending = r.tangent.block<2, 2>(1, 1);
    tangent << r.tangent(0, 0), row.dot(axes_.across), row.dot(axes_.across), axes_.across.dot(bending * axes_.across);
    return {r.force[0] - axial_force, axes_.across.dot(r.force.tail<2>())};
  }

  double measure(const Vector2& r) const {
    const double axial = std::abs(r[0]) / tolerance_;
    return options_.free_axis ? std::max(axial, std::abs(r[1]) / moment_tolerance_) : axial;
  }

  // Newton with a backtracking line search on the residual.
  bool newton(double curvature, double axial_force, Vector2& x) {
    Eigen::Matrix2d tangent;
    Vector2 r = residual(curvature, axial_force, x, tangent);
    for (int iteration = 0; iteration < 60; ++iteration) {
      if (measure(r) <= 1) return true;
      const double determinant = tangent.determinant();
      if (!(std::abs(determinant) > 0)) return false;
      const Vector2 step = -tangent.inverse() * r;
      if (!step.allFinite()) return false;
      double factor = 1;
      Vector2 next = x + step;
      Eigen::Matrix2d next_tangent;
      Vector2 next_r = residual(curvature, axial_force, next, next_tangent);
      while (measure(next_r) > (1 - 1e-4 * factor) * measure(r) && factor > 1e-4) {
        factor /= 2;
        next = x + factor * step;
        next_r = residual(curvature, axial_force, next, next_tangent);
      }
      if (factor <= 1e-4) return false;
      x = next;
      r = next_r;
      tangent = next_tangent;
    }
    return false;
  }

  // The axial strain nearest to the last one where the axial force changes its side.
  bool bisect(double curvature, double axial_force, Vector2& x) {
    Eigen::Matrix2d unused;
    const auto excess = [&](double strain) {
      return residual(curvature, axial_force, Vector2(strain, 0), unused)[0];
    };
    const double start = x[0], at_start = excess(start);
    for (double reach = 1e-6; reach < 0.1; reach *= 1.25) {
      for (const double side : {1.0, -1.0}) {
        double a = start, b = start + side * reach;
        if ((excess(b) > 0) == (at_start > 0)) continue;
        while (std::abs(b - a) > 4 * std::numeric_limits<double>::epsilon() * std::max(std::abs(a), std::abs(b))) {
          const double middle = (a + b) / 2;
          ((excess(middle) > 0) == (at_start > 0) ? a : b) = middle;
        }
        x = Vector2(b, 0);
        // the last bit of the strain times the stiffness is all that may be left; a jump of the law is not
        return measure(Vector2(excess(b), 0)) <= 1e3;
      }
    }
    return false;
  }

  const AnalysedSection& section_;
  const MomentCurvatureOptions& options_;
  Axes axes_;
  std::vector<double> committed_, trial_;
  Vector2 unknown_, previous_;  // axial strain, curvature across
  double curvature_ = 0, last_curvature_ = 0, tolerance_ = 0, moment_tolerance_ = 0;
  Vector3 force_ = Vector3::Zero();
};

// The point where a quantity reaches `level` between two states.
BendingPoint between(const BendingState& a, const BendingState& b, double at_a, double at_b, double level) {
  const double s = at_b == at_a ? 1 : std::clamp((level - at_a) / (at_b - at_a), 0.0, 1.0);
  return {a.curvature + s * (b.curvature - a.curvature), a.moment + s * (b.moment - a.moment)};
}

std::optional<BendingPoint> first_yield(const MomentCurvature& curve, std::size_t part, double yield) {
  const auto largest = [part](const BendingState& s) {
    return std::max(std::abs(s.strain[part][0]), std::abs(s.strain[part][1]));
  };
  for (std::size_t i = 0; i < curve.states.size(); ++i) {
    if (largest(curve.states[i]) < yield) continue;
    const BendingState& before = curve.states[i == 0 ? 0 : i - 1];
    return between(before, curve.states[i], largest(before), largest(curve.states[i]), yield);
  }
  return std::nullopt;
}

}  // namespace

AnalysedSection analysed_section(const std::string& name, const FiberSectionDescription& description,
                                 const std::map<std::string, UniaxialLaw>& laws) {
  AnalysedSection out;
  out.name = name;
  std::vector<Fiber> fibers;
  for (const FiberDescription& fiber : description.fibers) {
    const UniaxialLaw& law = laws.at(fiber.material.name);
    fibers.push_back({fiber.y, fiber.z, fiber.displaced ? -fiber.area : fiber.area, law});
    auto part = std::find_if(out.parts.begin(), out.parts.end(),
                             [&](const SectionPart& p) { return p.material == fiber.material.name; });
    if (part == out.parts.end()) part = out.parts.insert(out.parts.end(), SectionPart{fiber.material.name, law, {}, 0});
    part->area += fibers.back().area;
    if (!fiber.displaced) part->points.emplace_back(fiber.y, fiber.z);
  }
  out.fibers = FiberSection(fibers, description.torsion_stiffness);
  return out;
}

std::array<double, 2> strain_range(const SectionPart& part, const Vector3& deformation) {
  std::array<double, 2> range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Vector2& point : part.points) {
    const double strain = strain_at(point, deformation);
    range = {std::min(range[0], strain), std::max(range[1], strain)};
  }
  return range;
}

MomentCurvature moment_curvature(const AnalysedSection& section, const MomentCurvatureOptions& options) {
  MomentCurvature curve;
  Driver driver(section, options);
  constexpr int load_steps = 20;
  for (int i = 1; i <= load_steps; ++i) {
    const double force = options.axial_force * i / load_steps;
    if (!driver.go_to(0, force, driver.unknown()))
      throw ConvergenceError(fmt::format("section '{}' cannot carry an axial force of {:.6g} N without bending: "
                                         "no equilibrium beyond {:.6g} N",
                                         section.name, options.axial_force, options.axial_force * (i - 1) / load_steps));
  }
  curve.states.push_back(driver.state());
  double from = 0;
  for (const double target : options.curvatures) {
    for (int i = 1; i <= options.steps; ++i) {
      const double curvature = i == options.steps ? target : from + (target - from) * i / options.steps;
      if (!driver.walk_to(curvature, options.axial_force)) {
        curve.end = fmt::format("no equilibrium with the axial force beyond a curvature of {:.6g} 1/m",
                                curve.states.back().curvature);
        return curve;
      }
      curve.states.push_back(driver.state());
    }
    from = target;
  }
  return curve;
}

BendingSummary summarize(const AnalysedSection& section, const MomentCurvature& curve) {
  BendingSummary out;
  for (std::size_t part = 0; part < section.parts.size(); ++part) {
    const auto point = first_yield(curve, part, yield_strain(section.parts[part].law));
    out.first_yield.push_back(point);
    if (point && (!out.yield || std::abs(point->curvature) < std::abs(out.yield->curvature))) out.yield = point;
  }
  std::size_t peak = 0;
  for (std::size_t i = 0; i < curve.states.size(); ++i)
    if (std::abs(curve.states[i].moment) > std::abs(curve.states[peak].moment)) peak = i;
  const double top = curve.states[peak].moment;
  out.peak = {curve.states[peak].curvature, top};
  out.ultimate = {curve.states.back().curvature, curve.states.back().moment};
  for (std::size_t i = peak + 1; i < curve.states.size() && top != 0; ++i) {
    const double now = curve.states[i].moment / top, before = curve.states[i - 1].moment / top;
    if (now > 0.8) continue;
    out.ultimate = between(curve.states[i - 1], curve.states[i], before, now, 0.8);
    out.fallen = true;
    break;
  }
  return out;
}

namespace {

// Stress at `strain`, reached from zero in even steps.
double stress_at(const UniaxialLaw& law, double strain, int steps) {
  std::vector<double> committed(static_cast<std::size_t>(history_size(law))), trial(committed.size());
  initialize_history(law, committed.data());
  double stress = 0;
  for (int i = 1; i <= steps; ++i) {
    stress = respond(law, strain * i / steps, committed.data(), trial.data()).stress;
    committed.swap(trial);
  }
  return stress;
}

struct Bounds {
  double shortening, elongation;
};

Bounds bounds(const UniaxialLaw& law, const StrainLimit& limit, int steps) {
  const auto counts = [&](double strain) {
    return std::abs(stress_at(law, strain, steps)) > 1e-9 * std::abs(initial_tangent(law) * strain);
  };
  constexpr double none = std::numeric_limits<double>::infinity();
  return {counts(-limit.shortening) ? limit.shortening : none, counts(limit.elongation) ? limit.elongation : none};
}

// How often `rate` fits into the bounds, and which part stops it.
std::pair<double, int> largest_factor(const AnalysedSection& section, const std::vector<Bounds>& all,
                                      const Vector3& rate) {
  std::pair<double, int> out{std::numeric_limits<double>::infinity(), -1};
  for (std::size_t i = 0; i < section.parts.size(); ++i) {
    const auto [low, high] = strain_range(section.parts[i], rate);
    const double factor = std::min(low < 0 ? all[i].shortening / -low : out.first,
                                   high > 0 ? all[i].elongation / high : out.first);
    if (factor < out.first) out = {factor, static_cast<int>(i)};
  }
  return out;
}

}  // namespace

std::vector<InteractionPoint> interaction(const AnalysedSection& section, const InteractionOptions& options) {
  const Axes axes(options.angle);
  std::vector<Bounds> counted, given;
  double reach = 0;  // [m] from the axis of bending through the origin
  Vector3 bending;
  bending << 0, axes.along;
  for (std::size_t i = 0; i < section.parts.size(); ++i) {
    const SectionPart& part = section.parts[i];
    counted.push_back(bounds(part.law, options.limits[i], options.steps));
    given.push_back({options.limits[i].shortening, options.limits[i].elongation});
    const auto [low, high] = strain_range(part, bending);
    reach = std::max({reach, std::abs(low), std::abs(high)});
  }
  if (reach == 0)
    throw InputError(fmt::format("error: the fibers of section '{}' lie on the axis of bending", section.name));
  std::vector<InteractionPoint> points;
  std::vector<double> committed(static_cast<std::size_t>(section.fibers.history_size)), trial(committed.size());
  for (int i = 0; i < options.points; ++i) {
    const double phi = pi * (options.points == 1 ? 0 : double(i) / (options.points - 1) - 0.5);
    const bool pure = i == 0 || i == options.points - 1;
    Vector3 rate = (pure ? 0 : std::cos(phi) / reach) * bending;
    rate[0] = std::sin(phi);
    auto [factor, governing] = largest_factor(section, counted, rate);
    if (governing < 0) std::tie(factor, governing) = largest_factor(section, given, rate);
    InteractionPoint point;
    point.governing = governing;
    initialize_history(section.fibers, committed.data());
    for (int step = 1; step <= options.steps; ++step) {
      point.deformation = factor * step / options.steps * rate;
      point.force = respond(section.fibers, point.deformation, committed.data(), trial.data()).force;
      committed.swap(trial);
    }
    point.moment = axes.along.dot(point.force.tail<2>());
    point.transverse_moment = axes.across.dot(point.force.tail<2>());
    points.push_back(point);
  }
  return points;
}

}  // namespace nsframe
