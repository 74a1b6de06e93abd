#include "elements/force_beam.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "base/errors.hpp"
#include "base/symmetric_inverse.hpp"

namespace nsframe {

namespace {

// Views of the element's own part of the history (layout: head_size()).
template <int n>
struct Head {
  static constexpr int basics = n == 3 ? 5 : 6, flag = basics + basics * basics, begin = flag + 1, point = 2 * n + n * n;
  Eigen::Map<Eigen::Matrix<double, basics, 1>> force;
  Eigen::Map<Eigen::Matrix<double, basics, basics>> tangent;
  double& softened;  // 1, once a section's tangent was not positive; else 0
  double* point_data;

  explicit Head(double* data) : force(data), tangent(data + basics), softened(data[flag]), point_data(data + begin) {}
  using Vector = Eigen::Map<Eigen::Matrix<double, n, 1>>;
  Vector section_deformation(int i) const { return Vector(point_data + point * i); }
  Vector section_force(int i) const { return Vector(point_data + point * i + n); }
  Eigen::Map<Eigen::Matrix<double, n, n>> section_tangent(int i) const {
    return Eigen::Map<Eigen::Matrix<double, n, n>>(point_data + point * i + 2 * n);
  }
};

// Which component of the section force a basic force makes, and its factor at x in [0, 1]; the shear forces that two
// basic forces make beside.
struct ForceInterpolation {
  std::array<int, 6> component;
  std::array<double, 6> factor;
};
ForceInterpolation interpolation(double x) { return {{0, 1, 1, 2, 2, 5}, {1, x - 1, x, x - 1, x, 1}}; }
// Component of the shear force, dM/dx, by basic force; none of the axial force and torsion.
constexpr std::array<int, 6> shear_component{-1, 3, 3, 4, 4, -1};

constexpr int max_section_iterations = 60;
constexpr int max_line_search = 30;
// Section forces out of balance relative to their change over the step (the last linear correction then leaves an
// error of about the square), and relative to the forces themselves (rounding).
constexpr double change_tolerance = 1e-4;
constexpr double section_tolerance = 1e-11;
constexpr double softening = 1e-6;         // of the elastic stiffness, negative, that counts as such
constexpr double least_stiffness = 1e-10;  // of the elastic one, of a section all of whose fibers flow

// Inverse of the tangent of a section's fibers. A section that flows as a whole has none: its deformation follows from the other
// sections and the member's by a stiffness too small to change a force.
Matrix3 fiber_flexibility(const FiberSection& section, const Matrix3& tangent) {
  const Vector3 elastic = section.virgin.tangent.diagonal();
  const Matrix3 flexibility = tangent.inverse();
  if (flexibility.diagonal().cwiseProduct(elastic).cwiseAbs().maxCoeff() < 1 / least_stiffness) return flexibility;
  return (tangent + least_stiffness * Matrix3(elastic.asDiagonal())).inverse();
}

// Some deformation meets a falling force.
bool softens(const FiberSection& section, const Matrix3& tangent) {
  const Vector3 allowed = softening * section.virgin.tangent.diagonal();
  const double a = tangent(0, 0) + allowed[0], b = tangent(1, 1) + allowed[1], c = tangent(2, 2) + allowed[2];
  const double minor = a * b - tangent(0, 1) * tangent(1, 0);
  if (!(a > 0 && minor > 0)) return true;
  const double x = tangent(2, 0), y = tangent(2, 1);
  return !(c * minor > x * (x * b - y * tangent(0, 1)) + y * (y * a - x * tangent(0, 1)));
}

}  // namespace

template <int n>
double ForceBeamsOf<n>::torsion_stiffness(const FiberMember& member) const {
  double flexibility = 0;
  for (std::size_t i = 0; i < member.sections.size(); ++i) {
    flexibility += member.rule.weight[i] / member.sections[i]->torsion_stiffness;
  }
  return 1 / (flexibility * member.frame.length);
}

// Section force at a point: from the basic forces, and from the load by equilibrium.
template <int n>
auto ForceBeamsOf<n>::section_force(const Element& e, const Basic& basic_force, const ActingLoad& acting, int point) -> Section {
  const double x = e.position(point), L = e.frame.length;
  const auto [component, factor] = interpolation(x);
  Section force = Section::Zero();
  for (int j = 0; j < basics; ++j) {
    const auto at = static_cast<std::size_t>(j);
    force[component[at]] += factor[at] * basic_force[j];
    if constexpr (n == 6) {
      if (shear_component[at] >= 0) force[shear_component[at]] += basic_force[j] / L;
    }
  }
  if (acting.part != 0) force += acting.part * load_force(*acting.load, x, L);
  return force;
}

template <int n>
auto ForceBeamsOf<n>::load_force(const MemberLoad& load, double x, double length) -> Section {
  const LoadedSection s = section_forces(load, x, length);
  Section force = Section::Zero();
  force.template head<3>() << s.force.x(), s.moment.z(), s.moment.y();
  if constexpr (n == 6) force.template segment<2>(3) << -s.force.y(), s.force.z();  // dM/dx
  return force;
}

// A section at its deformation. Where it is rigid in shear, the force is left to the caller.
template <int n>
void ForceBeamsOf<n>::respond_section(const FiberSection& section, const Section& deformation, const double* committed,
                                      double* trial, Section& force, SectionMatrix& tangent) {
  const SectionResponse response = nsframe::respond(section, deformation.template head<3>(), committed, trial);
  if constexpr (n == 3) {
    force = response.force;
    tangent = response.tangent;
  } else {
    tangent.setZero();
    force.template head<3>() = response.force;
    tangent.template topLeftCorner<3, 3>() = response.tangent;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto at = static_cast<Eigen::Index>(3 + i);
      UniaxialPoint point{0, 0};
      if (section.added[i]) {
        point = respond_added(section, i, deformation[at], committed, trial);
      } else if (i == 2) {
        point = {section.torsion_stiffness * deformation[at], section.torsion_stiffness};
      }
      force[at] = point.stress;
      tangent(at, at) = point.tangent;
    }
  }
}

template <int n>
auto ForceBeamsOf<n>::section_flexibility(const FiberSection& section, const SectionMatrix& tangent) -> SectionMatrix {
  if constexpr (n == 3) {
    return fiber_flexibility(section, tangent);
  } else {
    SectionMatrix f = SectionMatrix::Zero();
    f.template topLeftCorner<3, 3>() = fiber_flexibility(section, tangent.template topLeftCorner<3, 3>());
    for (std::size_t i = 0; i < 3; ++i) {
      const auto at = static_cast<Eigen::Index>(3 + i);
      if (i == 2 || section.added[i]) f(at, at) = 1 / tangent(at, at);
    }
    return f;
  }
}

template <int n>
void ForceBeamsOf<n>::initialize_basic(int element, double* history) const {
  FiberBeams::initialize_basic(element, history);
  const Element& e = element_at(element);
  Head<n> head(history);
  for (int i = 0; i < e.points(); ++i) {
    std::vector<double> scratch(static_cast<std::size_t>(e.section(i).history_size));
    Section force;
    SectionMatrix tangent;
    respond_section(e.section(i), Section::Zero(), e.section_history(history, i), scratch.data(), force, tangent);
    head.section_force(i) = force;
    head.section_tangent(i) = tangent;
  }
  PointMatrices flexibility;
  balance(e, Basic::Zero(), {}, true, history, flexibility);
}

// Basic forces and element tangent from the linearised sections: sum w b'(e + f (b q + s_load - s)) = v in the directions
// without release, q = 0 in the others. The basic forces are moved from where they were: a section that hardly resists has a
// flexibility so large that f s would drown e. Fills f. Without `new_tangents` the section tangents are those that the element
// tangent was found from.
template <int n>
void ForceBeamsOf<n>::balance(const Element& e, const Basic& deformation, const ActingLoad& acting, bool new_tangents, double* data,
                              PointMatrices& f) const {
  Head<n> head(data);
  BasicMatrix flexibility = BasicMatrix::Zero();
  Basic wanted = deformation;
  const Basic before = head.force;
  const double L = e.frame.length;
  for (int i = 0; i < e.points(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    f[at] = section_flexibility(e.section(i), head.section_tangent(i));
    const double x = e.position(i), weight = e.weight(i);
    const auto [component, b] = interpolation(x);
    const Section remaining = weight * (head.section_deformation(i) + f[at] * (section_force(e, before, acting, i) - head.section_force(i)));
    for (int j = 0; j < basics; ++j) {
      const auto column = static_cast<std::size_t>(j);
      wanted[j] -= b[column] * remaining[component[column]];
      for (int k = 0; new_tangents && k <= j; ++k) {
        const auto row = static_cast<std::size_t>(k);
        flexibility(k, j) += weight * b[row] * b[column] * f[at](component[row], component[column]);
      }
      if constexpr (n == 6) {
        const int shear = shear_component[column];
        if (shear < 0) continue;
        wanted[j] -= remaining[shear] / L;
        for (int k = 0; new_tangents && k <= j; ++k) {
          if (shear_component[static_cast<std::size_t>(k)] == shear) flexibility(k, j) += weight * f[at](shear, shear) / (L * L);
        }
      }
    }
  }
  if (new_tangents) head.tangent = tangent_of(e, flexibility.template selfadjointView<Eigen::Upper>());
  head.force = before + head.tangent * wanted;
}

template <int n>
auto ForceBeamsOf<n>::tangent_of(const Element& e, const BasicMatrix& flexibility) -> BasicMatrix {
  if (!e.releases.any()) return symmetric_inverse<basics>(flexibility);
  Basic tied = Basic::Ones();
  for (int j = 0; j < basics; ++j) {
    if (e.releases.basic[static_cast<std::size_t>(j)]) tied[j] = 0;
  }
  BasicMatrix among_tied = tied.asDiagonal() * flexibility * tied.asDiagonal();
  among_tied.diagonal() += Basic::Ones() - tied;
  return tied.asDiagonal() * symmetric_inverse<basics>(among_tied) * tied.asDiagonal();
}

// Moves every section by `length` times its correction and evaluates it there. Returns the slope of the strain energy
// along the correction: the work on it of the section forces in excess of the basic forces, which do none.
template <int n>
double ForceBeamsOf<n>::move_sections(const Element& e, const PointVectors& start, const PointVectors& correction,
                                 double length, const ActingLoad& acting, const double* committed, double* trial) const {
  Head<n> head(trial);
  double slope = 0;
  for (int i = 0; i < e.points(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    head.section_deformation(i) = start[at] + length * correction[at];
    Section force;
    SectionMatrix tangent;
    respond_section(e.section(i), head.section_deformation(i), e.section_history(committed, i), e.section_history(trial, i),
                    force, tangent);
    const Section wanted = section_force(e, head.force, acting, i);
    if constexpr (n == 6) {
      for (const Eigen::Index shear : {0, 1}) {
        if (!e.section(i).added[static_cast<std::size_t>(shear)]) force[3 + shear] = wanted[3 + shear];
      }
    }
    head.section_force(i) = force;
    head.section_tangent(i) = tangent;
    const Section excess = force - wanted;
    slope += e.weight(i) * excess.dot(correction[at]);
  }
  return slope;
}

// Given v, the section deformations minimise the strain energy under sum w b' e = v, with the basic forces as
// multipliers. Newton on that; once the constraint holds (after the first full step), corrections keep it, and a line
// search on the energy's slope ends the circles that sharply bent laws send Newton into.
template <int n>
void ForceBeamsOf<n>::find_sections(int element, const Basic& deformation, const ActingLoad& acting, double rounding,
                               const double* committed, double* trial) const {
  const Element& e = element_at(element);
  Head<n> head(trial);
  const Head<n> before(const_cast<double*>(committed));
  PointMatrices flexibility;
  PointVectors start, correction;
  for (int iteration = 0;; ++iteration) {
    balance(e, deformation, acting, iteration > 0, trial, flexibility);
    // energies of the unbalanced, the changed and the whole section forces on the sections' flexibility: of the fibers, and of
    // the laws beside them, whose energy may be much larger
    Eigen::Array2d unbalances = Eigen::Array2d::Zero(), change = Eigen::Array2d::Zero(), scale = Eigen::Array2d::Zero();
    for (int i = 0; i < e.points(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      const Section wanted = section_force(e, head.force, acting, i);
      const Section changed = wanted - before.section_force(i), out_of_balance = wanted - head.section_force(i);
      const SectionMatrix& f = flexibility[at];
      start[at] = head.section_deformation(i);
      correction[at] = f * out_of_balance;
      const Section of_change = f * changed, of_wanted = f * wanted;
      for (const int part_of : {0, 1}) {
        const Eigen::Index first = 3 * part_of;
        if (first >= n) break;
        const auto energy = [&](const Section& a, const Section& b) {
          return e.weight(i) * a.template segment<3>(first).dot(b.template segment<3>(first));
        };
        unbalances[part_of] += energy(out_of_balance, correction[at]);
        change[part_of] += energy(changed, of_change);
        scale[part_of] += energy(wanted, of_wanted);
      }
    }
    const Eigen::Array2d accepted = (change_tolerance * change_tolerance * change)
                                        .max(section_tolerance * section_tolerance * scale)
                                        .max(rounding * rounding * head.tangent.trace());
    if (iteration > 0 && (unbalances <= accepted).all()) {
      head.softened = before.softened;
      for (int i = 0; i < e.points() && head.softened == 0; ++i) {
        if (softens(e.section(i), head.section_tangent(i).template topLeftCorner<3, 3>())) head.softened = 1;
      }
      return;
    }
    const double unbalance = unbalances.sum();
    if (!std::isfinite(unbalance) || iteration >= max_section_iterations) {
      throw ConvergenceError(fmt::format("force-based element '{}' does not find its section forces", id(element)));
    }
    double slope = move_sections(e, start, correction, 1.0, acting, committed, trial);
    double low = 0, high = 1;
    if (iteration == 0 || slope <= 0.5 * unbalance) continue;
    for (int k = 0; k < max_line_search && std::abs(slope) > 0.5 * unbalance; ++k) {
      const double middle = 0.5 * (low + high);
      slope = move_sections(e, start, correction, middle, acting, committed, trial);
      (slope > 0 ? high : low) = middle;
    }
  }
}

template <int n>
void ForceBeamsOf<n>::respond_basic(int element, const Vector6& v, const ActingLoad& acting, double rounding, const double* committed,
                                    double* trial, Vector6& force, Matrix6* tangent) const {
  find_sections(element, v.template head<basics>(), acting, rounding, committed, trial);
  const Head<n> head(trial);
  if constexpr (n == 3) {
    with_torsion(element_at(element).torsion, head.force, head.tangent, v[5], force, tangent);
  } else {
    force = head.force;
    if (tangent) *tangent = head.tangent;
  }
}

template <int n>
DeadResponse ForceBeamsOf<n>::dead_response(int element, const Vector6&, const Vector6& force, double part, const Matrix3& axes,
                                            const double*, double* trial) const {
  const Element& e = element_at(element);
  const Head<n> head(trial);
  const MemberLoad load = e.load.in(axes);
  DeadResponse response;
  Eigen::Matrix<double, basics, 9> mixed = Eigen::Matrix<double, basics, 9>::Zero();
  for (int i = 0; i < e.points(); ++i) {
    const double x = e.position(i), L = e.frame.length;
    Eigen::Matrix<double, n, 9> s = Eigen::Matrix<double, n, 9>::Zero();
    constexpr int known = n == 3 ? 3 : 5;
    s.template topRows<known>() = sections_by_entries(e.patterns, x, L).template topRows<known>();
    const SectionMatrix f = section_flexibility(e.section(i), head.section_tangent(i));
    const Section wanted = section_force(e, force.template head<basics>(), {part, &load}, i);
    const Section deformation = head.section_deformation(i) + f * (wanted - head.section_force(i));
    const Eigen::Matrix<double, n, 9> flexible = e.weight(i) * (f * s);
    response.displacement += e.weight(i) * (s.transpose() * deformation);
    response.displacement_by_load += s.transpose() * flexible;
    const auto [component, b] = interpolation(x);
    for (int j = 0; j < basics; ++j) {
      const auto at = static_cast<std::size_t>(j);
      mixed.row(j) += b[at] * flexible.row(component[at]);
      if constexpr (n == 6) {
        if (shear_component[at] >= 0) mixed.row(j) += flexible.row(shear_component[at]) / L;
      }
    }
  }
  const Eigen::Matrix<double, basics, 9> by_load = -(head.tangent * mixed);
  response.force.template topRows<basics>() = by_load;
  response.displacement_by_load += mixed.transpose() * by_load;
  return response;
}

template <int n>
bool ForceBeamsOf<n>::softened(int element, const double* history) const {
  return Head<n>(basic_history(element, const_cast<double*>(history))).softened > 0;
}

template <int n>
std::vector<SectionResult> ForceBeamsOf<n>::basic_sections(int element, const Vector6&, const ActingLoad&,
                                                           const double* history) const {
  const Element& e = element_at(element);
  const Head<n> head(const_cast<double*>(history));
  std::vector<SectionResult> results;
  for (int i = 0; i < e.points(); ++i) {
    SectionResult& result = results.emplace_back(section_result(e, i, head.section_deformation(i).template head<3>(), history));
    if constexpr (n == 6) {
      result.with_shear = true;
      result.shear_deformation = head.section_deformation(i).template tail<3>();
      result.shear_force = head.section_force(i).template tail<3>();
    }
  }
  return results;
}

template class ForceBeamsOf<3>;
template class ForceBeamsOf<6>;

}  // namespace nsframe
