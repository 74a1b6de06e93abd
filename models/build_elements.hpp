// Element descriptions to element groups. A new kind of element is registered here.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "elements/beam_frame.hpp"
#include "elements/element_group.hpp"
#include "elements/fiber_section.hpp"
#include "models/description.hpp"
#include "models/materials.hpp"

namespace nsframe {

// Materials and sections by name, sections with their laws resolved.
struct Library {
  struct Section {
    const SectionDescription* description;
    ElasticSection elastic;                      // of a fiber section: from its initial tangent
    std::shared_ptr<const FiberSection> fibers;  // null for an elastic section
  };
  Materials materials;
  std::map<std::string, Section> sections;
};

Library build_library(const ModelDescription& description, Diagnostics& diagnostics);

// Collects the elements of all structures into groups of one kind.
class GroupBuilder {
 public:
  GroupBuilder(const Library& library, Diagnostics& diagnostics) : library_(library), diagnostics_(diagnostics) {}
  // `nodes`: resolved ends; `id`: unique in the model.
  void add(const ElementDescription& element, const ElementNodes& nodes, const Vector3& node_i, const Vector3& node_j,
           const std::string& id);
  void add(const SpringDescription& spring, const ElementNodes& nodes, const std::string& id);
  std::vector<std::unique_ptr<const ElementGroup>> take();

 private:
  template <class Group, class... Arguments>
  Group& group(const std::string& key, Arguments&&... arguments);
  void add_beam(const ElementDescription& element, const ElementNodes& nodes, const BeamFrame& frame, const std::string& id);
  void add_truss(const ElementDescription& element, const ElementNodes& nodes, const BeamFrame& frame, const std::string& id);

  const Library& library_;
  Diagnostics& diagnostics_;
  std::vector<std::pair<std::string, std::unique_ptr<ElementGroup>>> groups_;
};

template <class Map>
std::vector<std::string> keys(const Map& map) {
  std::vector<std::string> names;
  for (const auto& entry : map) names.push_back(entry.first);
  return names;
}

}  // namespace nsframe
