#include "elements/force_beam.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

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

constexpr int max_inner_iterations = 60;
constexpr int max_line_search = 30;
// Section forces out of balance relative to their change over the step (the last linear correction then leaves an
// error of about the square), and relative to the forces themselves (rounding).
constexpr double change_tolerance = 1e-4;
constexpr double force_tolerance = 1e-11;
constexpr double least_stiffness = 1e-10;  // of the elastic one, of a section all of whose fibers flow

// Inverse of a section's tangent. A section that flows as a whole has none: its deformation follows from the other
// sections and the member's by a stiffness too small to change a force.
Matrix3 section_flexibility(const FiberSection& section, const Matrix3& tangent) {
  const Vector3 elastic = section.virgin.tangent.diagonal();
  const Matrix3 flexibility = tangent.inverse();
  if (flexibility.diagonal().cwiseProduct(elastic).cwiseAbs().maxCoeff() < 1 / least_stiffness) return flexibility;
  return (tangent + least_stiffness * Matrix3(elastic.asDiagonal())).inverse();
}

}  // namespace

double ForceBeams::torsion_stiffness(const FiberMember& member) const {
  double flexibility = 0;
  for (std::size_t i = 0; i < member.sections.size(); ++i) {
    flexibility += member.rule.weight[i] / member.sections[i]->torsion_stiffness;
  }
  return 1 / (flexibility * member.frame.length);
}

// Section force at a point: from the basic forces, and from the load by equilibrium.
Vector3 ForceBeams::section_force(const Element& e, const Vector5& basic_force, double part, int point) {
  Vector3 force = force_interpolation(e.position(point)) * basic_force;
  if (part != 0) force += part * nsframe::section_force(e.load, e.position(point), e.frame.length);
  return force;
}

void ForceBeams::initialize_basic(int element, double* history) const {
  FiberBeams::initialize_basic(element, history);
  const Element& e = element_at(element);
  Head head(history);
  for (int i = 0; i < e.points(); ++i) {
    std::vector<double> scratch(static_cast<std::size_t>(e.section(i).history_size));
    const SectionResponse virgin = nsframe::respond(e.section(i), Vector3::Zero(), e.section_history(history, i), scratch.data());
    head.section_force(i) = virgin.force;
    head.section_tangent(i) = virgin.tangent;
  }
  PointMatrices flexibility;
  balance(e, Vector5::Zero(), 0, history, flexibility);
}

// Basic forces and element tangent from the linearised sections: sum w b'(e + f (b q + s_load - s)) = v in the directions
// without release, q = 0 in the others. Fills f.
void ForceBeams::balance(const Element& e, const Vector5& deformation, double part, double* data, PointMatrices& f) const {
  constexpr std::array<int, 5> component{0, 1, 1, 2, 2};  // of the section force that a basic force makes
  Head head(data);
  Matrix5 flexibility = Matrix5::Zero();
  Vector5 wanted = deformation;
  for (int i = 0; i < e.points(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    f[at] = section_flexibility(e.section(i), head.section_tangent(i));
    const double x = e.position(i), weight = e.weight(i);
    const std::array<double, 5> b{1, x - 1, x, x - 1, x};  // the entries of force_interpolation(x)
    Vector3 carried = head.section_force(i);
    if (part != 0) carried -= part * nsframe::section_force(e.load, x, e.frame.length);
    const Vector3 remaining = weight * (head.section_deformation(i) - f[at] * carried);
    for (int j = 0; j < 5; ++j) {
      const auto column = static_cast<std::size_t>(j);
      wanted[j] -= b[column] * remaining[component[column]];
      for (int k = 0; k <= j; ++k) {
        const auto row = static_cast<std::size_t>(k);
        flexibility(k, j) += weight * b[row] * b[column] * f[at](component[row], component[column]);
      }
    }
  }
  flexibility.triangularView<Eigen::StrictlyLower>() = flexibility.transpose();
  if (!e.releases.any()) {
    head.tangent = flexibility.inverse();
    head.force = head.tangent * wanted;
    return;
  }
  Vector5 tied = Vector5::Ones();
  for (int j = 0; j < 5; ++j) {
    if (e.releases.basic[static_cast<std::size_t>(j)]) tied[j] = 0;
  }
  Matrix5 among_tied = tied.asDiagonal() * flexibility * tied.asDiagonal();
  among_tied.diagonal() += Vector5::Ones() - tied;
  head.tangent = tied.asDiagonal() * among_tied.inverse() * tied.asDiagonal();
  head.force = head.tangent * wanted;
}

// Moves every section by `length` times its correction and evaluates it there. Returns the slope of the strain energy
// along the correction: the work on it of the section forces in excess of the basic forces, which do none.
double ForceBeams::move_sections(const Element& e, const PointVectors& start, const PointVectors& correction,
                                 double length, double part, const double* committed, double* trial) const {
  Head head(trial);
  double slope = 0;
  for (int i = 0; i < e.points(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    head.section_deformation(i) = start[at] + length * correction[at];
    const SectionResponse response = nsframe::respond(e.section(i), head.section_deformation(i),
                                                      e.section_history(committed, i), e.section_history(trial, i));
    head.section_force(i) = response.force;
    head.section_tangent(i) = response.tangent;
    const Vector3 excess = response.force - section_force(e, head.force, part, i);
    slope += e.weight(i) * excess.dot(correction[at]);
  }
  return slope;
}

// Given v, the section deformations minimise the strain energy under sum w b' e = v, with the basic forces as
// multipliers. Newton on that; once the constraint holds (after the first full step), corrections keep it, and a line
// search on the energy's slope ends the circles that sharply bent laws send Newton into.
void ForceBeams::find_sections(int element, const Vector5& deformation, double part, double rounding,
                               const double* committed, double* trial) const {
  const Element& e = element_at(element);
  Head head(trial);
  const Head before(const_cast<double*>(committed));
  PointMatrices flexibility;
  PointVectors start, correction;
  for (int iteration = 0;; ++iteration) {
    balance(e, deformation, part, trial, flexibility);
    // energies of the unbalanced, the changed and the whole section forces on the sections' flexibility
    double unbalance = 0, change = 0, scale = 0;
    for (int i = 0; i < e.points(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      const Vector3 wanted = section_force(e, head.force, part, i);
      const Vector3 changed = wanted - before.section_force(i), out_of_balance = wanted - head.section_force(i);
      const Matrix3& f = flexibility[at];
      start[at] = head.section_deformation(i);
      correction[at] = f * out_of_balance;
      unbalance += e.weight(i) * out_of_balance.dot(correction[at]);
      change += e.weight(i) * changed.dot(f * changed);
      scale += e.weight(i) * wanted.dot(f * wanted);
    }
    const double accepted = std::max({change_tolerance * change_tolerance * change, force_tolerance * force_tolerance * scale,
                                      rounding * rounding * head.tangent.trace()});
    if (iteration > 0 && unbalance <= accepted) return;
    if (!std::isfinite(unbalance) || iteration >= max_inner_iterations) {
      throw ConvergenceError(fmt::format("force-based element '{}' does not find its section forces", id(element)));
    }
    double slope = move_sections(e, start, correction, 1.0, part, committed, trial);
    double low = 0, high = 1;
    if (iteration == 0 || slope <= 0.5 * unbalance) continue;
    for (int k = 0; k < max_line_search && std::abs(slope) > 0.5 * unbalance; ++k) {
      const double middle = 0.5 * (low + high);
      slope = move_sections(e, start, correction, middle, part, committed, trial);
      (slope > 0 ? high : low) = middle;
    }
  }
}

void ForceBeams::respond_basic(int element, const Vector6& v, double part, double rounding, const double* committed,
                               double* trial, Vector6& force, Matrix6& tangent) const {
  find_sections(element, v.head<5>(), part, rounding, committed, trial);
  const Head head(trial);
  with_torsion(element_at(element), head.force, head.tangent, v[5], force, tangent);
}

std::vector<SectionResult> ForceBeams::basic_sections(int element, const Vector6&, double, const double* history) const {
  const Element& e = element_at(element);
  const Head head(const_cast<double*>(history));
  std::vector<SectionResult> results;
  for (int i = 0; i < e.points(); ++i) results.push_back(section_result(e, i, head.section_deformation(i), history));
  return results;
}

}  // namespace nsframe
