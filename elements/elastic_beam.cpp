#include "elements/elastic_beam.hpp"

namespace nsframe {

Matrix6 elastic_basic_stiffness(const ElasticSection& s, double L) {
  Matrix6 k = Matrix6::Zero();
  k(0, 0) = s.E * s.A / L;
  k(1, 1) = k(2, 2) = 4 * s.E * s.Iz / L;
  k(1, 2) = k(2, 1) = 2 * s.E * s.Iz / L;
  k(3, 3) = k(4, 4) = 4 * s.E * s.Iy / L;
  k(3, 4) = k(4, 3) = 2 * s.E * s.Iy / L;
  k(5, 5) = s.G * s.J / L;
  return k;
}

ElasticBeams::ElasticBeams(Geometry geometry)
    : Members(beam_geometry(geometry)), kind_("elastic_beam" + std::string(this->geometry().suffix())) {}

void ElasticBeams::add(const ElementNodes& nodes, std::string id, const BeamFrame& frame, const ElasticSection& section,
                       SectionOutline outline) {
  Members::add(nodes, std::move(id), frame, 0);
  elements_.push_back({elastic_basic_stiffness(section, frame.length), section, std::move(outline)});
}

void ElasticBeams::respond_basic(int element, const Vector6& deformation, double, const double*, double*, Vector6& force,
                                 Matrix6& tangent) const {
  tangent = elements_[static_cast<std::size_t>(element)].stiffness;
  force.noalias() = tangent * deformation;
}

ElementShape ElasticBeams::shape(int element) const {
  return member_shape(element, &elements_[static_cast<std::size_t>(element)].outline);
}

std::vector<SectionResult> ElasticBeams::basic_sections(int element, const Vector6& deformation, const double*) const {
  const Element& e = elements_[static_cast<std::size_t>(element)];
  const Vector6 q = e.stiffness * deformation;
  std::vector<SectionResult> results;
  for (const double x : {0.0, 1.0}) {
    SectionResult result;
    result.position = x;
    result.force = Vector3(q[0], (x - 1) * q[1] + x * q[2], (x - 1) * q[3] + x * q[4]);
    result.deformation = Vector3(result.force[0] / (e.section.E * e.section.A),
                                 result.force[1] / (e.section.E * e.section.Iz),
                                 result.force[2] / (e.section.E * e.section.Iy));
    results.push_back(result);
  }
  return results;
}

}  // namespace nsframe
