// Elastic Euler-Bernoulli beam-columns.
#pragma once

#include "elements/member.hpp"

namespace nsframe {

// Basic stiffness of a prismatic member (6x6).
Matrix6 elastic_basic_stiffness(const ElasticSection& section, double length);

class ElasticBeams : public Members {
 public:
  explicit ElasticBeams(Geometry geometry);
  void add(const ElementNodes& nodes, std::string id, const BeamFrame& frame, const ElasticSection& section,
           SectionOutline outline);

  std::string_view kind() const override { return kind_; }
  ElementShape shape(int element) const override;

 protected:
  bool linear_basic() const override { return true; }
  void respond_basic(int element, const Vector6& deformation, double rounding, const double* committed, double* trial,
                     Vector6& force, Matrix6& tangent) const override;
  std::vector<SectionResult> basic_sections(int element, const Vector6& deformation, const double* history) const override;

 private:
  struct Element {
    Matrix6 stiffness;
    ElasticSection section;
    SectionOutline outline;
  };
  std::string kind_;
  std::vector<Element> elements_;
};

}  // namespace nsframe
