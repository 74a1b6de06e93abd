// Trusses with any uniaxial law, and tension-only elastic cables, both with pretension. The strain is the elongation
// over the length at the start, in every geometry.
#pragma once

#include "elements/member.hpp"
#include "materials/uniaxial.hpp"

namespace nsframe {

// Linear when the law is and nothing else makes it nonlinear: such trusses belong in a group of their own.
class Trusses : public Members {
 public:
  enum class Kind { linear, nonlinear, cable, damper };  // damper: its law depends on the rate of strain
  Trusses(Kind kind, Geometry geometry) : Members(bar_geometry(geometry)), kind_(kind) {}
  // `pretension` [N], positive in tension.
  void add(const ElementNodes& nodes, std::string id, const BeamFrame& frame, const UniaxialLaw& law, double area,
           double pretension);

  std::string_view kind() const override { return kind_ == Kind::cable ? "cable" : "truss"; }
  bool rate_dependent() const override { return kind_ == Kind::damper; }
  RateEnergy respond_rate(int element, const Vector12& displacement, const double* committed, double* trial,
                          const StepSpan& step, Vector12& force, Matrix12& tangent) const override;
  Vector12 rate_force(int element, const Vector12& displacement, const double* history) const override;
  ElementShape shape(int element) const override { return member_shape(element, nullptr); }

 protected:
  bool linear_basic() const override { return kind_ == Kind::linear; }
  void initialize_basic(int element, double* history) const override;
  void respond_basic(int element, const Vector6& deformation, const ActingLoad& acting, double rounding,
                     const double* committed, double* trial, Vector6& force, Matrix6* tangent) const override;
  std::vector<SectionResult> basic_sections(int element, const Vector6& deformation, const ActingLoad& acting,
                                            const double* history) const override;

 private:
  struct Element {
    double length;  // [m]
    UniaxialLaw law;
    double area;
    double pretension;
  };
  UniaxialPoint axial(const Element& element, double elongation, const double* committed, double* trial) const;

  Kind kind_;
  std::vector<Element> elements_;
};

}  // namespace nsframe
