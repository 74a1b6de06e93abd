// Elastic Euler-Bernoulli beam-columns.
#pragma once

#include "elements/beam_frame.hpp"
#include "elements/element_group.hpp"

namespace nsframe {

// Basic stiffness of a prismatic member (6x6).
Matrix6 elastic_basic_stiffness(const ElasticSection& section, double length);

class ElasticBeams : public ElementGroup {
 public:
  explicit ElasticBeams(bool p_delta) : p_delta_(p_delta) {}
  void add(const ElementNodes& nodes, std::string id, const BeamFrame& frame, const ElasticSection& section,
           SectionOutline outline);

  std::string_view kind() const override { return p_delta_ ? "elastic_beam_p_delta" : "elastic_beam"; }
  bool linear() const override { return !p_delta_; }
  bool symmetric() const override { return !p_delta_; }
  void respond(int element, const Vector12& displacement, const double* committed, double* trial, Vector12& force,
               Matrix12* tangent) const override;
  ElementShape shape(int element) const override;
  std::vector<SectionResult> sections(int element, const Vector12& displacement, const double* history) const override;

 private:
  struct Element {
    BeamFrame frame;
    Matrix6 stiffness;
    ElasticSection section;
    SectionOutline outline;
  };
  bool p_delta_;
  std::vector<Element> elements_;
};

}  // namespace nsframe
