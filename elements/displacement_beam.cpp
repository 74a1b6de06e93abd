#include "elements/displacement_beam.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.hpp"
#include "elements/screening.hpp"

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

namespace {

bool can_be_quiet(const FiberMember& member) {
  return !member.releases.any() && std::all_of(member.sections.begin(), member.sections.end(), [](const auto& section) {
    return section->screened && std::none_of(section->added.begin(), section->added.end(), [](const auto& law) { return law.has_value(); });
  });
}

QuietNote<5>& note_of(double* history) { return *reinterpret_cast<QuietNote<5>*>(history); }
const QuietNote<5>& note_of(const double* history) { return *reinterpret_cast<const QuietNote<5>*>(history); }

// What a section went through by a member's note.
QuietPath path_of(const QuietNote<5>& note, const StrainInterpolation& b) {
  QuietPath path;
  path.steps = note.pending();
  for (int k = 0; k <= path.steps; ++k) Eigen::Map<Vector3>(path.deformation[k]) = b(Eigen::Map<const Vector5>(note.noted[k]));
  return path;
}

// Largest change of curvature along a member by the change of its end rotations: linear in between.
double largest_curvature(double first, double second, double length) {
  return 2 * std::max(std::abs(2 * first + second), std::abs(first + 2 * second)) / length;
}

}  // namespace

int DisplacementBeams::head_size(const FiberMember& member) const {
  if (member.releases.any()) return 5;
  return can_be_quiet(member) ? static_cast<int>(sizeof(Note) / sizeof(double)) : 0;
}

void DisplacementBeams::prepare(const Element& e) {
  Virgin& virgin = virgin_.emplace_back();
  virgin.screened = can_be_quiet(e);
  if (!virgin.screened) return;
  virgin.torsion = e.torsion;
  for (int i = 0; i < e.points(); ++i) {
    const FiberSection& section = e.section(i);
    const StrainInterpolation b = strain_interpolation(e.position(i), e.frame.length);
    b.add_transposed(e.weight(i), section.virgin.force, virgin.force);
    b.add_congruent(e.weight(i), section.virgin.tangent, virgin.tangent);
    virgin.largest_y = std::max(virgin.largest_y, section.largest_y);
    virgin.largest_z = std::max(virgin.largest_z, section.largest_z);
  }
}

bool DisplacementBeams::quiet(int element, const double* history) const {
  return virgin_[static_cast<std::size_t>(element)].screened && note_of(history).quiet != 0;
}

int DisplacementBeams::quiet_fibers(int element, const double* history) const {
  return quiet(element, basic_history(element, history)) ? fibers(element) : FiberBeams::quiet_fibers(element, history);
}

void DisplacementBeams::initialize_basic(int element, double* history) const {
  FiberBeams::initialize_basic(element, history);
  const Element& e = element_at(element);
  if (!virgin_[static_cast<std::size_t>(element)].screened) return;
  note_of(history).quiet = 1;
  for (int i = 0; i < e.points(); ++i) *e.section_history(history, i) = 0;
}

void DisplacementBeams::start_basic(int element, const double* committed, double* trial) const {
  if (!virgin_[static_cast<std::size_t>(element)].screened) FiberBeams::start_basic(element, committed, trial);
}

const double* DisplacementBeams::with_sections(int element, const double* history, std::vector<double>& scratch) const {
  if (!quiet(element, history)) return history;
  const Element& e = element_at(element);
  scratch.resize(static_cast<std::size_t>(e.section_begin.back() + e.section(e.points() - 1).history_size));
  hand_over(element, history, scratch.data());
  return scratch.data();
}

bool DisplacementBeams::stay_quiet(int element, const Vector5& v, const double* committed, double* trial) const {
  const Virgin& virgin = virgin_[static_cast<std::size_t>(element)];
  const Note& now = note_of(committed);
  Note& next = note_of(trial);
  const Vector5 change = v - Eigen::Map<const Vector5>(now.last);
  const double length = frame(element).length;
  const double moved = std::abs(change[0]) / length + virgin.largest_y * largest_curvature(change[1], change[2], length) +
                       virgin.largest_z * largest_curvature(change[3], change[4], length);
  // a section's own head is stale while the member is quiet, and says so
  if (now.reach > moved && now.pending() < pending_deformations) {
    note(now, next, v.data(), now.reach - moved, [&] {
      const Element& e = element_at(element);
      for (int i = 0; i < e.points(); ++i) {
        copy_quiet(e.section(i), e.section_history(committed, i), e.section_history(trial, i));
        *e.section_history(trial, i) = 0;
      }
    });
    return true;
  }
  const Element& e = element_at(element);
  next.quiet = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < e.points(); ++i) {
    const StrainInterpolation b = strain_interpolation(e.position(i), e.frame.length);
    QuietPath path = path_of(now, b);
    Eigen::Map<Vector3>(path.deformation[++path.steps]) = b(v);
    double reach = 0;
    *e.section_history(trial, i) = 0;
    if (!follow_path(e.section(i), path, e.section_history(committed, i), e.section_history(trial, i), reach)) return false;
    least = std::min(least, reach);
  }
  begin_note(next, name_after(now.path, v.data(), 5), v.data(), least);
  return true;
}

void DisplacementBeams::hand_over(int element, const double* quiet, double* history) const {
  const Element& e = element_at(element);
  const Note& now = note_of(quiet);
  note_of(history).quiet = 0;
  for (int i = 0; i < e.points(); ++i) {
    const QuietPath path = path_of(now, strain_interpolation(e.position(i), e.frame.length));
    double reach = 0;  // no fiber leaves the line: it has been there
    double* const own = e.section_history(history, i);
    follow_path(e.section(i), path, e.section_history(quiet, i), own, reach);
    const double index = i;
    begin_quiet(Vector3(path.deformation[path.steps]), name_after(now.path, &index, 1), reach, own);
  }
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

void DisplacementBeams::respond_basic(int element, const Vector6& v, const ActingLoad& acting, double, const double* committed,
                                      double* trial, Vector6& force, Matrix6* tangent) const {
  const Virgin& virgin = virgin_[static_cast<std::size_t>(element)];
  Vector5 load = Vector5::Zero(), deformation = v.head<5>();
  if (loaded(element)) load = acting.part * clamped_forces(*acting.load, frame(element).length).head<5>();
  const bool was_quiet = quiet(element, committed);
  if (was_quiet && stay_quiet(element, deformation, committed, trial)) {
    return with_torsion(virgin.torsion, virgin.tangent * deformation + virgin.force + load, virgin.tangent, v[5], force, tangent);
  }
  const Element& e = element_at(element);
  Basic basic;
  if (e.releases.any()) {
    Eigen::Map<Vector5> found(trial);
    for (int i = 0; i < 5; ++i) {
      if (e.releases.basic[static_cast<std::size_t>(i)]) deformation[i] = found[i];
    }
    basic = release(element, deformation, load, committed, trial);
    found = deformation;
  } else {
    if (virgin.screened) note_of(trial).quiet = 0;
    std::vector<double> scratch;
    basic = integrate(e, deformation, was_quiet ? with_sections(element, committed, scratch) : committed, trial, tangent != nullptr);
    basic.force += load;
  }
  with_torsion(e.torsion, basic.force, basic.tangent, v[5], force, tangent);
  if (!e.twists) return;
  double stiffness = 0;
  twist(e, v[5] / e.frame.length, committed, trial, force[5], stiffness);
  if (tangent) (*tangent)(5, 5) = stiffness;
}

DeadResponse DisplacementBeams::dead_response(int element, const Vector6& deformation, const Vector6&, double, const Matrix3&,
                                              const double* committed, double* trial) const {
  const Element& e = element_at(element);
  std::array<Vector6, 3> clamped;
  for (std::size_t k = 0; k < 3; ++k) clamped[k] = clamped_forces(e.patterns[k], e.frame.length);
  const Matrix6x9 all = by_entries(clamped);
  DeadResponse response;
  if (!e.releases.any()) {
    response.force = all;
    response.displacement = -all.transpose() * deformation;
    return response;
  }
  const Eigen::Map<const Vector5> found(trial);
  Vector5 v = deformation.head<5>(), released = Vector5::Zero();
  for (int i = 0; i < 5; ++i) {
    if (!e.releases.basic[static_cast<std::size_t>(i)]) continue;
    v[i] = found[i];
    released[i] = 1;
  }
  const Eigen::Matrix<double, 5, 9> bending = all.topRows<5>();
  const Matrix5 k = integrate(e, v, committed, trial, true).tangent;
  Matrix5 among_released = released.asDiagonal() * k * released.asDiagonal();
  among_released.diagonal() += Vector5::Ones() - released;
  const Eigen::Matrix<double, 5, 9> at_released = released.asDiagonal() * bending;
  response.displacement = -bending.transpose() * v;
  response.force.topRows<5>() = release_matrix<5>(e.releases, k) * bending;
  response.displacement_by_load = at_released.transpose() * (among_released.inverse() * at_released).eval();
  return response;
}

std::vector<SectionResult> DisplacementBeams::basic_sections(int element, const Vector6& v, const ActingLoad&,
                                                             const double* history) const {
  const Element& e = element_at(element);
  Vector5 deformation = v.head<5>();
  for (int i = 0; i < 5; ++i) {
    if (e.releases.basic[static_cast<std::size_t>(i)]) deformation[i] = history[i];
  }
  std::vector<double> scratch;
  const double* const own = with_sections(element, history, scratch);
  std::vector<SectionResult> results;
  for (int i = 0; i < e.points(); ++i) {
    results.push_back(section_result(e, i, strain_interpolation(e.position(i), e.frame.length)(deformation), own));
  }
  return results;
}

}  // namespace nsframe
