#include "elements/displacement_beam.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "base/errors.hpp"

namespace nsframe {

namespace {

constexpr int max_inner_iterations = 60;
constexpr double force_tolerance = 1e-12;  // of released forces, relative to the largest that the member could have there

}  // namespace

StrainInterpolation DisplacementBeams::strain_interpolation(double x, double L) {
  return {1 / L, (6 * x - 4) / L, (6 * x - 2) / L};
}

double DisplacementBeams::torsion_stiffness(const FiberMember& member) const {
  double sum = 0;
  for (std::size_t i = 0; i < member.sections.size(); ++i) sum += member.rule.weight[i] * member.sections[i]->torsion_stiffness;
  return sum / member.frame.length;
}

void DisplacementBeams::twist(const Element& e, double rate, const double* committed, double* trial, double& moment,
                              double& stiffness) {
  moment = stiffness = 0;
  for (int i = 0; i < e.points(); ++i) {
    const FiberSection& section = e.section(i);
    UniaxialPoint point{section.torsion_stiffness * rate, section.torsion_stiffness};
    if (section.added[2]) point = respond_added(section, 2, rate, e.section_history(committed, i), e.section_history(trial, i));
    const double part = e.rule.weight[static_cast<std::size_t>(i)];
    moment += part * point.stress;
    stiffness += part * point.tangent / e.frame.length;
  }
}

DisplacementBeams::Basic DisplacementBeams::integrate(const Element& e, const Vector5& deformation, const double* committed,
                                                      double* trial, bool with_tangent) const {
  Basic basic;
  for (int i = 0; i < e.points(); ++i) {
    const StrainInterpolation b = strain_interpolation(e.position(i), e.frame.length);
    const SectionResponse response = nsframe::respond(e.section(i), b(deformation), e.section_history(committed, i),
                                                      e.section_history(trial, i), with_tangent);
    b.add_transposed(e.weight(i), response.force, basic.force);
    if (with_tangent) b.add_congruent(e.weight(i), response.tangent, basic.tangent);
  }
  return basic;
}

DisplacementBeams::Basic DisplacementBeams::release(int element, Vector5& deformation, const Vector5& load,
                                                    const double* committed, double* trial) const {
  const Element& e = element_at(element);
  Vector5 released;
  for (int i = 0; i < 5; ++i) released[i] = e.releases.basic[static_cast<std::size_t>(i)] ? 1 : 0;
  double scale = 0;
  for (int iteration = 0;; ++iteration) {
    Basic basic = integrate(e, deformation, committed, trial, true);
    basic.force += load;
    const Vector5 unbalance = released.cwiseProduct(basic.force);
    scale = std::max(scale, basic.force.cwiseAbs().maxCoeff());
    // rounding of the deformations themselves
    const Vector5 rounding = basic.tangent.cwiseAbs() * deformation.cwiseAbs() * (4 * std::numeric_limits<double>::epsilon());
    if (unbalance.cwiseAbs().maxCoeff() <= std::max(force_tolerance * scale, rounding.maxCoeff())) {
      const Matrix5 R = release_matrix<5>(e.releases, basic.tangent);
      basic.force = R * basic.force;
      basic.tangent = R * basic.tangent;
      return basic;
    }
    if (!unbalance.allFinite() || iteration >= max_inner_iterations) {
      throw ConvergenceError(fmt::format("displacement-based element '{}' does not find the deformation at its released ends", id(element)));
    }
    // the identity in the rows and columns of tied ends keeps their deformation
    Matrix5 k = released.asDiagonal() * basic.tangent * released.asDiagonal();
    k.diagonal() += Vector5::Ones() - released;
    deformation -= k.inverse() * unbalance;
  }
}

void DisplacementBeams::respond_basic(int element, const Vector6& v, double part, double, const double* committed,
                                      double* trial, Vector6& force, Matrix6* tangent) const {
  const Element& e = element_at(element);
  Vector5 load = Vector5::Zero(), deformation = v.head<5>();
  if (!e.load.empty()) load = part * clamped_forces(e.load, e.frame.length).head<5>();
  Basic basic;
  if (e.releases.any()) {
    Eigen::Map<Vector5> found(trial);
    for (int i = 0; i < 5; ++i) {
      if (e.releases.basic[static_cast<std::size_t>(i)]) deformation[i] = found[i];
    }
    basic = release(element, deformation, load, committed, trial);
    found = deformation;
  } else {
    basic = integrate(e, deformation, committed, trial, tangent != nullptr);
    basic.force += load;
  }
  with_torsion(e, basic.force, basic.tangent, v[5], force, tangent);
  if (!e.twists) return;
  double stiffness = 0;
  twist(e, v[5] / e.frame.length, committed, trial, force[5], stiffness);
  if (tangent) (*tangent)(5, 5) = stiffness;
}

std::vector<SectionResult> DisplacementBeams::basic_sections(int element, const Vector6& v, double,
                                                             const double* history) const {
  const Element& e = element_at(element);
  Vector5 deformation = v.head<5>();
  for (int i = 0; i < 5; ++i) {
    if (e.releases.basic[static_cast<std::size_t>(i)]) deformation[i] = history[i];
  }
  std::vector<SectionResult> results;
  for (int i = 0; i < e.points(); ++i) {
    results.push_back(section_result(e, i, strain_interpolation(e.position(i), e.frame.length)(deformation), history));
  }
  return results;
}

}  // namespace nsframe
