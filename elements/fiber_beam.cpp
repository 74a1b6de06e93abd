#include "elements/fiber_beam.hpp"

#include <algorithm>

#include "elements/screening.hpp"

namespace nsframe {

void FiberBeams::add(const ElementNodes& nodes, std::string id, FiberMember member) {
  Element e{std::move(member)};
  e.load = kept_load(e.load, e.frame);
  if (e.load.dead()) e.patterns = dead_patterns(e.load);
  e.torsion = e.releases.basic[5] ? 0 : torsion_stiffness(e);
  for (const auto& section : e.sections) e.twists = e.twists || (section->added[2] && !e.releases.basic[5]);
  const int own = own_offset(!e.load.empty());
  int end = own + head_size(e);
  for (const auto& section : e.sections) {
    const int begin = aligned_size(end);
    e.section_begin.push_back(begin - own);
    end = begin + section->history_size;
  }
  Members::add(nodes, std::move(id), e.frame, aligned_size(end) - own, !e.load.empty());
  elements_.push_back(std::move(e));
  prepare(elements_.back());
}

void FiberBeams::initialize_basic(int element, double* history) const {
  const Element& e = element_at(element);
  std::fill_n(history, e.section_begin.front(), 0.0);
  for (int i = 0; i < e.points(); ++i) nsframe::initialize_history(e.section(i), e.section_history(history, i));
}

void FiberBeams::start_basic(int element, const double* committed, double* trial) const {
  std::copy_n(committed, element_at(element).section_begin.front(), trial);
}

ElementShape FiberBeams::shape(int element) const {
  return member_shape(element, &element_at(element).outline, element_at(element).releases);
}

int FiberBeams::fibers(int element) const {
  int count = 0;
  for (const auto& section : element_at(element).sections) count += section->fibers;
  return count;
}

int FiberBeams::quiet_fibers(int element, const double* history) const {
  const Element& e = element_at(element);
  std::vector<double> scratch;
  const double* const own = with_sections(element, basic_history(element, history), scratch);
  int count = 0;
  for (int point = 0; point < e.points(); ++point) {
    if (is_quiet(e.section_history(own, point))) count += e.section(point).fibers;
  }
  return count;
}

void FiberBeams::prefetch(int element, const double* committed, const double* trial) const {
  const double *const from = basic_history(element, committed), *const to = basic_history(element, trial);
  __builtin_prefetch(from);
  __builtin_prefetch(from + aligned_doubles);
  __builtin_prefetch(to, 1);
  __builtin_prefetch(to + aligned_doubles, 1);
}

void FiberBeams::with_torsion(double torsion, const Vector5& basic_force, const Matrix5& basic_tangent, double twist,
                              Vector6& force, Matrix6* tangent) {
  force << basic_force, torsion * twist;
  if (!tangent) return;
  tangent->setZero();
  tangent->topLeftCorner<5, 5>() = basic_tangent;
  (*tangent)(5, 5) = torsion;
}

SectionResult FiberBeams::section_result(const Element& e, int point, const Vector3& deformation,
                                         const double* history) const {
  const FiberSection& section = e.section(point);
  const double* const committed = e.section_history(history, point);
  std::vector<double> scratch(static_cast<std::size_t>(section.history_size));
  SectionResult result;
  result.position = e.position(point);
  result.deformation = deformation;
  result.force = nsframe::respond(section, deformation, committed, scratch.data()).force;
  result.peak_strain_ratio = peak_strain_ratio(section, deformation);
  result.yielded = has_yielded(section, deformation, committed) ? 1 : 0;
  return result;
}

std::vector<FiberPlace> FiberBeams::fiber_places(int element) const {
  const Element& e = element_at(element);
  std::vector<FiberPlace> places;
  for (int point = 0; point < e.points(); ++point) {
    for (FiberPlace place : nsframe::fiber_places(e.section(point))) {
      place.point = point;
      place.position = e.position(point);
      places.push_back(place);
    }
  }
  return places;
}

std::vector<FiberState> FiberBeams::fiber_states(int element, const Vector12& displacement, const double* history) const {
  const Element& e = element_at(element);
  std::vector<FiberState> states;
  const std::vector<SectionResult> results = sections(element, displacement, history);
  std::vector<double> scratch;
  const double* const own = with_sections(element, basic_history(element, history), scratch);
  for (int point = 0; point < e.points(); ++point) {
    const Vector3& deformation = results[static_cast<std::size_t>(point)].deformation;
    const auto at_point = nsframe::fiber_states(e.section(point), deformation, e.section_history(own, point));
    states.insert(states.end(), at_point.begin(), at_point.end());
  }
  return states;
}

}  // namespace nsframe
