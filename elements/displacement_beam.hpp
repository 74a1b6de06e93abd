// Displacement-based fiber beam-columns: cubic transverse and linear axial displacements.
#pragma once

#include "elements/fiber_beam.hpp"

namespace nsframe {

class DisplacementBeams : public FiberBeams {
 public:
  using FiberBeams::FiberBeams;
  std::string_view kind() const override { return "displacement_beam"; }
  void initialize_history(int element, double* history) const override;
  void respond(int element, const Vector12& displacement, const double* committed, double* trial, Vector12& force,
               Matrix12* tangent) const override;
  std::vector<SectionResult> sections(int element, const Vector12& displacement, const double* history) const override;

 protected:
  int head_size() const override { return 0; }

 private:
  // Section deformation (e0, kz, ky) at x in [0, 1] from the first five basic deformations.
  static Matrix3x5 strain_interpolation(double x, double length);
};

}  // namespace nsframe
