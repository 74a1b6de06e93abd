#include "models/story_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "base/errors.hpp"

namespace nsframe {

namespace {

template <class T>
const T& at_story(const std::vector<T>& values, int story) {
  return values.size() == 1 ? values.front() : values[static_cast<std::size_t>(story - 1)];
}

constexpr double same_level = 1e-3;  // [m]

// One column line, or the centre of a floor.
struct PlanPoint {
  int number = 0;             // i of the node id
  double x = 0, y = 0;        // [m] from the origin
  double tributary_area = 0;  // [m2]; 0 at a centre without column
  bool column = true;
};

// Lines of the grid along one axis, and the width of plan that each carries.
struct GridLines {
  std::vector<double> position, width;  // [m]
  int count() const { return static_cast<int>(position.size()); }
  double length() const { return position.back(); }
};

GridLines grid_lines(const std::vector<double>& plan, int bays) {
  std::vector<double> spans = plan;
  if (plan.size() == 1) spans.assign(static_cast<std::size_t>(bays), plan.front() / bays);
  GridLines lines{{0.0}, {}};
  for (const double span : spans) lines.position.push_back(lines.position.back() + span);
  if (plan.size() == 1) lines.position.back() = plan.front();
  for (std::size_t i = 0; i < lines.position.size(); ++i) {
    const double before = i > 0 ? spans[i - 1] : 0, after = i < spans.size() ? spans[i] : 0;
    lines.width.push_back((before + after) / 2);
  }
  return lines;
}

class Expansion {
 public:
  explicit Expansion(const StoryFrame& frame) : frame_(frame) {
    out_.name = frame.name;
    out_.at = frame.at;
    out_.damping = frame.damping;
    x_ = grid_lines(frame.plan[0], frame.bays[0]);
    y_ = grid_lines(frame.plan[1], frame.bays[1]);
    lay_out_plan();
    while (stride_ <= static_cast<int>(points_.size())) stride_ *= 10;
  }

  StructureDescription run() {
    add_nodes();
    add_base();
    for (int story = 1; story <= frame_.stories; ++story) {
      add_columns(story);
      add_beams(story);
      add_slab(story);
      add_braces(story);
      add_masses(story);
    }
    std::stable_sort(out_.elements.begin(), out_.elements.end(), [](const auto& a, const auto& b) {
      return (a.kind == ElementKind::truss) + 2 * (a.kind == ElementKind::cable) <
             (b.kind == ElementKind::truss) + 2 * (b.kind == ElementKind::cable);
    });
    return std::move(out_);
  }

 private:
  static constexpr int centre_number = 5;

  void lay_out_plan() {
    const int nx = x_.count(), ny = y_.count();
    grid_.assign(static_cast<std::size_t>(nx * ny), 0);
    const double cx = x_.length() / 2, cy = y_.length() / 2;
    const double tolerance = 1e-9 * (cx + cy);
    int next = centre_number + 1;
    bool centre_has_column = false;
    for (int iy = 0; iy < ny; ++iy) {
      for (int ix = 0; ix < nx; ++ix) {
        PlanPoint point{0, x_.position[std::size_t(ix)], y_.position[std::size_t(iy)],
                        x_.width[std::size_t(ix)] * y_.width[std::size_t(iy)], true};
        const bool low_x = ix == 0, high_x = ix == nx - 1, low_y = iy == 0, high_y = iy == ny - 1;
        if ((low_x || high_x) && (low_y || high_y)) {
          point.number = low_y ? (low_x ? 1 : 2) : (low_x ? 4 : 3);
        } else if (std::abs(point.x - cx) + std::abs(point.y - cy) < tolerance) {
          point.number = centre_number;
          centre_has_column = true;
        } else {
          point.number = next++;
        }
        grid_[std::size_t(iy * nx + ix)] = point.number;
        points_.push_back(point);
      }
    }
    if (!centre_has_column) points_.push_back({centre_number, cx, cy, 0, false});
    std::sort(points_.begin(), points_.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
  }

  int grid(int ix, int iy) const { return grid_[std::size_t(iy * x_.count() + ix)]; }

  Reference node(int floor, int number) const { return {std::to_string(floor * stride_ + number), frame_.at}; }

  void add_nodes() {
    double elevation = 0;
    for (int floor = 0; floor <= frame_.stories; ++floor) {
      if (floor > 0) elevation += at_story(frame_.height, floor);
      for (const PlanPoint& point : points_) {
        if (floor == 0 && !point.column) continue;
        const Vector3 position = frame_.origin + Vector3(point.x, point.y, elevation);
        out_.nodes.push_back({node(floor, point.number).name, frame_.at, position});
        position_.emplace(out_.nodes.back().id, position);
      }
    }
  }

  void add_base() {
    const bool clamped = frame_.base.kind == BaseKind::fixed, spring = frame_.base.kind == BaseKind::spring;
    for (const PlanPoint& point : points_) {
      if (!point.column) continue;
      const Reference foot = node(0, point.number);
      out_.supports.push_back({foot, {true, true, true, clamped, clamped, clamped || spring}});
      if (!spring) continue;
      SpringDescription rotation;
      rotation.id = "base-" + foot.name;
      rotation.at = frame_.at;
      rotation.node_i = foot;
      rotation.stiffness[3] = rotation.stiffness[4] = frame_.base.stiffness;
      out_.springs.push_back(rotation);
    }
  }

  ElementDescription& add_element(ElementKind kind, Reference i, Reference j) {
    ElementDescription element;
    element.id = std::to_string(++last_element_);
    element.at = frame_.at;
    element.kind = kind;
    element.node_i = std::move(i);
    element.node_j = std::move(j);
    return out_.elements.emplace_back(std::move(element));
  }

  ElementDescription& add_member(const FrameMembers& members, int story, Reference i, Reference j) {
    ElementDescription& element = add_element(element_kind(members.element), std::move(i), std::move(j));
    element.section = at_story(members.section, story);
    if (!members.end_section.empty()) {
      const Reference& end = at_story(members.end_section, story);
      element.sections = {end, element.section, end};
    }
    element.points = members.points;
    element.integration = members.integration;
    element.inner_iterations = members.inner_iterations;
    element.mass = members.mass;
    element.geometry = members.geometry;
    if (members.releases) element.releases = basic_releases(*members.releases);
    const Vector3 along = (position_.at(element.node_j.name) - position_.at(element.node_i.name)).normalized();
    element.offset[0] += members.rigid_ends[0] * along;
    element.offset[1] -= members.rigid_ends[1] * along;
    return element;
  }

  void add_columns(int story) {
    for (const PlanPoint& point : points_) {
      if (!point.column) continue;
      std::vector<Reference> nodes{node(story - 1, point.number)};
      for (Reference& within : split_column(story, point)) nodes.push_back(std::move(within));
      nodes.push_back(node(story, point.number));
      for (std::size_t i = 0; i + 1 < nodes.size(); ++i) add_column_part(story, nodes[i], nodes[i + 1], i == 0, i + 2 == nodes.size());
    }
  }

  // The nodes within the column of a story, from the lowest.
  std::vector<Reference> split_column(int story, const PlanPoint& point) {
    const std::string below = node(story - 1, point.number).name;
    const double bottom = position_.at(below).z(), top = position_.at(node(story, point.number).name).z();
    std::vector<double> levels;
    for (const double level : frame_.columns.split) {
      const double z = frame_.origin.z() + level;
      if (z > bottom + same_level && z < top - same_level) levels.push_back(z);
    }
    std::sort(levels.begin(), levels.end());
    std::vector<Reference> nodes;
    for (std::size_t i = 0; i < levels.size(); ++i) {
      const Vector3 position(frame_.origin.x() + point.x, frame_.origin.y() + point.y, levels[i]);
      nodes.push_back({below + static_cast<char>('a' + i), frame_.at});
      out_.nodes.push_back({nodes.back().name, frame_.at, position});
      position_.emplace(nodes.back().name, position);
    }
    return nodes;
  }

  // Between two nodes of a column; rigid zones, releases and end sections belong to the column's own ends.
  void add_column_part(int story, const Reference& i, const Reference& j, bool lowest, bool highest) {
    FrameMembers part = frame_.columns;
    if (!lowest) part.rigid_ends[0] = 0;
    if (!highest) part.rigid_ends[1] = 0;
    if (part.releases && !lowest) part.releases->i = {};
    if (part.releases && !highest) part.releases->j = {};
    ElementDescription& column = add_member(part, story, i, j);
    if (!column.sections.empty() && !lowest) column.sections.front() = column.section;
    if (!column.sections.empty() && !highest) column.sections.back() = column.section;
    // The default has local y along global X; with the local z against X, local y is along Y.
    if (frame_.columns.depth == PlanAxis::y) column.orientation = Vector3(-1, 0, 0);
  }

  // Lines along x by rising y, then lines along y by falling x: around the plan when there is one bay.
  void add_beams(int story) {
    if (!frame_.beams) return;
    for (int iy = 0; iy < y_.count(); ++iy)
      for (int ix = 0; ix + 1 < x_.count(); ++ix)
        add_beam(story, node(story, grid(ix, iy)), node(story, grid(ix + 1, iy)));
    for (int ix = x_.count() - 1; ix >= 0; --ix)
      for (int iy = 0; iy + 1 < y_.count(); ++iy)
        add_beam(story, node(story, grid(ix, iy)), node(story, grid(ix, iy + 1)));
  }

  void add_beam(int story, Reference i, Reference j) {
    const ElementDescription& beam = add_member(*frame_.beams, story, std::move(i), std::move(j));
    if (frame_.beams->load.empty() || at_story(frame_.beams->load, story) == 0) return;
    LoadDescription load;
    load.at = frame_.at;
    load.elements = {{beam.id, frame_.at}};
    load.uniform = Vector3(0, 0, -at_story(frame_.beams->load, story));
    out_.loads.push_back(std::move(load));
  }

  void add_slab(int story) {
    const Reference centre = node(story, centre_number);
    SlabDescription slab;
    slab.id = "slab-" + std::to_string(story);
    slab.at = frame_.at;
    for (int corner = 1; corner <= 4; ++corner) slab.corners.push_back(node(story, corner));
    slab.center = centre;
    slab.thickness = frame_.slab.thickness;
    slab.rigid = frame_.slab.kind != SlabKind::links;
    out_.slabs.push_back(slab);

    std::vector<Reference> around;
    for (const PlanPoint& point : points_)
      if (point.number != centre_number) around.push_back(node(story, point.number));
    if (frame_.slab.kind == SlabKind::links) {
      for (const Reference& corner : around)
        add_element(ElementKind::elastic_beam, centre, corner).section = frame_.slab.section;
      return;
    }
    const ConstraintKind kind =
        frame_.slab.kind == SlabKind::rigid ? ConstraintKind::rigid_body : ConstraintKind::diaphragm;
    out_.constraints.push_back({frame_.at, kind, centre, around});
  }

  void add_braces(int story) {
    if (!frame_.braces) return;
    const FrameBraces& braces = *frame_.braces;
    const auto cross = [&](int i, int j) {
      for (const auto& [low, high] : {std::pair{i, j}, std::pair{j, i}}) {
        ElementDescription& brace = add_element(element_kind(braces.kind), node(story - 1, low), node(story, high));
        brace.material = braces.material;
        brace.area = at_story(braces.area, story);
        brace.pretension = braces.pretension;
      }
    };
    for (const BracePlane plane : braces.planes) {
      const bool along_y = plane == BracePlane::x_low || plane == BracePlane::x_high;
      const int ix = plane == BracePlane::x_high ? x_.count() - 1 : 0,
                iy = plane == BracePlane::y_high ? y_.count() - 1 : 0;
      if (along_y)
        for (int bay = 0; bay + 1 < y_.count(); ++bay) cross(grid(ix, bay), grid(ix, bay + 1));
      else
        for (int bay = 0; bay + 1 < x_.count(); ++bay) cross(grid(bay, iy), grid(bay + 1, iy));
    }
  }

  void add_masses(int story) {
    if (frame_.mass.floor.empty() && frame_.mass.centre_inertia.empty()) return;
    const double total = frame_.mass.floor.empty() ? 0 : at_story(frame_.mass.floor, story);
    const double area = x_.length() * y_.length(), centre = frame_.mass.centre_share;
    for (const PlanPoint& point : points_) {
      MassDescription mass;
      mass.node = node(story, point.number);
      const double horizontal = point.number == centre_number  ? total * centre
                                : point.number < centre_number ? total * (1 - centre) / 4
                                                               : 0;
      mass.mass = Vector3(horizontal, horizontal, total * point.tributary_area / area);
      if (point.number == centre_number && !frame_.mass.centre_inertia.empty())
        mass.inertia.z() = at_story(frame_.mass.centre_inertia, story);
      out_.masses.push_back(mass);
    }
  }

  const StoryFrame& frame_;
  StructureDescription out_;
  std::map<std::string, Vector3> position_;  // of the nodes
  GridLines x_, y_;
  std::vector<PlanPoint> points_;  // by rising number
  std::vector<int> grid_;          // number of the column line (ix, iy) at iy * x_.count() + ix
  int stride_ = 10;
  int last_element_ = 0;
};

void check_list(std::vector<std::string>& faults, std::string_view what, std::size_t size, int stories) {
  if (size > 1 && size != static_cast<std::size_t>(stories))
    faults.push_back(
        fmt::format("{} has {} values, must have one, or one for each of the {} stories", what, size, stories));
}

// Levels within the height, apart from each other, not at a floor.
void check_split(std::vector<std::string>& faults, const StoryFrame& frame) {
  const std::vector<double>& split = frame.columns.split;
  if (split.empty() || frame.height.empty()) return;
  if (frame.columns.integration.rule.starts_with("hinge"))
    faults.push_back("columns.split would put plastic hinges within the columns; use another integration");
  if (split.size() > 26) faults.push_back("columns.split has more than 26 levels");
  double floor = 0;
  std::vector<double> taken{0};
  for (int story = 1; story <= frame.stories && (frame.height.size() == 1 || story <= int(frame.height.size())); ++story)
    taken.push_back(floor += at_story(frame.height, story));
  for (const double level : split) {
    if (!(level > 0 && level < floor)) faults.push_back(fmt::format("columns.split = {} m lies outside the frame of {} m", level, floor));
    const auto& rigid = frame.columns.rigid_ends;
    const auto near = [&](double other) { return level - other <= rigid[0] + same_level && other - level <= rigid[1] + same_level; };
    if (std::any_of(taken.begin(), taken.end(), near))
      faults.push_back(fmt::format("columns.split = {} m is at a floor or within a rigid end, or given twice", level));
    taken.push_back(level);
  }
}

double shortest_span(const StoryFrame& frame, std::size_t axis) {
  const std::vector<double>& plan = frame.plan[axis];
  return plan.size() == 1 ? plan.front() / frame.bays[axis] : *std::min_element(plan.begin(), plan.end());
}

constexpr double max_nodes = 1e6;  // a slip of the pen must not fill the memory

double node_count(const StoryFrame& frame) {
  double count = frame.stories + 1;
  for (std::size_t axis = 0; axis < 2; ++axis)
    count *= 1 + std::max(frame.bays[axis], static_cast<int>(frame.plan[axis].size()));
  return count;
}

}  // namespace

ElementKind element_kind(BeamKind kind) {
  switch (kind) {
    case BeamKind::displacement:
      return ElementKind::displacement_beam;
    case BeamKind::force_based:
      return ElementKind::force_beam;
    default:
      return ElementKind::elastic_beam;
  }
}

Releases basic_releases(const EndReleases& ends) {
  Releases out;
  const auto &i = ends.i.dofs, &j = ends.j.dofs;
  out.basic = {i[0] || j[0], i[5], j[5], i[4], j[4], i[3] || j[3]};
  return out;
}

ElementKind element_kind(BarKind kind) { return kind == BarKind::cable ? ElementKind::cable : ElementKind::truss; }

std::vector<std::string> faults(const StoryFrame& frame) {
  std::vector<std::string> out;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const char name = axis == 0 ? 'x' : 'y';
    if (frame.plan[axis].empty()) out.push_back(fmt::format("plan has no length along {}", name));
    if (frame.plan[axis].size() > 1 && frame.bays[axis] != 1 && frame.bays[axis] != int(frame.plan[axis].size()))
      out.push_back(
          fmt::format("plan has {} spans along {}, bays says {}", frame.plan[axis].size(), name, frame.bays[axis]));
  }
  if (out.empty() && node_count(frame) > max_nodes)
    out.push_back(fmt::format("stories and bays make {} nodes, at most {} are allowed", node_count(frame), max_nodes));
  if (frame.height.empty()) out.push_back("height is missing");
  check_list(out, "height", frame.height.size(), frame.stories);
  check_list(out, "columns.section", frame.columns.section.size(), frame.stories);
  check_list(out, "columns.end_section", frame.columns.end_section.size(), frame.stories);
  if (frame.beams) check_list(out, "beams.section", frame.beams->section.size(), frame.stories);
  if (frame.beams) check_list(out, "beams.end_section", frame.beams->end_section.size(), frame.stories);
  if (frame.beams) check_list(out, "beams.load", frame.beams->load.size(), frame.stories);
  if (frame.braces) check_list(out, "braces.area", frame.braces->area.size(), frame.stories);
  check_list(out, "floor_mass", frame.mass.floor.size(), frame.stories);
  check_list(out, "centre_inertia", frame.mass.centre_inertia.size(), frame.stories);
  if (frame.columns.section.empty()) out.push_back("columns have no section");
  check_split(out, frame);
  const auto check_ends = [&out](std::string_view key, const FrameMembers& members, double shortest) {
    if (members.rigid_ends[0] + members.rigid_ends[1] >= shortest)
      out.push_back(fmt::format("{}.rigid_ends leave nothing of a member of {} m", key, shortest));
  };
  if (!frame.height.empty()) check_ends("columns", frame.columns, *std::min_element(frame.height.begin(), frame.height.end()));
  if (frame.beams && !frame.plan[0].empty() && !frame.plan[1].empty())
    check_ends("beams", *frame.beams, std::min(shortest_span(frame, 0), shortest_span(frame, 1)));
  if (frame.beams && frame.beams->section.empty()) out.push_back("beams have no section");
  if (frame.braces && frame.braces->area.empty()) out.push_back("braces have no area");
  if (frame.slab.kind == SlabKind::links && frame.slab.section.name.empty())
    out.push_back("slab of links needs a section");
  if (frame.base.kind == BaseKind::spring && frame.base.stiffness <= 0) out.push_back("base springs need a stiffness");
  return out;
}

StructureDescription expand(const StoryFrame& frame) {
  if (const auto found = faults(frame); !found.empty()) throw InputError(frame.name + ": " + found.front());
  return Expansion(frame).run();
}

}  // namespace nsframe
