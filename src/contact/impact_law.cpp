#include "contact/impact_law.hpp"

#include <cmath>
#include <limits>
#include <vector>

namespace nsframe {

double created_energy(const MatrixX& delassus, const VectorX& impulse, const VectorX& before, const VectorX& after) {
  const Eigen::Index n = impulse.size();
  std::vector<Eigen::Index> waiting;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (impulse[i] != 0) waiting.push_back(i);
  }
  double created = 0;
  while (!waiting.empty()) {
    std::vector<Eigen::Index> group{waiting.back()};
    waiting.pop_back();
    double energy = 0, rounding = 0;
    for (std::size_t k = 0; k < group.size(); ++k) {
      const Eigen::Index i = group[k];
      energy += 0.5 * impulse[i] * (before[i] + after[i]);
      rounding += std::abs(impulse[i]) * (std::abs(before[i]) + std::abs(after[i]));
      std::erase_if(waiting, [&](Eigen::Index j) {
        const bool coupled = std::abs(delassus(i, j)) > 1e-12 * std::sqrt(delassus(i, i) * delassus(j, j));
        if (coupled) group.push_back(j);
        return coupled;
      });
    }
    if (energy > 64 * std::numeric_limits<double>::epsilon() * rounding) created += energy;
  }
  return created;
}

PoissonImpact poisson_impact(const MatrixX& delassus, const VectorX& before, const VectorX& restitution,
                             const ComplementaritySolver& solve) {
  PoissonImpact impact;
  impact.compression = solve({delassus, before});
  const VectorX least = impact.compression + restitution.cwiseProduct(impact.compression);
  VectorX rate = before + delassus * least;
  VectorX noise = 64 * std::numeric_limits<double>::epsilon() * (delassus.cwiseAbs() * least);
  if (rate.size() > 0) noise.array() += 1e-12 * before.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < rate.size(); ++i) {  // what is left of redundant pairs at rest may be out of reach of any impulse
    if (std::abs(rate[i]) <= noise[i]) rate[i] = 0;
  }
  impact.impulse = least + solve({delassus, rate});
  impact.rate = before + delassus * impact.impulse;
  return impact;
}

}  // namespace nsframe
