// State determination of force-based beam-columns: section deformations, and forces, from the deformations of the ends; by iterations
// within the element, or in one pass that leaves the rest to the next evaluation (Neuenhofer, Filippou 1997; theory.md, 385-389).
#pragma once

#include "elements/fiber_beam.hpp"

namespace nsframe {

// Views of a force-based element's own part of the history. Section forces are N, Mz, My (n = 3), or with the shear forces dMz/dx,
// dMy/dx and torsion (n = 6).
template <int n>
struct ForceHead {
  static constexpr int basics = n == 3 ? 5 : 6;  // basic forces; torsion apart where n = 3
  static constexpr int flags = basics + basics * basics, begin = flags + 3, point = 2 * n + n * n;
  Eigen::Map<Eigen::Matrix<double, basics, 1>> force;
  Eigen::Map<Eigen::Matrix<double, basics, basics>> tangent;
  double& softened;   // 1, once a section's tangent was not positive; else 0
  double& unsettled;  // StateWork of the last evaluation
  double& passes;
  double* point_data;  // for each point: deformation, force, tangent

  explicit ForceHead(double* data)
      : force(data), tangent(data + basics), softened(data[flags]), unsettled(data[flags + 1]), passes(data[flags + 2]), point_data(data + begin) {}
  static constexpr int size(int points) { return begin + point * points; }
  using Vector = Eigen::Map<Eigen::Matrix<double, n, 1>>;
  Vector section_deformation(int i) const { return Vector(point_data + point * i); }
  Vector section_force(int i) const { return Vector(point_data + point * i + n); }
  Eigen::Map<Eigen::Matrix<double, n, n>> section_tangent(int i) const {
    return Eigen::Map<Eigen::Matrix<double, n, n>>(point_data + point * i + 2 * n);
  }
};

// Which component of the section force a basic force makes, and its factor at x in [0, 1]; the shear forces that two
// basic forces make beside.
struct ForceInterpolation {
  std::array<int, 6> component;
  std::array<double, 6> factor;
};
inline ForceInterpolation interpolation(double x) { return {{0, 1, 1, 2, 2, 5}, {1, x - 1, x, x - 1, x, 1}}; }
// Component of the shear force, dM/dx, by basic force; none of the axial force and torsion.
inline constexpr std::array<int, 6> shear_component{-1, 3, 3, 4, 4, -1};

template <int n>
class ForceState {
 public:
  static constexpr int basics = ForceHead<n>::basics;
  using Element = FiberBeams::Element;
  using Section = Eigen::Matrix<double, n, 1>;
  using SectionMatrix = Eigen::Matrix<double, n, n>;
  using Basic = Eigen::Matrix<double, basics, 1>;
  using BasicMatrix = Eigen::Matrix<double, basics, basics>;

  // Histories are the element's own part. `rounding`: of the basic deformations [m, rad], for elements that do not deform at all.
  ForceState(const Element& element, const ActingLoad& acting, double rounding, const double* committed, double* trial);

  // From the first guess in the trial history. False when the sections are not found.
  bool iterate(const Basic& deformation) { return find(deformation, false); }
  // With one evaluation of the sections, unless that doesn't bring them nearer to balance.
  bool pass(const Basic& deformation) { return find(deformation, true); }

  // Of a virgin element: forces and tangents of the sections without deformation.
  static void initialize(const Element& element, double* history);
  // Section force at a point: from the basic forces, and from the load by equilibrium.
  static Section section_force(const Element& element, const Basic& basic_force, const ActingLoad& acting, int point);
  // Inverse of a section's tangent, also where it has none.
  static SectionMatrix section_flexibility(const FiberSection& section, const SectionMatrix& tangent);

 private:
  using PointVectors = std::array<Section, max_points>;
  // What keeps the sections from equilibrium with the basic forces: energies on the sections' flexibility of the unbalanced, the changed
  // and the whole section forces. Of the fibers, and of the laws beside them, whose energy may be much larger.
  struct Unbalance {
    Eigen::Array2d left, changed, whole;
  };
  bool find(const Basic& deformation, bool once);
  void balance(const Basic& deformation, bool new_tangents);
  Unbalance find_correction();
  double move(double length);
  void note_softening();
  static void respond_section(const FiberSection& section, const Section& deformation, const double* committed, double* trial, Section& force,
                              SectionMatrix& tangent);
  static Section load_force(const MemberLoad& load, double x, double length);
  // From the flexibility of the directions without release.
  static BasicMatrix tangent_of(const Element& element, const BasicMatrix& flexibility);

  const Element& e_;
  const ActingLoad& acting_;
  const double rounding_;
  const double* const committed_;
  double* const trial_;
  ForceHead<n> head_;
  const ForceHead<n> before_;
  std::array<SectionMatrix, max_points> flexibility_;
  PointVectors start_, correction_;  // section deformations, and what they lack
};

}  // namespace nsframe
