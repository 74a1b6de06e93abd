#include "materials/parallel.hpp"

#include <algorithm>

#include "materials/uniaxial.hpp"

namespace nsframe {

void Parallel::check() const {
  require(!materials.empty(), "materials must name at least one law");
  require(factors.empty() || factors.size() == materials.size(), "factors must be one for each of materials");
}

int Parallel::history_size() const {
  int size = 0;
  for (const InnerLaw& material : materials) size += nsframe::history_size(material);
  return size;
}
void Parallel::initialize_history(double* history) const {
  for (const InnerLaw& material : materials) {
    nsframe::initialize_history(material, history);
    history += nsframe::history_size(material);
  }
}
double Parallel::initial_tangent() const {
  double sum = 0;
  for (std::size_t i = 0; i < materials.size(); ++i) sum += factor(i) * nsframe::initial_tangent(materials[i]);
  return sum;
}
// Of the law that yields first.
double Parallel::yield_strain() const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < materials.size(); ++i)
    if (factor(i) != 0) least = std::min(least, nsframe::yield_strain(materials[i]));
  return least;
}

void Parallel::respond(const PointArrays& p, Evaluate evaluate) const {
  double stress[wrapped_points], tangent[wrapped_points];
  std::fill_n(p.stress, p.count, 0.0);
  std::fill_n(p.tangent, p.count, 0.0);
  int first = 0;
  for (std::size_t m = 0; m < materials.size(); ++m) {
    evaluate(*materials[m].law, p.inside(first, p.strain, stress, tangent));
    first += nsframe::history_size(materials[m]);
    for (int i = 0; i < p.count; ++i) {
      p.stress[i] += factor(m) * stress[i];
      p.tangent[i] += factor(m) * tangent[i];
    }
  }
}

}  // namespace nsframe
