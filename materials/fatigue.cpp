#include "materials/fatigue.hpp"

#include <algorithm>
#include <cmath>

#include "materials/uniaxial.hpp"

namespace nsframe {

namespace {

// What a point remembers before the law inside; doubles only.
struct Count {
  double broken = 0;                       // 1 when it is
  double strain = 0, direction = 0;        // committed; +1, -1, or 0 before any movement
  double damage = 0;                       // of the cycles that are closed
  double open = 1;                         // reversals kept: 1 to 3
  double reversal[3] = {0, 0, 0};          // strains, oldest first
};
constexpr int own = sizeof(Count) / sizeof(double);

Count load(const PointArrays& p, int i) {
  Count count;
  auto* const to = reinterpret_cast<double*>(&count);
  for (int k = 0; k < own; ++k) to[k] = p.committed[k * p.stride + i];
  return count;
}
void store(const Count& count, const PointArrays& p, int i) {
  const auto* const from = reinterpret_cast<const double*>(&count);
  for (int k = 0; k < own; ++k) p.trial[k * p.stride + i] = from[k];
}

double cost(const Fatigue& law, double range) { return range < 1e-10 ? 0 : std::pow(range / law.E0, -1 / law.m); }

// Rainflow: the strain at which the direction just changed closes a cycle, or stays open. Of three kept reversals the
// new one always closes one of the two ranges, so that three are enough.
void add_reversal(const Fatigue& law, Count& c, double strain) {
  double* const r = c.reversal;
  if (c.open == 1) {
    r[1] = strain;
    c.open = 2;
  } else if (c.open == 2) {
    const double before = std::abs(r[1] - r[0]);
    if (std::abs(strain - r[1]) < before) {
      r[2] = strain;
      c.open = 3;
    } else {
      c.damage += 0.5 * cost(law, before);
      r[0] = r[1];
      r[1] = strain;
    }
  } else {
    const double before = std::abs(r[2] - r[1]), range = std::abs(strain - r[2]);
    c.damage += cost(law, std::min(before, range));
    if (range >= before) r[1] = strain;
    c.open = 2;
  }
}

// Damage if the strain turned here.
double damage_at(const Fatigue& law, const Count& c, double strain) {
  const double* const r = c.reversal;
  if (c.open == 1) return c.damage + 0.5 * cost(law, std::abs(strain - r[0]));
  const double first = std::abs(r[1] - r[0]);
  if (c.open == 2) return c.damage + 0.5 * (cost(law, std::abs(strain - r[1])) + cost(law, first));
  const double whole = std::abs(strain - r[0]);
  if (whole > first) return c.damage + cost(law, std::abs(r[2] - r[1])) + 0.5 * cost(law, whole);
  return c.damage + cost(law, std::abs(strain - r[2])) + 0.5 * cost(law, first);
}

Count count_to(const Fatigue& law, Count c, double strain, double stress) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (strain <= law.min.value_or(-infinity) || strain >= law.max.value_or(infinity)) {
    c.broken = 1;
    return c;
  }
  const double direction = strain > c.strain ? 1 : strain < c.strain ? -1 : c.direction;
  if (direction * c.direction < 0) add_reversal(law, c, c.strain);
  c.direction = direction;
  c.strain = strain;
  if (c.damage >= 1 || (stress > 0 && damage_at(law, c, strain) > 1)) c.broken = 1;
  return c;
}

}  // namespace

void Fatigue::check() const { require(!min || !max || *min < *max, "min must be below max"); }

int Fatigue::history_size() const { return own + nsframe::history_size(material); }
void Fatigue::initialize_history(double* history) const {
  const Count virgin;
  std::copy_n(reinterpret_cast<const double*>(&virgin), own, history);
  nsframe::initialize_history(material, history + own);
}
double Fatigue::initial_tangent() const { return nsframe::initial_tangent(material); }
double Fatigue::yield_strain() const { return nsframe::yield_strain(material); }
bool Fatigue::has_yielded(double strain, double stress) const {
  return nsframe::has_yielded(material.law->law, strain, stress);
}

void Fatigue::respond(const PointArrays& p, Evaluate evaluate) const {
  double inside[wrapped_points];
  // a broken point leaves the law inside where it broke
  for (int i = 0; i < p.count; ++i) inside[i] = p.committed[i] != 0 ? p.committed[p.stride + i] : p.strain[i];
  evaluate(*material.law, p.inside(own, inside, p.stress, p.tangent));
  for (int i = 0; i < p.count; ++i) {
    const Count committed = load(p, i);
    const Count trial = committed.broken != 0 ? committed : count_to(*this, committed, p.strain[i], p.stress[i]);
    store(trial, p, i);
    // the step in which it breaks still carries its stress, as in OpenSees: breaking is decided when a step ends
    if (trial.broken != 0) p.keep(i, own, history_size());
    if (committed.broken != 0) p.stress[i] = p.tangent[i] = 0;
  }
}

}  // namespace nsframe
