#include "materials/min_max.hpp"

#include <algorithm>

#include "materials/uniaxial.hpp"

namespace nsframe {

void MinMax::check() const {
  require(min || max, "min or max must be given");
  require(!min || !max || *min < *max, "min must be below max");
}

// Component 0: 1 when broken; then the law inside.
int MinMax::history_size() const { return 1 + nsframe::history_size(material); }
void MinMax::initialize_history(double* history) const {
  history[0] = 0;
  nsframe::initialize_history(material, history + 1);
}
double MinMax::initial_tangent() const { return nsframe::initial_tangent(material); }
double MinMax::yield_strain() const { return nsframe::yield_strain(material); }
bool MinMax::has_yielded(double strain, double stress) const {
  return nsframe::has_yielded(material.law->law, strain, stress);
}

void MinMax::respond(const PointArrays& p, Evaluate evaluate) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double low = min.value_or(-infinity), high = max.value_or(infinity);
  double inside[wrapped_points];
  // the law inside sees no strain that it can't carry
  for (int i = 0; i < p.count; ++i) inside[i] = std::clamp(p.strain[i], low, high);
  evaluate(*material.law, p.inside(1, inside, p.stress, p.tangent));
  for (int i = 0; i < p.count; ++i) {
    const bool broken = p.committed[i] != 0 || p.strain[i] <= low || p.strain[i] >= high;
    p.trial[i] = broken ? 1 : 0;
    if (!broken) continue;
    p.stress[i] = p.tangent[i] = 0;
    p.keep(i, 1, history_size());
  }
}

}  // namespace nsframe
