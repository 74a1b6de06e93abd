// Element descriptions to element groups. A new kind of element is registered here.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "elements/beam_frame.hpp"
#include "elements/element_group.hpp"
#include "elements/fiber_section.hpp"
#include "elements/member_load.hpp"
#include "models/description.hpp"
#include "models/materials.hpp"

namespace nsframe {

// Materials and sections by name, sections with their laws resolved.
struct Library {
  struct Section {
    const SectionDescription* description;
    ElasticSection elastic;                      // of a fiber section: from its initial tangent
    std::shared_ptr<const FiberSection> fibers;  // of an elastic section: four elastic fibers
    MassSection mass;                            // geometry of the cross-section
    bool is_elastic = false;                     // described by constants
  };
  Materials materials;
  std::map<std::string, Section> sections;
};

Library build_library(const ModelDescription& description, Diagnostics& diagnostics);

// An element's mass, in global axes of its nodes.
struct ElementMass {
  std::string id;
  ElementNodes nodes;
  Matrix12 mass;
};

// Collects the elements of all structures into groups of one kind.
class GroupBuilder {
 public:
  // `gravity` [m/s2] acts on the mass of members as a load along them.
  GroupBuilder(const Library& library, const Vector3& gravity, Diagnostics& diagnostics)
      : library_(library), gravity_(gravity), diagnostics_(diagnostics) {}
  // `nodes`: resolved ends; `id`: unique in the model; `loads`: those that name the element.
  void add(const ElementDescription& element, const ElementNodes& nodes, const Vector3& node_i, const Vector3& node_j,
           const std::string& id, const std::vector<const LoadDescription*>& loads);
  void add(const SpringDescription& spring, const ElementNodes& nodes, const Vector3& end_i, const Vector3& end_j,
           const std::string& id);
  std::vector<std::shared_ptr<const ElementGroup>> take();
  const std::vector<ElementMass>& masses() const { return masses_; }

 private:
  // A beam with what its description refers to resolved.
  struct Beam {
    const ElementDescription& element;
    std::string id;
    ElementNodes nodes;
    BeamFrame frame;
    const Library::Section* section;
    MemberLoad load;
  };
  template <class Group, class... Arguments>
  Group& group(const std::string& key, Arguments&&... arguments);
  void add_elastic(const Beam& beam);
  void add_fiber(const Beam& beam);
  void add_mass(Beam& beam);
  void add_truss(const ElementDescription& element, const ElementNodes& nodes, const BeamFrame& frame, const std::string& id);
  std::vector<const Library::Section*> sections_at_points(const Beam& beam, int points);
  // Notes "KIND 'ID'WHAT". What the members of one table of a scene have in common is told once, with their number.
  void error(const Location& at, std::string_view kind, const std::string& id, const std::string& what);
  void error(const Beam& beam, const std::string& message) { error(beam.element.at, "element", beam.id, ": " + message); }
  void tell_errors();

  const Library& library_;
  Vector3 gravity_;
  Diagnostics& diagnostics_;
  std::vector<std::pair<std::string, std::unique_ptr<ElementGroup>>> groups_;
  std::vector<ElementMass> masses_;
  struct Fault {
    Location at;
    std::string subject, what;
    int others = 0;
  };
  std::vector<Fault> faults_;  // not told yet
};

template <class Map>
std::vector<std::string> keys(const Map& map) {
  std::vector<std::string> names;
  for (const auto& entry : map) names.push_back(entry.first);
  return names;
}

}  // namespace nsframe
