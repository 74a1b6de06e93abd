#include "elements/elastic_beam.hpp"

namespace nsframe {

namespace {

// Ratio of bending to shear stiffness, 12 EI / (G A_s L^2); none without a shear area.
double shear_ratio(double EI, double G, double shear_area, double L) {
  return shear_area > 0 ? 12 * EI / (G * shear_area * L * L) : 0;
}

}  // namespace

Matrix6 elastic_basic_stiffness(const ElasticSection& s, double L) {
  Matrix6 k = Matrix6::Zero();
  k(0, 0) = s.E * s.A / L;
  k(5, 5) = s.G * s.J / L;
  const auto bend = [&](int at, double EI, double shear_area) {
    const double ratio = shear_ratio(EI, s.G, shear_area, L), unit = EI / (L * (1 + ratio));
    k(at, at) = k(at + 1, at + 1) = (4 + ratio) * unit;
    k(at, at + 1) = k(at + 1, at) = (2 - ratio) * unit;
  };
  bend(1, s.E * s.Iz, s.Ay);
  bend(3, s.E * s.Iy, s.Az);
  return k;
}

ElasticBeams::ElasticBeams(Geometry geometry)
    : Members(beam_geometry(geometry)), kind_("elastic_beam" + std::string(this->geometry().suffix())) {}

void ElasticBeams::add(const ElementNodes& nodes, std::string id, ElasticMember member) {
  Element e{std::move(member)};
  e.load = kept_load(e.load, e.frame);
  const ElasticSection& s = e.section;
  const double L = e.frame.length;
  e.stiffness = elastic_basic_stiffness(s, L);
  if (!e.load.empty()) e.clamped = -e.stiffness * free_deformations(e.load, L, s.E * s.A, s.E * s.Iz, s.E * s.Iy);
  if (e.releases.any()) {
    const Matrix6 release = release_matrix<6>(e.releases, e.stiffness);
    e.stiffness = (release * e.stiffness).eval();
    e.clamped = (release * e.clamped).eval();
  }
  if (e.load.dead()) {
    std::array<Vector6, 3> deformations;
    const std::array<MemberLoad, 3> patterns = dead_patterns(e.load);
    for (std::size_t k = 0; k < 3; ++k) deformations[k] = free_deformations(patterns[k], L, s.E * s.A, s.E * s.Iz, s.E * s.Iy);
    e.dead_deformation = by_entries(deformations);
    const auto shear = [&s](double area) { return area > 0 ? 1 / (s.G * area) : 0; };
    Eigen::Matrix<double, 5, 1> flexibility;
    flexibility << 1 / (s.E * s.A), 1 / (s.E * s.Iz), 1 / (s.E * s.Iy), shear(s.Ay), shear(s.Az);
    e.dead_displacement = prismatic_displacements(e.load, L, flexibility);
  }
  Members::add(nodes, std::move(id), e.frame, 0, !e.load.empty());
  elements_.push_back(std::move(e));
}

Vector6 ElasticBeams::Element::clamped_by(const ActingLoad& acting) const {
  if (!load.dead() || acting.part == 0) return acting.part * clamped;
  return -acting.part * (stiffness * free_deformations(*acting.load, frame.length, section.E * section.A, section.E * section.Iz,
                                                       section.E * section.Iy));
}

void ElasticBeams::respond_basic(int element, const Vector6& deformation, const ActingLoad& acting, double, const double*, double*,
                                 Vector6& force, Matrix6* tangent) const {
  const Element& e = element_at(element);
  if (tangent) *tangent = e.stiffness;
  force.noalias() = e.stiffness * deformation;
  if (!e.load.empty()) force += e.clamped_by(acting);
}

DeadResponse ElasticBeams::dead_response(int element, const Vector6&, const Vector6& force, double part, const Matrix3& axes,
                                         const double*, double*) const {
  const Element& e = element_at(element);
  const Matrix6x9& v = e.dead_deformation;
  const Matrix9& d = e.dead_displacement.by_entries;
  DeadResponse response;
  response.displacement = v.transpose() * force + part * (e.dead_displacement.by_local + d * entries(axes));
  response.force = -e.stiffness * v;
  response.displacement_by_load = d + v.transpose() * response.force;
  return response;
}

ElementShape ElasticBeams::shape(int element) const { return member_shape(element, &element_at(element).outline, element_at(element).releases); }

std::vector<SectionResult> ElasticBeams::basic_sections(int element, const Vector6& deformation, const ActingLoad& acting,
                                                        const double*) const {
  const Element& e = element_at(element);
  Vector6 q = e.stiffness * deformation;
  if (!e.load.empty()) q += e.clamped_by(acting);
  std::vector<SectionResult> results;
  for (const double x : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    if (e.load.empty() && x > 0 && x < 1) continue;
    SectionResult result;
    result.position = x;
    result.force = Vector3(q[0], (x - 1) * q[1] + x * q[2], (x - 1) * q[3] + x * q[4]);
    if (!e.load.empty()) result.force += acting.part * section_force(*acting.load, x, e.frame.length);
    result.deformation = Vector3(result.force[0] / (e.section.E * e.section.A),
                                 result.force[1] / (e.section.E * e.section.Iz),
                                 result.force[2] / (e.section.E * e.section.Iy));
    results.push_back(result);
  }
  return results;
}

}  // namespace nsframe
