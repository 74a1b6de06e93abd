#include "elements/force_state.hpp"

#include <cmath>

#include "base/symmetric_inverse.hpp"

namespace nsframe {

namespace {

constexpr int most_passes = 60;
constexpr int max_line_search = 30;
// Section forces out of balance relative to their change over the step (the last linear correction then leaves an
// error of about the square), and relative to the forces themselves (rounding).
constexpr double change_tolerance = 1e-4;
constexpr double section_tolerance = 1e-11;
// A pass may leave this much to the next evaluation: relative to the change over the step, and to what it found out of balance.
constexpr double carried_change = 0.1;
constexpr double carried_part = 0.5;
constexpr double softening = 1e-6;         // of the elastic stiffness, negative, that counts as such
constexpr double least_stiffness = 1e-10;  // of the elastic one, of a section all of whose fibers flow

constexpr double squared(double x) { return x * x; }

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
ForceState<n>::ForceState(const Element& element, const ActingLoad& acting, double rounding, const double* committed, double* trial)
    : e_(element), acting_(acting), rounding_(rounding), committed_(committed), trial_(trial), head_(trial),
      before_(const_cast<double*>(committed)) {}

template <int n>
auto ForceState<n>::section_force(const Element& e, const Basic& basic_force, const ActingLoad& acting, int point) -> Section {
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
auto ForceState<n>::load_force(const MemberLoad& load, double x, double length) -> Section {
  const LoadedSection s = section_forces(load, x, length);
  Section force = Section::Zero();
  force.template head<3>() << s.force.x(), s.moment.z(), s.moment.y();
  if constexpr (n == 6) force.template segment<2>(3) << -s.force.y(), s.force.z();  // dM/dx
  return force;
}

// A section at its deformation. Where it is rigid in shear, the force is left to the caller.
template <int n>
void ForceState<n>::respond_section(const FiberSection& section, const Section& deformation, const double* committed, double* trial,
                                    Section& force, SectionMatrix& tangent) {
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
auto ForceState<n>::section_flexibility(const FiberSection& section, const SectionMatrix& tangent) -> SectionMatrix {
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
void ForceState<n>::initialize(const Element& e, double* history) {
  const ForceHead<n> head(history);
  for (int i = 0; i < e.points(); ++i) {
    std::vector<double> scratch(static_cast<std::size_t>(e.section(i).history_size));
    Section force;
    SectionMatrix tangent;
    respond_section(e.section(i), Section::Zero(), e.section_history(history, i), scratch.data(), force, tangent);
    head.section_force(i) = force;
    head.section_tangent(i) = tangent;
  }
  ForceState(e, {}, 0, history, history).balance(Basic::Zero(), true);
}

// Basic forces and element tangent from the linearised sections: sum w b'(e + f (b q + s_load - s)) = v in the directions
// without release, q = 0 in the others. The basic forces are moved from where they were: a section that hardly resists has a
// flexibility so large that f s would drown e. Fills f. Without `new_tangents` the section tangents are those that the element
// tangent was found from.
template <int n>
void ForceState<n>::balance(const Basic& deformation, bool new_tangents) {
  BasicMatrix flexibility = BasicMatrix::Zero();
  Basic wanted = deformation;
  const Basic before = head_.force;
  const double L = e_.frame.length;
  for (int i = 0; i < e_.points(); ++i) {
    SectionMatrix& f = flexibility_[static_cast<std::size_t>(i)];
    f = section_flexibility(e_.section(i), head_.section_tangent(i));
    const double x = e_.position(i), weight = e_.weight(i);
    const auto [component, b] = interpolation(x);
    const Section remaining = weight * (head_.section_deformation(i) + f * (section_force(e_, before, acting_, i) - head_.section_force(i)));
    for (int j = 0; j < basics; ++j) {
      const auto column = static_cast<std::size_t>(j);
      wanted[j] -= b[column] * remaining[component[column]];
      for (int k = 0; new_tangents && k <= j; ++k) {
        const auto row = static_cast<std::size_t>(k);
        flexibility(k, j) += weight * b[row] * b[column] * f(component[row], component[column]);
      }
      if constexpr (n == 6) {
        const int shear = shear_component[column];
        if (shear < 0) continue;
        wanted[j] -= remaining[shear] / L;
        for (int k = 0; new_tangents && k <= j; ++k) {
          if (shear_component[static_cast<std::size_t>(k)] == shear) flexibility(k, j) += weight * f(shear, shear) / (L * L);
        }
      }
    }
  }
  if (new_tangents) head_.tangent = tangent_of(e_, flexibility.template selfadjointView<Eigen::Upper>());
  head_.force = before + head_.tangent * wanted;
}

template <int n>
auto ForceState<n>::tangent_of(const Element& e, const BasicMatrix& flexibility) -> BasicMatrix {
  if (!e.releases.any()) return symmetric_inverse<basics>(flexibility);
  Basic tied = Basic::Ones();
  for (int j = 0; j < basics; ++j) {
    if (e.releases.basic[static_cast<std::size_t>(j)]) tied[j] = 0;
  }
  BasicMatrix among_tied = tied.asDiagonal() * flexibility * tied.asDiagonal();
  among_tied.diagonal() += Basic::Ones() - tied;
  return tied.asDiagonal() * symmetric_inverse<basics>(among_tied) * tied.asDiagonal();
}

template <int n>
auto ForceState<n>::find_correction() -> Unbalance {
  Unbalance sum{Eigen::Array2d::Zero(), Eigen::Array2d::Zero(), Eigen::Array2d::Zero()};
  for (int i = 0; i < e_.points(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const Section wanted = section_force(e_, head_.force, acting_, i);
    const Section changed = wanted - before_.section_force(i), out_of_balance = wanted - head_.section_force(i);
    const SectionMatrix& f = flexibility_[at];
    start_[at] = head_.section_deformation(i);
    correction_[at] = f * out_of_balance;
    const Section of_change = f * changed, of_wanted = f * wanted;
    for (const int part_of : {0, 1}) {
      const Eigen::Index first = 3 * part_of;
      if (first >= n) break;
      const auto energy = [&](const Section& a, const Section& b) {
        return e_.weight(i) * a.template segment<3>(first).dot(b.template segment<3>(first));
      };
      sum.left[part_of] += energy(out_of_balance, correction_[at]);
      sum.changed[part_of] += energy(changed, of_change);
      sum.whole[part_of] += energy(wanted, of_wanted);
    }
  }
  return sum;
}

// Moves every section by `length` times its correction and evaluates it there. Returns the slope of the strain energy
// along the correction: the work on it of the section forces in excess of the basic forces, which do none.
template <int n>
double ForceState<n>::move(double length) {
  double slope = 0;
  for (int i = 0; i < e_.points(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    head_.section_deformation(i) = start_[at] + length * correction_[at];
    Section force;
    SectionMatrix tangent;
    respond_section(e_.section(i), head_.section_deformation(i), e_.section_history(committed_, i), e_.section_history(trial_, i),
                    force, tangent);
    const Section wanted = section_force(e_, head_.force, acting_, i);
    if constexpr (n == 6) {
      for (const Eigen::Index shear : {0, 1}) {
        if (!e_.section(i).added[static_cast<std::size_t>(shear)]) force[3 + shear] = wanted[3 + shear];
      }
    }
    head_.section_force(i) = force;
    head_.section_tangent(i) = tangent;
    const Section excess = force - wanted;
    slope += e_.weight(i) * excess.dot(correction_[at]);
  }
  ++head_.passes;
  return slope;
}

template <int n>
void ForceState<n>::note_softening() {
  head_.softened = before_.softened;
  for (int i = 0; i < e_.points() && head_.softened == 0; ++i) {
    if (softens(e_.section(i), head_.section_tangent(i).template topLeftCorner<3, 3>())) head_.softened = 1;
  }
}

// Given v, the section deformations minimise the strain energy under sum w b' e = v, with the basic forces as
// multipliers. Newton on that; once the constraint holds (after the first full step), corrections keep it, and a line
// search on the energy's slope ends the circles that sharply bent laws send Newton into.
template <int n>
bool ForceState<n>::find(const Basic& deformation, bool once) {
  head_.passes = 0;
  double last = 0;
  for (int iteration = 0;; ++iteration) {
    balance(deformation, iteration > 0);
    const Unbalance unbalance = find_correction();
    const Eigen::Array2d accepted = (squared(change_tolerance) * unbalance.changed)
                                        .max(squared(section_tolerance) * unbalance.whole)
                                        .max(squared(rounding_) * head_.tangent.trace());
    if (iteration > 0 && (unbalance.left <= accepted).all()) {
      head_.unsettled = 0;
      note_softening();
      return true;
    }
    const double left = unbalance.left.sum();
    if (!std::isfinite(left) || iteration >= most_passes) return false;
    if (once && iteration == 1 && left <= squared(carried_part) * last &&
        (unbalance.left <= (squared(carried_change) * unbalance.changed).max(accepted)).all()) {
      head_.unsettled = std::sqrt((unbalance.left > accepted).select(unbalance.left / accepted, 0.0).maxCoeff());
      return true;
    }
    last = left;
    double slope = move(1.0);
    double low = 0, high = 1;
    if (iteration == 0 || slope <= 0.5 * left) continue;
    for (int k = 0; k < max_line_search && std::abs(slope) > 0.5 * left; ++k) {
      const double middle = 0.5 * (low + high);
      slope = move(middle);
      (slope > 0 ? high : low) = middle;
    }
  }
}

template class ForceState<3>;
template class ForceState<6>;

}  // namespace nsframe
