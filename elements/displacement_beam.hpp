// Displacement-based fiber beam-columns: cubic transverse and linear axial displacements.
#pragma once

#include "elements/fiber_beam.hpp"

namespace nsframe {

class DisplacementBeams : public FiberBeams {
 public:
  using FiberBeams::FiberBeams;
  std::string_view kind() const override { return "displacement_beam"; }

 protected:
  void initialize_basic(int element, double* history) const override;
  void respond_basic(int element, const Vector6& deformation, double rounding, const double* committed, double* trial,
                     Vector6& force, Matrix6& tangent) const override;
  std::vector<SectionResult> basic_sections(int element, const Vector6& deformation, const double* history) const override;
  int head_size() const override { return 0; }

 private:
  // Section deformation (e0, kz, ky) at x in [0, 1] from the first five basic deformations.
  static Matrix3x5 strain_interpolation(double x, double length);
};

}  // namespace nsframe
