#include "output/model_tables.hpp"

#include "output/floors.hpp"

namespace nsframe {
namespace {

using Doubles = std::vector<double>;
using Ints = std::vector<int>;

void append(Doubles& values, const Vector3& v) { values.insert(values.end(), v.data(), v.data() + 3); }

const Vector3& position_of(const Model& model, int node) { return model.nodes.position[static_cast<std::size_t>(node)]; }

void write_nodes(Hdf5File& file, const Model& model) {
  Doubles positions;
  for (const Vector3& position : model.nodes.position) append(positions, position);
  file.make_group("/model/nodes");
  file.write_texts("/model/nodes/id", model.nodes.id);
  file.write_numbers("/model/nodes/position", positions, {model.nodes.id.size(), 3});
  file.set_attribute("/model/nodes/position", "units", "m");
  file.write_numbers("/model/nodes/structure", model.nodes.structure);
}

void write_members(Hdf5File& file, const Model& model) {
  std::vector<std::string> ids, kinds;
  Ints nodes, curved;
  Doubles ends;
  for (const auto& group : model.groups) {
    for (int i = 0; i < group->size(); ++i) {
      const ElementNodes& pair = group->nodes(i);
      if (pair[0] < 0 || pair[1] < 0 || group->kind().find("spring") != std::string_view::npos) continue;
      const ElementShape shape = group->shape(i);
      if (!(shape.length > 0)) continue;
      ids.push_back(group->id(i));
      kinds.emplace_back(group->kind());
      nodes.insert(nodes.end(), pair.begin(), pair.end());
      curved.push_back(shape.beam ? 1 : 0);
      for (const std::size_t end : {0U, 1U}) append(ends, position_of(model, pair[end]) + shape.offset[end]);
    }
  }
  file.make_group("/model/members");
  file.write_texts("/model/members/id", ids);
  file.write_texts("/model/members/kind", kinds);
  file.write_numbers("/model/members/nodes", nodes, {ids.size(), 2});
  file.write_numbers("/model/members/ends", ends, {ids.size(), 2, 3});
  file.set_attribute("/model/members/ends", "units", "m");
  file.write_numbers("/model/members/curved", curved);
}

void write_slabs(Hdf5File& file, const Model& model) {
  std::vector<std::string> ids;
  Ints corners, first{0};
  for (const Slab& slab : model.slabs) {
    ids.push_back(slab.id);
    corners.insert(corners.end(), slab.corners.begin(), slab.corners.end());
    first.push_back(static_cast<int>(corners.size()));
  }
  file.make_group("/model/slabs");
  file.write_texts("/model/slabs/id", ids);
  file.write_numbers("/model/slabs/corner", corners);
  file.write_numbers("/model/slabs/first", first);
}

void write_floors(Hdf5File& file, const Model& model) {
  Ints structures, nodes, first{0};
  Doubles levels;
  for (int s = 0; s < static_cast<int>(model.structures.size()); ++s) {
    for (const Floor& floor : floors_of(model, s)) {
      structures.push_back(s);
      levels.push_back(floor.level);
      nodes.insert(nodes.end(), floor.nodes.begin(), floor.nodes.end());
      first.push_back(static_cast<int>(nodes.size()));
    }
  }
  file.make_group("/model/floors");
  file.write_numbers("/model/floors/structure", structures);
  file.write_numbers("/model/floors/level", levels);
  file.set_attribute("/model/floors/level", "units", "m");
  file.write_numbers("/model/floors/node", nodes);
  file.write_numbers("/model/floors/first", first);
}

void write_pairs(Hdf5File& file, const Model& model) {
  const auto structure_of = [&](const ContactPoint& point) {
    return point.fixed() ? -1 : model.nodes.structure[static_cast<std::size_t>(point.first_node())];
  };
  Doubles positions, normals;
  Ints structures;
  for (const ContactPair& pair : model.contacts.pairs) {
    append(positions, pair.b.fixed() ? pair.a.position : Vector3(0.5 * (pair.a.position + pair.b.position)));
    append(normals, pair.normal);
    structures.push_back(structure_of(pair.a));
    structures.push_back(structure_of(pair.b));
  }
  const std::size_t count = model.contacts.pairs.size();
  file.make_group("/model/pairs");
  file.write_numbers("/model/pairs/position", positions, {count, 3});
  file.set_attribute("/model/pairs/position", "units", "m");
  file.write_numbers("/model/pairs/normal", normals, {count, 3});
  file.write_numbers("/model/pairs/gap", Doubles(model.contacts.initial_gap.begin(), model.contacts.initial_gap.end()));
  file.set_attribute("/model/pairs/gap", "units", "m");
  file.set_attribute("/model/pairs/gap", "description", "at rest without loads");
  file.write_numbers("/model/pairs/structures", structures, {count, 2});
}

}  // namespace

void write_model_tables(Hdf5File& file, const Model& model) {
  std::vector<std::string> names;
  for (const Structure& structure : model.structures) names.push_back(structure.name);
  file.make_group("/model");
  file.write_texts("/model/structures", names);
  write_nodes(file, model);
  write_members(file, model);
  write_slabs(file, model);
  write_floors(file, model);
  write_pairs(file, model);
}

}  // namespace nsframe
