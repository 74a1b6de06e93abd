// Force-based fiber beam-columns: section forces interpolated exactly from the basic forces (Spacone, Filippou,
// Taucer 1996; the state determination of Neuenhofer, Filippou 1997). One element a member is enough.
#pragma once

#include "elements/force_state.hpp"

namespace nsframe {

// Section forces are N, Mz, My (n = 3), or with the shear forces dMz/dx, dMy/dx and torsion (n = 6), where sections have
// laws for these; compatibility of the member holds for all of them.
template <int n>
class ForceBeamsOf : public FiberBeams {
 public:
  using FiberBeams::FiberBeams;
  std::string_view kind() const override { return "force_beam"; }
  bool softened(int element, const double* history) const override;
  bool iterates() const override { return true; }
  StateWork state_work(int element, const double* history) const override;

 protected:
  void initialize_basic(int element, double* history) const override;
  void respond_basic(int element, const Vector6& deformation, const ActingLoad& acting, double rounding,
                     const double* committed, double* trial, Vector6& force, Matrix6* tangent) const override;
  void pass_basic(int element, const Vector6& deformation, const ActingLoad& acting, double rounding, const double* committed,
                  double* trial, Vector6& force, Matrix6* tangent) const override;
  std::vector<SectionResult> basic_sections(int element, const Vector6& deformation, const ActingLoad& acting,
                                            const double* history) const override;
  DeadResponse dead_response(int element, const Vector6& deformation, const Vector6& force, double part, const Matrix3& axes,
                             const double* committed, double* trial) const override;
  int head_size(const FiberMember& member) const override { return ForceHead<n>::size(member.rule.size()); }
  double torsion_stiffness(const FiberMember& member) const override;

 private:
  using State = ForceState<n>;
  static constexpr int basics = State::basics;
  // By iterations until its sections are in balance, or by one pass over them.
  void determine(bool iterate, int element, const Vector6& v, const ActingLoad& acting, double rounding, const double* committed,
                 double* trial, Vector6& force, Matrix6* tangent) const;
};

using ForceBeams = ForceBeamsOf<3>;
using AggregatedForceBeams = ForceBeamsOf<6>;

}  // namespace nsframe
