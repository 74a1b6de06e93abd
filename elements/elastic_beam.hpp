// Elastic beam-columns: Euler-Bernoulli, or Timoshenko where the section has shear areas.
#pragma once

#include "elements/member.hpp"
#include "elements/member_load.hpp"
#include "elements/releases.hpp"

namespace nsframe {

// Basic stiffness of a prismatic member (6x6).
Matrix6 elastic_basic_stiffness(const ElasticSection& section, double length);

struct ElasticMember {
  BeamFrame frame;
  ElasticSection section;
  SectionOutline outline = {};
  MemberLoad load = {};
  Releases releases = {};
};

class ElasticBeams : public Members {
 public:
  explicit ElasticBeams(Geometry geometry);
  void add(const ElementNodes& nodes, std::string id, ElasticMember member);

  std::string_view kind() const override { return kind_; }
  const MemberLoad* load(int element) const override { return &element_at(element).load; }
  ElementShape shape(int element) const override;

 protected:
  bool linear_basic() const override { return true; }
  void respond_basic(int element, const Vector6& deformation, const ActingLoad& acting, double rounding,
                     const double* committed, double* trial, Vector6& force, Matrix6* tangent) const override;
  // At the ends; of a member with a load also between them.
  std::vector<SectionResult> basic_sections(int element, const Vector6& deformation, const ActingLoad& acting,
                                            const double* history) const override;
  DeadResponse dead_response(int element, const Vector6& deformation, const Vector6& force, double part, const Matrix3& axes,
                             const double* committed, double* trial) const override;

 private:
  struct Element : ElasticMember {
    Matrix6 stiffness = Matrix6::Zero();  // with releases condensed
    Vector6 clamped = Vector6::Zero();    // basic forces of the load in local axes at no displacement, likewise
    Matrix6x9 dead_deformation = Matrix6x9::Zero();  // of the free basic system by the entries of the dead load
    PrismaticDisplacements dead_displacement = {};
    Vector6 clamped_by(const ActingLoad& acting) const;  // the acting part of all of the load
  };
  const Element& element_at(int element) const { return elements_[static_cast<std::size_t>(element)]; }

  std::string kind_;
  std::vector<Element> elements_;
};

}  // namespace nsframe
