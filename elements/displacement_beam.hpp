// Displacement-based fiber beam-columns: cubic transverse and linear axial displacements.
#pragma once

#include "elements/fiber_beam.hpp"
#include "elements/quiet_note.hpp"

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

// Without releases and laws of torsion, and with sections that can be screened, a member is quiet as long as all its sections are
// (theory.md, 176): it then answers with its virgin tangent, its note counts, and of the sections' histories only the quiet ones of their
// blocks, which are brought up to date when the note is full. Once a fiber leaves the line, each section is on its own.
class DisplacementBeams : public FiberBeams {
 public:
  using FiberBeams::FiberBeams;
  std::string_view kind() const override { return "displacement_beam"; }
  int quiet_fibers(int element, const double* history) const override;

 protected:
  void initialize_basic(int element, double* history) const override;
  void start_basic(int element, const double* committed, double* trial) const override;
  void prepare(const Element& element) override;
  const double* with_sections(int element, const double* history, std::vector<double>& scratch) const override;
  void respond_basic(int element, const Vector6& deformation, const ActingLoad& acting, double rounding,
                     const double* committed, double* trial, Vector6& force, Matrix6* tangent) const override;
  std::vector<SectionResult> basic_sections(int element, const Vector6& deformation, const ActingLoad& acting,
                                            const double* history) const override;
  DeadResponse dead_response(int element, const Vector6& deformation, const Vector6& force, double part, const Matrix3& axes,
                             const double* committed, double* trial) const override;
  // With releases: the basic deformations as found last, those of the released ends in particular. Else the member's note.
  int head_size(const FiberMember& member) const override;
  double torsion_stiffness(const FiberMember& member) const override;

 private:
  using Note = QuietNote<5>;
  // What a quiet member needs, in one piece.
  struct Virgin {
    bool screened = false;  // can be quiet
    double torsion = 0;     // GJ/L [N m]
    double largest_y = 0, largest_z = 0;  // of the fibers of all sections [m]
    Vector5 force = Vector5::Zero();  // basic
    Matrix5 tangent = Matrix5::Zero();
  };
  bool quiet(int element, const double* history) const;
  // Brings the quiet history of a member to `deformation`; false when a fiber leaves the line there.
  bool stay_quiet(int element, const Vector5& deformation, const double* committed, double* trial) const;
  // Histories of the sections, each quiet on its own, from that of a quiet member.
  void hand_over(int element, const double* quiet, double* history) const;
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

  std::vector<Virgin> virgin_;
};

}  // namespace nsframe
