// What displacement- and force-based fiber beam-columns share: sections at Gauss-Lobatto points and their histories.
#pragma once

#include <memory>

#include "elements/fiber_section.hpp"
#include "elements/member.hpp"
#include "elements/quadrature.hpp"

namespace nsframe {

using Matrix3x5 = Eigen::Matrix<double, 3, 5>;
using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

inline constexpr int max_points = 10;  // integration points of a member

class FiberBeams : public Members {
 public:
  // `points`: 2 to max_points.
  FiberBeams(Geometry geometry, int points) : Members(beam_geometry(geometry)), rule_(gauss_lobatto(points)) {}
  void add(const ElementNodes& nodes, std::string id, const BeamFrame& frame,
           std::shared_ptr<const FiberSection> section, SectionOutline outline);

  ElementShape shape(int element) const override;
  int points() const { return static_cast<int>(rule_.position.size()); }
  int fibers(int element) const { return points() * element_at(element).section->fibers; }

 protected:
  struct Element {
    double length;  // [m]
    std::shared_ptr<const FiberSection> section;
    SectionOutline outline;
  };
  // Doubles of its own that an element keeps before the histories of its sections.
  virtual int head_size() const = 0;
  const Element& element_at(int element) const { return elements_[static_cast<std::size_t>(element)]; }
  double* section_history(int element, double* history, int point) const {
    return history + head_size() + point * element_at(element).section->history_size;
  }
  const double* section_history(int element, const double* history, int point) const {
    return history + head_size() + point * element_at(element).section->history_size;
  }
  // Section result at a point from its deformation; `history`, the member's own, as committed.
  SectionResult section_result(int element, int point, const Vector3& deformation, const double* history) const;

  Quadrature rule_;

 private:
  std::vector<Element> elements_;
};

// The stiffness of the five bending and axial basic DOFs with torsion beside it.
Matrix6 with_torsion(const Matrix5& stiffness, double torsion);

}  // namespace nsframe
