// theory.md, "Laws in series".
#include "materials/series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/errors.hpp"
#include "materials/uniaxial.hpp"

namespace nsframe {

namespace {

using PerLaw = std::array<double, Series::most>;

// The laws of a series, with what is constant about them.
struct Chain {
  const std::vector<InnerLaw>& materials;
  std::size_t size;
  PerLaw initial_tangent{};
  std::array<int, Series::most> history_begin{};
  int history_size = 0;

  explicit Chain(const std::vector<InnerLaw>& all) : materials(all), size(all.size()) {
    history_size = static_cast<int>(size);  // the strains of the laws come first
    for (std::size_t m = 0; m < size; ++m) {
      initial_tangent[m] = nsframe::initial_tangent(all[m]);
      history_begin[m] = history_size;
      history_size += nsframe::history_size(all[m]);
    }
  }
};

// Strain, stress and tangent of every law at some points: value[m * wrapped_points + i].
struct Strains {
  std::array<double, Series::most * wrapped_points> strain, stress, tangent;
};

// One point's share of it.
struct Point {
  PerLaw strain{}, stress{}, tangent{};
};

void evaluate_all(const Chain& chain, const PointArrays& p, Strains& at, Evaluate evaluate) {
  for (std::size_t m = 0; m < chain.size; ++m) {
    const std::size_t row = m * wrapped_points;
    evaluate(*chain.materials[m].law,
             p.inside(chain.history_begin[m], &at.strain[row], &at.stress[row], &at.tangent[row]));
  }
}

void evaluate_point(const Chain& chain, const PointArrays& point, Point& at, Evaluate evaluate) {
  for (std::size_t m = 0; m < chain.size; ++m)
    evaluate(*chain.materials[m].law,
             point.inside(chain.history_begin[m], &at.strain[m], &at.stress[m], &at.tangent[m]));
}

Point point_of(const Chain& chain, const Strains& all, int i) {
  Point at;
  for (std::size_t m = 0; m < chain.size; ++m) {
    const std::size_t k = m * wrapped_points + static_cast<std::size_t>(i);
    at.strain[m] = all.strain[k];
    at.stress[m] = all.stress[k];
    at.tangent[m] = all.tangent[k];
  }
  return at;
}

// The common stress that linear laws of these tangents would have, and how each law's strain changes towards it.
struct Step {
  double stress = 0, mismatch = 0, scale = 0;  // [Pa]
  double rest = 0, largest = 0;                // strain that is missing in the sum, largest strain [-]
  PerLaw change{};
  bool converged() const { return mismatch <= 1e-12 * scale && std::abs(rest) <= 2e-15 * largest; }
};

// `reach`: largest strain that a law or the series has had in this step.
Step newton_step(const Chain& chain, const Point& at, double strain, double reach) {
  Step step;
  double stiffest = 0;
  for (std::size_t m = 0; m < chain.size; ++m)
    stiffest = std::max({stiffest, chain.initial_tangent[m], std::abs(at.tangent[m])});
  PerLaw flexibilities{};
  double flexibility = 0;
  std::size_t softest = 0;
  step.rest = strain;
  step.largest = reach;
  // a stress is known to rounding of its own and of the strain that it is made of
  step.scale = 1e-3 * stiffest * reach;
  for (std::size_t m = 0; m < chain.size; ++m) {
    // falling or flat branches count as soft ones: the direction stays one of descent
    flexibilities[m] = 1 / std::max(std::abs(at.tangent[m]), 1e-9 * stiffest);
    flexibility += flexibilities[m];
    if (flexibilities[m] > flexibilities[softest]) softest = m;
    step.rest -= at.strain[m];
    step.largest = std::max(step.largest, std::abs(at.strain[m]));
    step.scale = std::max({step.scale, std::abs(at.stress[m]), std::abs(at.tangent[m] * at.strain[m])});
  }
  // counted from the stress of the softest law, whose strain would lose its digits otherwise
  const double base = at.stress[softest];
  double rise = step.rest;
  for (std::size_t m = 0; m < chain.size; ++m) rise += flexibilities[m] * (at.stress[m] - base);
  rise /= flexibility;
  step.stress = base + rise;
  for (std::size_t m = 0; m < chain.size; ++m) {
    const double difference = rise - (at.stress[m] - base);
    step.change[m] = flexibilities[m] * difference;
    step.mismatch = std::max(step.mismatch, std::abs(difference));
  }
  return step;
}

double tangent_of(const Chain& chain, const Point& at) {
  double flexibility = 0;
  for (std::size_t m = 0; m < chain.size; ++m) {
    if (at.tangent[m] == 0) return 0;
    flexibility += 1 / at.tangent[m];
  }
  return 1 / flexibility;
}

// Sum of stress times change along a step: the slope of the strain energy, negative while the step goes down.
double slope(const Chain& chain, const Point& at, const Step& step) {
  double sum = 0;
  for (std::size_t m = 0; m < chain.size; ++m) sum += (at.stress[m] - step.stress) * step.change[m];
  return sum;
}

// Goes along the step to where the strain energy stops falling: doubles, then halves the bracket.
void search(const Chain& chain, const PointArrays& p, const Point& from, const Step& step, Point& at, Evaluate evaluate) {
  const double start = slope(chain, from, step);
  const auto go = [&](double t) {
    for (std::size_t m = 0; m < chain.size; ++m) at.strain[m] = from.strain[m] + t * step.change[m];
    evaluate_point(chain, p, at, evaluate);
    return slope(chain, at, step);
  };
  double low = 0, high = 1, there = go(high);
  for (int i = 0; i < 8 && there < 0.5 * start; ++i) {
    low = high;
    there = go(high *= 2);
  }
  if (std::abs(there) <= 0.5 * std::abs(start)) return;
  for (int i = 0; i < 100 && there != 0; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) return;
    there = go(middle);
    (there < 0 ? low : high) = middle;
    if (std::abs(there) <= 1e-3 * std::abs(start)) return;
  }
}

// Largest committed strain of a law, or the trial strain of the series.
double reach_of(const Chain& chain, const PointArrays& p, int i) {
  double reach = std::abs(p.strain[i]);
  for (std::size_t m = 0; m < chain.size; ++m)
    reach = std::max(reach, std::abs(p.committed[static_cast<int>(m) * p.stride + i]));
  return reach;
}

// Descent on the strain energy, for points on which plain Newton doesn't settle.
Step descend(const Chain& chain, const PointArrays& p, Point& at, Evaluate evaluate) {
  // the strains found so far must add up before energies can be compared
  double rest = *p.strain;
  const double reach = reach_of(chain, p, 0);
  for (std::size_t m = 0; m < chain.size; ++m) rest -= (at.strain[m] = p.committed[static_cast<int>(m) * p.stride]);
  const auto softest = static_cast<std::size_t>(
      std::min_element(chain.initial_tangent.begin(), chain.initial_tangent.begin() + static_cast<long>(chain.size)) -
      chain.initial_tangent.begin());
  at.strain[softest] += rest;
  evaluate_point(chain, p, at, evaluate);
  for (int i = 0; i < 200; ++i) {
    const Step step = newton_step(chain, at, *p.strain, reach);
    if (step.converged()) return step;
    const Point from = at;
    search(chain, p, from, step, at, evaluate);
  }
  throw ConvergenceError(fmt::format("laws in series find no common stress at strain {:.6g}", *p.strain));
}

}  // namespace

void Series::check() const {
  require(!materials.empty(), "materials must name at least one law");
  require(materials.size() <= most, "materials must name at most eight laws");
}

int Series::history_size() const { return Chain(materials).history_size; }
void Series::initialize_history(double* history) const {
  const Chain chain(materials);
  for (std::size_t m = 0; m < chain.size; ++m) {
    history[m] = 0;
    nsframe::initialize_history(materials[m], history + chain.history_begin[m]);
  }
}
double Series::initial_tangent() const {
  double flexibility = 0;
  for (const InnerLaw& material : materials) flexibility += 1 / nsframe::initial_tangent(material);
  return 1 / flexibility;
}
// The weakest law yields first; no law takes more strain than it then has.
double Series::yield_strain() const {
  double least = std::numeric_limits<double>::infinity();
  for (const InnerLaw& m : materials) least = std::min(least, nsframe::initial_tangent(m) * nsframe::yield_strain(m));
  return initial_tangent() > 0 ? least / initial_tangent() : std::numeric_limits<double>::infinity();
}

void Series::respond(const PointArrays& p, Evaluate evaluate) const {
  const Chain chain(materials);
  Strains at;
  for (std::size_t m = 0; m < chain.size; ++m)
    std::copy_n(p.committed + static_cast<int>(m) * p.stride, p.count, &at.strain[m * wrapped_points]);
  std::array<bool, wrapped_points> settled{};
  int open = p.count;
  for (int iteration = 0; iteration < 12 && open > 0; ++iteration) {
    evaluate_all(chain, p, at, evaluate);
    open = 0;
    for (int i = 0; i < p.count; ++i) {
      const Point point = point_of(chain, at, i);
      const Step step = newton_step(chain, point, p.strain[i], reach_of(chain, p, i));
      settled[static_cast<std::size_t>(i)] = step.converged();
      if (settled[static_cast<std::size_t>(i)]) {
        p.stress[i] = step.stress;
        p.tangent[i] = tangent_of(chain, point);
        continue;
      }
      ++open;
      for (std::size_t m = 0; m < chain.size; ++m)
        at.strain[m * wrapped_points + static_cast<std::size_t>(i)] += step.change[m];
    }
  }
  for (int i = 0; i < p.count; ++i) {
    Point point = point_of(chain, at, i);
    if (!settled[static_cast<std::size_t>(i)]) {
      p.stress[i] = descend(chain, p.point(i), point, evaluate).stress;
      p.tangent[i] = tangent_of(chain, point);
    }
    for (std::size_t m = 0; m < chain.size; ++m) p.trial[static_cast<int>(m) * p.stride + i] = point.strain[m];
  }
}

}  // namespace nsframe
