// Displacement-based fiber beam-columns: cubic transverse and linear axial displacements.
#pragma once

#include "elements/fiber_beam.hpp"

namespace nsframe {

class DisplacementBeams : public FiberBeams {
 public:
  using FiberBeams::FiberBeams;
  std::string_view kind() const override { return "displacement_beam"; }

 protected:
  void respond_basic(int element, const Vector6& deformation, double part, double rounding, const double* committed,
                     double* trial, Vector6& force, Matrix6* tangent) const override;
  std::vector<SectionResult> basic_sections(int element, const Vector6& deformation, double part,
                                            const double* history) const override;
  // With releases: the basic deformations as found last, those of the released ends in particular.
  int head_size(const FiberMember& member) const override { return member.releases.any() ? 5 : 0; }
  double torsion_stiffness(const FiberMember& member) const override;

 private:
  struct Basic {
    Vector5 force = Vector5::Zero();
    Matrix5 tangent = Matrix5::Zero();
  };
  // Section deformation (e0, kz, ky) at x in [0, 1] from the first five basic deformations.
  static Interpolation strain_interpolation(double x, double length);
  Basic integrate(const Element& element, const Vector5& deformation, const double* committed, double* trial,
                  bool with_tangent) const;
  // Torsional moment and its derivative by the twist of the whole member, from the sections' laws; the twist per length is
  // constant.
  static void twist(const Element& element, double rate, const double* committed, double* trial, double& moment,
                    double& stiffness);
  // Finds the deformations at released ends that leave no force there, from a first guess in `deformation`.
  Basic release(int element, Vector5& deformation, const Vector5& load, const double* committed, double* trial) const;
};

}  // namespace nsframe
