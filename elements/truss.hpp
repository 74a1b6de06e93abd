// Trusses with any uniaxial law, and tension-only elastic cables, both with pretension. Small displacements; with
// p_delta the axial force also acts on the chord's shift.
#pragma once

#include "elements/beam_frame.hpp"
#include "elements/element_group.hpp"
#include "materials/uniaxial.hpp"

namespace nsframe {

// Linear when the law is and nothing else makes it nonlinear: such trusses belong in a group of their own.
class Trusses : public ElementGroup {
 public:
  enum class Kind { linear, nonlinear, cable };
  Trusses(Kind kind, bool p_delta) : kind_(kind), p_delta_(p_delta) {}
  // `pretension` [N], positive in tension.
  void add(const ElementNodes& nodes, std::string id, const BeamFrame& frame, const UniaxialLaw& law, double area,
           double pretension);

  std::string_view kind() const override { return kind_ == Kind::cable ? "cable" : "truss"; }
  bool linear() const override { return kind_ == Kind::linear && !p_delta_; }
  bool symmetric() const override { return !p_delta_; }
  int history_begin(int element) const override { return history_begin_[static_cast<std::size_t>(element)]; }
  void initialize_history(int element, double* history) const override;
  void respond(int element, const Vector12& displacement, const double* committed, double* trial, Vector12& force,
               Matrix12* tangent) const override;
  ElementShape shape(int element) const override;
  std::vector<SectionResult> sections(int element, const Vector12& displacement, const double* history) const override;

 private:
  struct Element {
    BeamFrame frame;
    UniaxialLaw law;
    double area;
    double pretension;
  };
  UniaxialPoint axial(const Element& element, const Vector12& displacement, const double* committed, double* trial) const;

  Kind kind_;
  bool p_delta_;
  std::vector<Element> elements_;
  std::vector<int> history_begin_{0};
};

}  // namespace nsframe
