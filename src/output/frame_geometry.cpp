#include "output/frame_geometry.hpp"

#include <algorithm>
#include <initializer_list>

#include "output/polygon.hpp"

namespace nsframe {
namespace {

struct CellOwner {
  int kind = 0, element = -1, pair = -1, structure = 0;
};

class Builder {
 public:
  explicit Builder(const Model& model, int segments) : model_(model), segments_(segments) {}

  FrameGeometry build();

 private:
  int add_station() { return stations_++; }
  void couple(int station, int direction, int full_dof, double factor) {
    if (factor != 0) motion_.emplace_back(6 * station + direction, full_dof, factor);
  }
  int node_station(int node);
  int add_point(int station, const Vector3& position, const Vector3& arm);
  void add_cell(CellType type, std::initializer_list<int> points, const CellOwner& owner, double along);

  void draw_elements();
  void draw_member(const ElementGroup& group, int element, const CellOwner& owner);
  int finite_station(const ElementNodes& nodes, double along);
  int point_station(const ContactPoint& point);
  void draw_sweep(const std::vector<int>& stations, const Vector3& start, const ElementShape& shape,
                  const SectionOutline& outline, const CellOwner& owner);
  void draw_curve(const std::vector<int>& stations, const Vector3& start, const ElementShape& shape,
                  const CellOwner& owner);
  void draw_slab(const Slab& slab);
  void draw_contact(int pair);

  const Model& model_;
  int segments_;
  FrameGeometry out_;
  int stations_ = 0;
  std::vector<int> station_of_node_;
  std::vector<Eigen::Triplet<double>> motion_;
};

const Vector3& position_of(const Model& model, int node) {
  return model.nodes.position[static_cast<std::size_t>(node)];
}

int structure_of(const Model& model, int node) { return model.nodes.structure[static_cast<std::size_t>(node)]; }

// Without repeated corners, counter-clockwise; empty when it encloses nothing.
SectionOutline tidy(const SectionOutline& outline) {
  SectionOutline tidied;
  for (const auto& corner : outline) {
    if (tidied.empty() || (corner - tidied.back()).norm() > 1e-9) tidied.push_back(corner);
  }
  while (tidied.size() > 1 && (tidied.front() - tidied.back()).norm() <= 1e-9) tidied.pop_back();
  if (tidied.size() < 3) return {};
  if (signed_area(tidied) < 0) std::reverse(tidied.begin(), tidied.end());
  return tidied;
}

bool is_drawn(const ElementGroup& group, int element) {
  const ElementNodes& nodes = group.nodes(element);
  if (nodes[0] < 0 || nodes[1] < 0) return false;
  if (group.kind().find("spring") != std::string_view::npos) return false;
  return group.shape(element).length > 0;
}

int Builder::node_station(int node) {
  int& station = station_of_node_[static_cast<std::size_t>(node)];
  if (station < 0) {
    station = add_station();
    for (int direction = 0; direction < 6; ++direction) couple(station, direction, 6 * node + direction, 1);
  }
  return station;
}

int Builder::add_point(int station, const Vector3& position, const Vector3& arm) {
  out_.station.push_back(station);
  out_.position.push_back(position);
  out_.arm.push_back(arm);
  return out_.points() - 1;
}

void Builder::add_cell(CellType type, std::initializer_list<int> points, const CellOwner& owner, double along) {
  out_.type.push_back(type);
  out_.connectivity.insert(out_.connectivity.end(), points);
  out_.offset.push_back(static_cast<int>(out_.connectivity.size()));
  out_.kind.push_back(owner.kind);
  out_.element.push_back(owner.element);
  out_.pair.push_back(owner.pair);
  out_.structure.push_back(owner.structure);
  out_.along.push_back(along);
}

// The station that moves with a point of contact, or with a cross-section of a beam.
int Builder::point_station(const ContactPoint& point) {
  const int station = add_station();
  for (const PointShare& share : point.shares) {
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) couple(station, i, 6 * share.node + j, share.of_node(i, j));
    }
  }
  return station;
}

// Of a member whose pose says where it is: only the rotation, between the DOFs of the nodes.
int Builder::finite_station(const ElementNodes& nodes, double along) {
  const int station = add_station();
  for (int i = 3; i < 6; ++i) {
    couple(station, i, 6 * nodes[0] + i, 1 - along);
    couple(station, i, 6 * nodes[1] + i, along);
  }
  return station;
}

void Builder::draw_member(const ElementGroup& group, int element, const CellOwner& owner) {
  const ElementNodes& nodes = group.nodes(element);
  const ElementShape shape = group.shape(element);
  if (!shape.beam) {
    const int first = add_point(node_station(nodes[0]), position_of(model_, nodes[0]), Vector3::Zero());
    const int last = add_point(node_station(nodes[1]), position_of(model_, nodes[1]), Vector3::Zero());
    add_cell(CellType::line, {first, last}, owner, 0.5);
    return;
  }
  std::vector<int> stations;
  for (int k = 0; k <= segments_; ++k) {
    const double along = double(k) / segments_;
    stations.push_back(shape.finite ? finite_station(nodes, along)
                                    : point_station(beam_point(nodes, shape, position_of(model_, nodes[0]), along)));
  }
  const SectionOutline outline = shape.outline ? tidy(*shape.outline) : SectionOutline{};
  const Vector3 start = position_of(model_, nodes[0]) + shape.offset[0];
  if (outline.empty()) {
    draw_curve(stations, start, shape, owner);
  } else {
    draw_sweep(stations, start, shape, outline, owner);
  }
}

void Builder::draw_curve(const std::vector<int>& stations, const Vector3& start, const ElementShape& shape,
                         const CellOwner& owner) {
  const Vector3 axis = shape.length * shape.axes.row(0).transpose();
  int last = -1;
  for (int k = 0; k <= segments_; ++k) {
    const int point =
        add_point(stations[static_cast<std::size_t>(k)], start + double(k) / segments_ * axis, Vector3::Zero());
    if (k > 0) add_cell(CellType::line, {last, point}, owner, (k - 0.5) / segments_);
    last = point;
  }
}

// A closed surface: one ring of points a station, quadrilaterals between the rings, triangles over the ends.
void Builder::draw_sweep(const std::vector<int>& stations, const Vector3& start, const ElementShape& shape,
                         const SectionOutline& outline, const CellOwner& owner) {
  const Vector3 axis = shape.length * shape.axes.row(0).transpose();
  const int corners = static_cast<int>(outline.size());
  const int first = out_.points();
  for (int k = 0; k <= segments_; ++k) {
    const Vector3 center = start + double(k) / segments_ * axis;
    for (const auto& corner : outline) {
      const Vector3 arm = shape.axes.transpose() * Vector3(0, corner.x(), corner.y());
      add_point(stations[static_cast<std::size_t>(k)], center + arm, arm);
    }
  }
  for (int k = 0; k < segments_; ++k) {
    for (int i = 0; i < corners; ++i) {
      const int a = first + k * corners + i, b = first + k * corners + (i + 1) % corners;
      add_cell(CellType::quad, {a, b, b + corners, a + corners}, owner, (k + 0.5) / segments_);
    }
  }
  const int last = first + segments_ * corners;
  for (const auto& [a, b, c] : triangulate(outline)) {
    add_cell(CellType::triangle, {first + a, first + c, first + b}, owner, 0);
    add_cell(CellType::triangle, {last + a, last + b, last + c}, owner, 1);
  }
}

void Builder::draw_elements() {
  int index = 0;
  for (std::size_t g = 0; g < model_.groups.size(); ++g) {
    const ElementGroup& group = *model_.groups[g];
    const std::string name(group.kind());
    auto found = std::find(out_.kind_names.begin(), out_.kind_names.end(), name);
    if (found == out_.kind_names.end()) found = out_.kind_names.insert(found, name);
    const int kind = static_cast<int>(found - out_.kind_names.begin());
    for (int e = 0; e < group.size(); ++e, ++index) {
      out_.element_ids.push_back(group.id(e));
      if (!is_drawn(group, e)) continue;
      const int first_cell = out_.cells(), first_point = out_.points();
      draw_member(group, e, {kind, index, -1, structure_of(model_, group.nodes(e)[0])});
      out_.drawn.push_back({g, e, first_cell, out_.cells()});
      const ElementShape shape = group.shape(e);
      if (shape.beam && shape.finite) out_.finite.push_back({g, e, first_point, out_.points(), segments_});
    }
  }
}

// Newell's normal of a polygon in space, unit length; zero for a degenerate one.
Vector3 polygon_normal(const std::vector<Vector3>& corners) {
  Vector3 normal = Vector3::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i) normal += corners[i].cross(corners[(i + 1) % corners.size()]);
  const double size = normal.norm();
  return size > 0 ? Vector3(normal / size) : Vector3::Zero();
}

// A plate of the slab's thickness about the plane of its corner nodes; each edge over the thickness turns with its
// node.
void Builder::draw_slab(const Slab& slab) {
  std::vector<Vector3> corners;
  for (const int node : slab.corners)
    corners.push_back(position_of(model_, node) - position_of(model_, slab.corners[0]));
  const Vector3 normal = polygon_normal(corners);
  if (corners.size() < 3 || normal.isZero()) return;
  const CellOwner owner{kind_slab, -1, -1, slab.structure};
  const Vector3 half = 0.5 * slab.thickness * normal;
  const int n = static_cast<int>(corners.size()), bottom = out_.points(), top = bottom + n;
  for (const double side : {-1.0, 1.0}) {
    for (const int node : slab.corners) {
      add_point(node_station(node), position_of(model_, node) + side * half, side * half);
    }
  }
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    add_cell(CellType::quad, {bottom + i, bottom + next, top + next, top + i}, owner, 0);
  }
  const Vector3 first_axis = normal.unitOrthogonal(), second_axis = normal.cross(first_axis);
  std::vector<Vector2> plan;
  for (const auto& corner : corners) plan.emplace_back(corner.dot(first_axis), corner.dot(second_axis));
  for (const auto& [a, b, c] : triangulate(plan)) {
    add_cell(CellType::triangle, {bottom + a, bottom + c, bottom + b}, owner, 0);
    add_cell(CellType::triangle, {top + a, top + b, top + c}, owner, 0);
  }
}

// A wall does not move: its side of the pair stays at the initial gap in front of the point.
void Builder::draw_contact(int pair) {
  const ContactPair& contact = model_.contacts.pairs[static_cast<std::size_t>(pair)];
  const Vector3& from = contact.a.position;
  const Vector3 to = contact.b.fixed() ? Vector3(from + model_.contacts.initial_gap[pair] * contact.normal) : contact.b.position;
  const int first = add_point(point_station(contact.a), from, Vector3::Zero());
  const int last = add_point(point_station(contact.b), to, Vector3::Zero());
  add_cell(CellType::line, {first, last}, {kind_contact, -1, pair, structure_of(model_, contact.a.first_node())}, 0);
}

FrameGeometry Builder::build() {
  station_of_node_.assign(static_cast<std::size_t>(model_.nodes.size()), -1);
  out_.kind_names = {"contact", "slab"};
  draw_elements();
  for (const auto& slab : model_.slabs) draw_slab(slab);
  for (int pair = 0; pair < model_.contacts.size(); ++pair) draw_contact(pair);
  out_.station_motion.resize(6 * stations_, model_.dofs.full);
  out_.station_motion.setFromTriplets(motion_.begin(), motion_.end());
  return std::move(out_);
}

}  // namespace

FrameGeometry frame_geometry(const Model& model, int segments) { return Builder(model, segments).build(); }

}  // namespace nsframe
