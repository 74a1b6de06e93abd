// Displacement-based fiber beam-columns: cubic transverse and linear axial displacements.
#pragma once

#include "elements/fiber_beam.hpp"

namespace nsframe {

// Section deformation b v at a point: e0 follows from the first basic deformation, kz from the next two, ky from the last two
// in the same way.
struct StrainInterpolation {
  double axial, first, second;

  // b v
  Vector3 operator()(const Vector5& v) const {
    return {axial * v[0], first * v[1] + second * v[2], first * v[3] + second * v[4]};
  }
  // sum += weight b' s
  void add_transposed(double weight, const Vector3& s, Vector5& sum) const {
    const Vector3 w = weight * s;
    sum[0] += axial * w[0];
    sum[1] += first * w[1];
    sum[2] += second * w[1];
    sum[3] += first * w[2];
    sum[4] += second * w[2];
  }
  // sum += weight b' k b
  void add_congruent(double weight, const Matrix3& k, Matrix5& sum) const {
    constexpr std::array<int, 5> component{0, 1, 1, 2, 2};
    const std::array<double, 5> b{axial, first, second, first, second};
    for (int j = 0; j < 5; ++j) {
      const double factor = weight * b[static_cast<std::size_t>(j)];
      for (int i = 0; i < 5; ++i) {
        const auto row = static_cast<std::size_t>(i), column = static_cast<std::size_t>(j);
        sum(i, j) += factor * b[row] * k(component[row], component[column]);
      }
    }
  }
};

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
  static StrainInterpolation strain_interpolation(double x, double length);
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
