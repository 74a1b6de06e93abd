// Force-based fiber beam-columns: section forces interpolated exactly from the basic forces (Spacone, Filippou,
// Taucer 1996; the state determination of Neuenhofer, Filippou 1997). One element a member is enough.
#pragma once

#include "elements/fiber_beam.hpp"

namespace nsframe {

// Section forces are N, Mz, My (n = 3), or with the shear forces dMz/dx, dMy/dx and torsion (n = 6), where sections have
// laws for these; compatibility of the member holds for all of them.
template <int n>
class ForceBeamsOf : public FiberBeams {
 public:
  using FiberBeams::FiberBeams;
  std::string_view kind() const override { return "force_beam"; }
  bool softened(int element, const double* history) const override;

 protected:
  void initialize_basic(int element, double* history) const override;
  void respond_basic(int element, const Vector6& deformation, const ActingLoad& acting, double rounding,
                     const double* committed, double* trial, Vector6& force, Matrix6* tangent) const override;
  std::vector<SectionResult> basic_sections(int element, const Vector6& deformation, const ActingLoad& acting,
                                            const double* history) const override;
  DeadResponse dead_response(int element, const Vector6& deformation, const Vector6& force, double part, const Matrix3& axes,
                             const double* committed, double* trial) const override;
  // Basic forces, element tangent, whether a section has softened, then for each point: deformation, force, tangent.
  int head_size(const FiberMember& member) const override { return basics * (1 + basics) + 1 + n * (2 + n) * member.rule.size(); }
  double torsion_stiffness(const FiberMember& member) const override;

 private:
  static constexpr int basics = n == 3 ? 5 : 6;  // basic forces; torsion apart where n = 3
  using Section = Eigen::Matrix<double, n, 1>;
  using SectionMatrix = Eigen::Matrix<double, n, n>;
  using Basic = Eigen::Matrix<double, basics, 1>;
  using BasicMatrix = Eigen::Matrix<double, basics, basics>;
  using PointVectors = std::array<Section, max_points>;
  using PointMatrices = std::array<SectionMatrix, max_points>;
  static void respond_section(const FiberSection& section, const Section& deformation, const double* committed, double* trial,
                              Section& force, SectionMatrix& tangent);
  static SectionMatrix section_flexibility(const FiberSection& section, const SectionMatrix& tangent);
  static Section section_force(const Element& element, const Basic& basic_force, const ActingLoad& acting, int point);
  static Section load_force(const MemberLoad& load, double x, double length);
  void balance(const Element& element, const Basic& deformation, const ActingLoad& acting, bool new_tangents, double* head,
               PointMatrices& flexibility) const;
  // From the flexibility of the directions without release.
  static BasicMatrix tangent_of(const Element& element, const BasicMatrix& flexibility);
  double move_sections(const Element& element, const PointVectors& start, const PointVectors& correction, double length,
                       const ActingLoad& acting, const double* committed, double* trial) const;
  // `rounding`: of the basic deformations [m, rad], for elements that do not deform at all.
  void find_sections(int element, const Basic& deformation, const ActingLoad& acting, double rounding, const double* committed,
                     double* trial) const;
};

using ForceBeams = ForceBeamsOf<3>;
using AggregatedForceBeams = ForceBeamsOf<6>;

}  // namespace nsframe
