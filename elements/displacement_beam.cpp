#include "elements/displacement_beam.hpp"

namespace nsframe {

Matrix3x5 DisplacementBeams::strain_interpolation(double x, double L) {
  Matrix3x5 B = Matrix3x5::Zero();
  B(0, 0) = 1 / L;
  B(1, 1) = B(2, 3) = (6 * x - 4) / L;
  B(1, 2) = B(2, 4) = (6 * x - 2) / L;
  return B;
}

void DisplacementBeams::initialize_basic(int element, double* history) const {
  for (int i = 0; i < points(); ++i) {
    nsframe::initialize_history(*element_at(element).section, section_history(element, history, i));
  }
}

void DisplacementBeams::respond_basic(int element, const Vector6& v, double, const double* committed, double* trial,
                                      Vector6& force, Matrix6& tangent) const {
  const Element& e = element_at(element);
  const double L = e.length;
  Vector5 q = Vector5::Zero();
  Matrix5 k = Matrix5::Zero();
  for (int i = 0; i < points(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const Matrix3x5 B = strain_interpolation(rule_.position[at], L);
    const SectionResponse response =
        nsframe::respond(*e.section, B * v.head<5>(), section_history(element, committed, i), section_history(element, trial, i));
    q += rule_.weight[at] * L * (B.transpose() * response.force);
    k += rule_.weight[at] * L * (B.transpose() * response.tangent * B);
  }
  const double torsion = e.section->torsion_stiffness / L;
  force << q, torsion * v[5];
  tangent = with_torsion(k, torsion);
}

std::vector<SectionResult> DisplacementBeams::basic_sections(int element, const Vector6& v, const double* history) const {
  std::vector<SectionResult> results;
  for (int i = 0; i < points(); ++i) {
    const Matrix3x5 B = strain_interpolation(rule_.position[static_cast<std::size_t>(i)], element_at(element).length);
    results.push_back(section_result(element, i, B * v.head<5>(), history));
  }
  return results;
}

}  // namespace nsframe
