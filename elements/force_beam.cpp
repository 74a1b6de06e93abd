#include "elements/force_beam.hpp"

#include <fmt/format.h>

#include "base/errors.hpp"

namespace nsframe {

namespace {

// Views of the element's own part of the history (layout: head_size()).
struct Head {
  Eigen::Map<Vector5> force;
  Eigen::Map<Matrix5> tangent;
  double* point_data;

  explicit Head(double* data) : force(data), tangent(data + 5), point_data(data + 30) {}
  Eigen::Map<Vector3> section_deformation(int i) const { return Eigen::Map<Vector3>(point_data + 15 * i); }
  Eigen::Map<Vector3> section_force(int i) const { return Eigen::Map<Vector3>(point_data + 15 * i + 3); }
  Eigen::Map<Matrix3> section_tangent(int i) const { return Eigen::Map<Matrix3>(point_data + 15 * i + 6); }
};

// N, Mz, My at x in [0, 1] from the basic forces: constant and linear.
Matrix3x5 force_interpolation(double x) {
  Matrix3x5 b = Matrix3x5::Zero();
  b(0, 0) = 1;
  b(1, 1) = b(2, 3) = x - 1;
  b(1, 2) = b(2, 4) = x;
  return b;
}

constexpr int max_inner_iterations = 40;
// Section forces out of balance, relative, at which the last linear correction leaves an error of its square.
constexpr double inner_tolerance = 1e-7;

}  // namespace

void ForceBeams::initialize_history(int element, double* history) const {
  const Element& e = element_at(element);
  std::fill_n(history, head_size(), 0.0);
  Head head(history);
  for (int i = 0; i < points(); ++i) {
    double* const fibers = section_history(element, history, i);
    nsframe::initialize_history(*e.section, fibers);
    std::vector<double> scratch(static_cast<std::size_t>(e.section->history_size));
    const SectionResponse virgin = nsframe::respond(*e.section, Vector3::Zero(), fibers, scratch.data());
    head.section_force(i) = virgin.force;
    head.section_tangent(i) = virgin.tangent;
  }
  Vector5 deformation;
  Matrix5 flexibility;
  integrate(e, history, deformation, flexibility);
  head.tangent = flexibility.inverse();
}

void ForceBeams::start_step(int, const double* committed, double* trial) const {
  std::copy_n(committed, head_size(), trial);
}

// Element flexibility, and the deformation compatible with the basic forces when the sections out of balance are
// corrected with their tangent flexibility.
void ForceBeams::integrate(const Element& element, const double* data, Vector5& deformation, Matrix5& flexibility) const {
  const Head head(const_cast<double*>(data));
  deformation.setZero();
  flexibility.setZero();
  for (int i = 0; i < points(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const Matrix3x5 b = force_interpolation(rule_.position[at]);
    const Matrix3 f = head.section_tangent(i).inverse();
    const Vector3 corrected = head.section_deformation(i) + f * (b * head.force - head.section_force(i));
    const double weight = rule_.weight[at] * element.frame.length;
    deformation += weight * (b.transpose() * corrected);
    flexibility += weight * (b.transpose() * f * b);
  }
}

void ForceBeams::respond(int element, const Vector12& displacement, const double* committed, double* trial,
                         Vector12& force, Matrix12* tangent) const {
  const Element& e = element_at(element);
  const Vector6 v = e.frame.compatibility * displacement;
  Head head(trial);
  Vector5 compatible;
  Matrix5 flexibility;
  integrate(e, trial, compatible, flexibility);
  head.force += head.tangent * (v.head<5>() - compatible);
  for (int iteration = 0;; ++iteration) {
    double unbalance = 0, scale = 0;
    for (int i = 0; i < points(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      const Vector3 wanted = force_interpolation(rule_.position[at]) * head.force;
      head.section_deformation(i) += head.section_tangent(i).inverse() * (wanted - head.section_force(i));
      const SectionResponse response =
          nsframe::respond(*e.section, head.section_deformation(i), section_history(element, committed, i),
                           section_history(element, trial, i));
      head.section_force(i) = response.force;
      head.section_tangent(i) = response.tangent;
      // energies of the unbalanced and of the whole section force on the section's flexibility
      const Vector3 out_of_balance = wanted - response.force;
      const Matrix3 f = response.tangent.inverse();
      unbalance += out_of_balance.dot(f * out_of_balance);
      scale += wanted.dot(f * wanted);
    }
    integrate(e, trial, compatible, flexibility);
    head.tangent = flexibility.inverse();
    head.force += head.tangent * (v.head<5>() - compatible);
    if (!head.force.allFinite() || iteration >= max_inner_iterations) {
      throw ConvergenceError(fmt::format("force-based element '{}' does not find its section forces", id(element)));
    }
    if (unbalance <= inner_tolerance * inner_tolerance * scale) break;
  }
  const double torsion = e.section->torsion_stiffness / e.frame.length;
  Vector6 basic_force;
  basic_force << head.force, torsion * v[5];
  to_global(e.frame, p_delta_, displacement, basic_force, with_torsion(head.tangent, torsion), force, tangent);
}

std::vector<SectionResult> ForceBeams::sections(int element, const Vector12&, const double* history) const {
  const Head head(const_cast<double*>(history));
  std::vector<SectionResult> results;
  for (int i = 0; i < points(); ++i) results.push_back(section_result(element, i, head.section_deformation(i), history));
  return results;
}

}  // namespace nsframe
