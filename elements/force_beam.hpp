// Force-based fiber beam-columns: section forces interpolated exactly from the basic forces (Spacone, Filippou,
// Taucer 1996; the state determination of Neuenhofer, Filippou 1997). One element a member is enough.
#pragma once

#include "elements/fiber_beam.hpp"

namespace nsframe {

class ForceBeams : public FiberBeams {
 public:
  using FiberBeams::FiberBeams;
  std::string_view kind() const override { return "force_beam"; }

 protected:
  void initialize_basic(int element, double* history) const override;
  void respond_basic(int element, const Vector6& deformation, double part, double rounding, const double* committed,
                     double* trial, Vector6& force, Matrix6* tangent) const override;
  std::vector<SectionResult> basic_sections(int element, const Vector6& deformation, double part,
                                            const double* history) const override;
  // Basic forces (5), element tangent (25), then for each point: deformation (3), force (3), tangent (9).
  int head_size(const FiberMember& member) const override { return 30 + 15 * member.rule.size(); }
  double torsion_stiffness(const FiberMember& member) const override;

 private:
  using PointVectors = std::array<Vector3, max_points>;
  using PointMatrices = std::array<Matrix3, max_points>;
  static Vector3 section_force(const Element& element, const Vector5& basic_force, double part, int point);
  void balance(const Element& element, const Vector5& deformation, double part, bool new_tangents, double* head,
               PointMatrices& flexibility) const;
  // From the flexibility of the directions without release.
  static Matrix5 tangent_of(const Element& element, const Matrix5& flexibility);
  double move_sections(const Element& element, const PointVectors& start, const PointVectors& correction, double length,
                       double part, const double* committed, double* trial) const;
  // `rounding`: of the basic deformations [m, rad], for elements that do not deform at all.
  void find_sections(int element, const Vector5& deformation, double part, double rounding, const double* committed,
                     double* trial) const;
};

}  // namespace nsframe
