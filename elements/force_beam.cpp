#include "elements/force_beam.hpp"

#include <fmt/format.h>

#include "base/errors.hpp"

namespace nsframe {

template <int n>
double ForceBeamsOf<n>::torsion_stiffness(const FiberMember& member) const {
  double flexibility = 0;
  for (std::size_t i = 0; i < member.sections.size(); ++i) {
    flexibility += member.rule.weight[i] / member.sections[i]->torsion_stiffness;
  }
  return 1 / (flexibility * member.frame.length);
}

template <int n>
void ForceBeamsOf<n>::initialize_basic(int element, double* history) const {
  FiberBeams::initialize_basic(element, history);
  State::initialize(element_at(element), history);
}

template <int n>
void ForceBeamsOf<n>::determine(bool iterate, int element, const Vector6& v, const ActingLoad& acting, double rounding,
                                const double* committed, double* trial, Vector6& force, Matrix6* tangent) const {
  State state(element_at(element), acting, rounding, committed, trial);
  const auto deformation = v.template head<basics>();
  if (!(iterate ? state.iterate(deformation) : state.pass(deformation)))
    throw ConvergenceError(fmt::format("force-based element '{}' does not find its section forces", id(element)));
  const ForceHead<n> head(trial);
  if constexpr (n == 3) {
    with_torsion(element_at(element).torsion, head.force, head.tangent, v[5], force, tangent);
  } else {
    force = head.force;
    if (tangent) *tangent = head.tangent;
  }
}

template <int n>
void ForceBeamsOf<n>::respond_basic(int element, const Vector6& v, const ActingLoad& acting, double rounding, const double* committed,
                                    double* trial, Vector6& force, Matrix6* tangent) const {
  determine(true, element, v, acting, rounding, committed, trial, force, tangent);
}

template <int n>
void ForceBeamsOf<n>::pass_basic(int element, const Vector6& v, const ActingLoad& acting, double rounding, const double* committed,
                                 double* trial, Vector6& force, Matrix6* tangent) const {
  determine(element_at(element).inner_iterations, element, v, acting, rounding, committed, trial, force, tangent);
}

template <int n>
StateWork ForceBeamsOf<n>::state_work(int element, const double* history) const {
  const ForceHead<n> head(basic_history(element, const_cast<double*>(history)));
  return {static_cast<int>(head.passes), head.unsettled};
}

template <int n>
DeadResponse ForceBeamsOf<n>::dead_response(int element, const Vector6&, const Vector6& force, double part, const Matrix3& axes,
                                            const double*, double* trial) const {
  const Element& e = element_at(element);
  const ForceHead<n> head(trial);
  const MemberLoad load = e.load.in(axes);
  DeadResponse response;
  Eigen::Matrix<double, basics, 9> mixed = Eigen::Matrix<double, basics, 9>::Zero();
  for (int i = 0; i < e.points(); ++i) {
    const double x = e.position(i), L = e.frame.length;
    Eigen::Matrix<double, n, 9> s = Eigen::Matrix<double, n, 9>::Zero();
    constexpr int known = n == 3 ? 3 : 5;
    s.template topRows<known>() = sections_by_entries(e.patterns, x, L).template topRows<known>();
    const typename State::SectionMatrix f = State::section_flexibility(e.section(i), head.section_tangent(i));
    const typename State::Section wanted = State::section_force(e, force.template head<basics>(), {part, &load}, i);
    const typename State::Section deformation = head.section_deformation(i) + f * (wanted - head.section_force(i));
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
  return ForceHead<n>(basic_history(element, const_cast<double*>(history))).softened > 0;
}

template <int n>
std::vector<SectionResult> ForceBeamsOf<n>::basic_sections(int element, const Vector6&, const ActingLoad&,
                                                           const double* history) const {
  const Element& e = element_at(element);
  const ForceHead<n> head(const_cast<double*>(history));
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
