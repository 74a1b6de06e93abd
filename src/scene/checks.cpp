#include "scene/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/describe.hpp"
#include "scene/reader.hpp"

namespace nsframe {

void check(TableReader& table, const MassTable& mass) {
  if (mass.mass.size() != 1 && mass.mass.size() != 3)
    table.error("mass", fmt::format("mass has {} values, must have 1 or 3", mass.mass.size()));
  if (!mass.inertia.empty() && mass.inertia.size() != 3)
    table.error("inertia", fmt::format("inertia has {} values, must have 3", mass.inertia.size()));
}

namespace {

void check_two_nodes(TableReader& table, const std::vector<Reference>& nodes) {
  if (nodes.size() != 2) table.error("nodes", fmt::format("nodes has {} values, must have 2", nodes.size()));
}

}  // namespace

void check(TableReader& table, const BeamTable& beam) {
  check_two_nodes(table, beam.nodes);
  if (beam.section.name.empty() && beam.sections.empty()) table.error("section", "missing key 'section'");
  if (!beam.section.name.empty() && !beam.sections.empty()) table.error("sections", "a beam has either section or sections");
}

void check(TableReader& table, const WallTable& wall) {
  if (wall.nodes.size() < 2) return table.error("nodes", "a wall has two nodes on its axis, or more");
  if (std::abs(wall.direction.vector.z()) > 1e-9) table.error("direction", "the direction of a wall's length is horizontal");
  const auto check_list = [&](const char* key, std::size_t size) {
    if (const std::size_t stories = wall.nodes.size() - 1; size > 1 && size != stories)
      table.error(key, fmt::format("{} has {} values, must have one, or one a story ({})", key, size, stories));
  };
  check_list("thickness", wall.thickness.size());
  check_list("section", wall.section.size());
  if (wall.section.empty() && (wall.thickness.empty() || !wall.E)) table.error("section", "a wall needs thickness and E, or section");
  if (wall.section.empty()) {
    if (wall.element && *wall.element != BeamKind::elastic)
      table.error("element", "a wall by thickness and E is elastic; give the section of another one");
    for (const char* key : {"points", "integration", "inner_iterations"})
      if (table.has(key)) table.error(key, fmt::format("a wall by thickness and E is elastic and has no {}", key));
    return;
  }
  for (const char* key : {"thickness", "E", "poisson"})
    if (table.has(key)) table.error(key, fmt::format("a wall has either {} or section", key));
}

void check(TableReader& table, const Integration& integration) {
  const std::vector<std::string> rules = integration_rules();
  if (std::find(rules.begin(), rules.end(), integration.rule) == rules.end())
    table.error("rule", fmt::format("there is no integration rule '{}'{}", integration.rule, did_you_mean(integration.rule, rules)));
}

void check(TableReader& table, const MemberMass& mass) {
  if (mass.per_length > 0 && mass.density > 0) table.error("density", "a mass has either per_length or density");
  if (!mass.any() && (mass.consistent || mass.rotary_inertia)) table.error("per_length", "a mass needs per_length or density");
}

void check(TableReader& table, const EndReleases& releases) {
  for (const auto& [key, end] : {std::pair{"i", releases.i}, {"j", releases.j}})
    if (end.dofs[1] || end.dofs[2]) table.error(key, "an end of a beam can release ux, rx, ry and rz, not a shear force");
}

void check(TableReader& table, const LoadTable& load) {
  if (!load.uniform && !load.force) table.error("uniform", "a load needs uniform or force");
  if (load.position && !load.force) table.error("position", "a position is that of a force, and there is none");
}

void check(TableReader& table, const BarTable& bar) { check_two_nodes(table, bar.nodes); }

void check(TableReader& table, const LinkTable& link) {
  check_two_nodes(table, link.nodes);
  if (!link.p_delta) return;
  const auto& [y_i, y_j, z_i, z_j] = *link.p_delta;
  if (y_i + y_j > 1 + 1e-12 || z_i + z_j > 1 + 1e-12)
    table.error("p_delta", "the ends take at most the whole moment: parts of one axis add up to 1 or less");
}

void check(TableReader& table, const InfillTable& infill) {
  check_two_nodes(table, infill.nodes);
  if (infill.fm && infill.ultimate_strain && !(*infill.ultimate_strain > 2 * *infill.fm / infill.E))
    table.error("ultimate_strain", "ultimate_strain must lie beyond that of the strength, 2 fm/E");
  if (!infill.fm && infill.ultimate_strain) table.error("ultimate_strain", "ultimate_strain belongs to a strength fm");
}

void check(TableReader& table, const SpringTable& spring) {
  if (spring.nodes.size() != 1 && spring.nodes.size() != 2)
    table.error("nodes", fmt::format("nodes has {} values, must have 1 (to the ground) or 2", spring.nodes.size()));
}

void check(TableReader& table, const SlabTable& slab) {
  if (slab.corners.size() < 3) table.error("corners", "a slab has at least 3 corners");
  if (slab.kind != SlabKind::links && !slab.center) table.error("kind", "a rigid slab or diaphragm needs a center");
}

namespace {

// L1, T2, R1, V1: a direction and the number of the mode in it.
bool is_mode_name(std::string_view name) {
  return name.size() >= 2 && name.size() <= 4 && std::string_view("LTRV").find(name[0]) != std::string_view::npos &&
         name[1] != '0' && std::all_of(name.begin() + 1, name.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

void check(TableReader& table, const DampingTable& damping) {
  for (const auto& [mode, ratio] : damping.ratios.named)
    if (!is_mode_name(mode.name))
      table.error(mode, fmt::format("'{}' is not the name of a mode: L, T, R or V and its number", mode.name));
  if (damping.kind != DampingKind::rayleigh && damping.stiffness != DampingStiffness::initial)
    table.error("stiffness", "stiffness belongs to rayleigh damping");
  const bool named = !damping.ratios.named.empty(), listed = !damping.ratios.list.empty();
  switch (damping.kind) {
    case DampingKind::none:
      for (const char* key : {"ratios", "frequencies", "mass_factor", "stiffness_factor"})
        if (table.has(key) && (named || listed || !damping.frequencies.empty() || damping.mass_factor != 0 ||
                               damping.stiffness_factor != 0))
          return table.error(key, fmt::format("{} is given, but no kind of damping", key));
      return;
    case DampingKind::modal:
      if (!named && !listed) table.error("ratios", "modal damping needs ratios");
      if (!damping.frequencies.empty()) table.error("frequencies", "frequencies belong to rayleigh damping");
      return;
    case DampingKind::rayleigh:
      if (named) return table.error("ratios", "the ratios of rayleigh damping are a list, not names of modes");
      if (damping.frequencies.empty() && listed) return table.error("ratios", "rayleigh ratios need two frequencies");
      if (damping.frequencies.empty()) return;
      if (damping.frequencies.size() != 2 || damping.frequencies[0] == damping.frequencies[1])
        return table.error("frequencies", "rayleigh damping needs two different frequencies");
      if (damping.ratios.list.empty() || damping.ratios.list.size() > 2)
        return table.error("ratios", "rayleigh damping by frequencies needs one ratio, or two");
      if (damping.mass_factor != 0 || damping.stiffness_factor != 0)
        table.error("frequencies", "rayleigh damping has either factors or frequencies");
  }
}

void check(TableReader& table, const ExplicitStructure& structure) {
  if (structure.walls.empty()) return;
  const StructureDescription without = describe_nodes(structure);
  for (const WallTable& wall : structure.walls)
    for (const auto& [what, message] : faults(describe(wall, structure), without)) table.error(what, message);
}

void check(TableReader& table, const CalibrationParameterTable& parameter) {
  if (parameter.sets.empty() == parameter.scales.empty()) table.error("sets", "a parameter has either sets or scales");
}

void check(TableReader& table, const CalibrationTargetTable& target) {
  if (!target.mode && target.shape.empty()) table.error("mode", "a target needs a mode or a shape");
  if (target.mode && !is_mode_name(target.mode->name))
    table.error(*target.mode, fmt::format("'{}' is not the name of a mode: L, T, R or V and its number", target.mode->name));
  const bool moves = std::any_of(target.shape.begin(), target.shape.end(), [](const auto& s) { return s.value != 0; });
  if (!target.shape.empty() && !moves) table.error("shape", "the shape is zero throughout");
}

void check(TableReader& table, const CalibrationTable& calibration) {
  if (calibration.parameters.empty()) table.error("parameters", "a calibration needs parameters");
  if (calibration.targets.empty()) table.error("targets", "a calibration needs targets");
}

void check(TableReader& table, const StoryFrameTable& frame) {
  for (const std::string& fault : faults(frame.frame)) table.error(fault.substr(0, fault.find_first_of(" .")), fault);
}

namespace {

void check_sides(TableReader& table, const ContactTable& contact, const ContactSides& pair) {
  const auto& [a, b] = pair;
  const ContactKind kind = contact_kind(contact, pair);
  if (a.name == "ground") return table.error("between", "the ground must be the last side of a contact");
  const bool ground = b.name == "ground";
  if (ground && kind != ContactKind::nodes && kind != ContactKind::wall)
    return table.error("kind", "contact with the ground is of kind \"nodes\" or \"wall\"");
  if (!ground && kind == ContactKind::wall)
    return table.error("between", fmt::format("a wall is between a structure and \"ground\", not '{}'", b.name));
  for (const Reference& side : {a, b}) {
    if (kind == ContactKind::nodes && side.name != "ground" && side.name.find('.') == std::string::npos)
      table.error(contact.a ? "a" : "between", fmt::format("'{}' is not a node, written as \"structure.node\"", side.name));
  }
}

}  // namespace

void check(TableReader& table, const ContactTable& contact) {
  if (!contact.between.empty() && (contact.a || contact.b))
    return table.error("between", "a contact has either between, or a and b");
  if (contact.a.has_value() != contact.b.has_value())
    return table.error(contact.a ? "a" : "b", "a contact needs a and b");
  if (!contact.a && contact.between.size() < 2)
    return table.error("between", "a contact needs two sides: between = [first, second], or more in a row");
  if (table.has("restitution") && contact.restitution.values.empty()) return table.error("restitution", "restitution has no value");
  for (const ContactLawFault& fault : faults(contact.law, contact.restitution.values)) table.error(fault.key, fault.message);
  bool fixed = false;
  for (const ContactSides& pair : sides(contact)) {
    check_sides(table, contact, pair);
    fixed = fixed || pair.second.name == "ground";
  }
  if (!fixed && contact.wall) table.error("wall", "a wall belongs to a contact with \"ground\"");
  if (fixed && !contact.wall && contact.gap.values.empty())
    table.error("between", "contact with the ground needs a gap, or a wall");
}

void check(TableReader& table, const MotionTable& motion) {
  if (motion.pga && motion.factor) table.error("factor", "a motion has either pga or factor");
  if (motion.quantity == MotionQuantity::acceleration) return;
  if (motion.pga) table.error("pga", "displacements have no pga; scale them by factor");
  if (motion.unit) table.error("unit", "units of displacements are in factor, e.g. factor = \"1 cm\"");
}

void check(TableReader& table, const FloorSpectraOptions& spectra) {
  if (spectra.nodes.empty()) table.error("nodes", "floor spectra need nodes; \"floors\" stands for all floors");
}

void check(TableReader& table, const StageTable& stage) {
  const bool load = stage.control.name == "load", arc = stage.control.name == "arc-length";
  if (stage.name.find('/') != std::string::npos || stage.name.starts_with('.'))
    table.error("name", "the name of a stage has no '/' and begins with no '.'");
  if (stage.loads.empty() && !stage.masses && !stage.mode) table.error("loads", "a stage needs loads, masses or a mode");
  if (stage.mode && (!stage.loads.empty() || stage.masses)) table.error("mode", "a stage has either a mode, or loads and masses");
  if (stage.mode && stage.mode->name.find('.') == std::string::npos)
    table.error("mode", fmt::format("'{}' is not a mode, written as \"structure.L1\"", stage.mode->name));
  const int targets = !stage.to.empty() + !stage.by.empty() + !stage.cycles.empty() + stage.file.has_value();
  if (targets > 1 || (targets == 0 && !load)) table.error("to", "a stage has one of to, by, cycles and file");
  if (load && !stage.by.empty()) table.error("by", "control by load goes `to` a load factor");
  if (!load && !stage.control_dof) table.error("control", "this control needs a node and a DOF: at = [\"structure.node\", \"ux\"]");
  for (const auto& [amplitude, count] : stage.cycles)
    if (!(count >= 1 && count <= 1e6) || count != std::floor(count))
      table.error("cycles", fmt::format("cycles are rows [amplitude, count] with a whole count, not {}", count));
  if (stage.factor && !stage.file) table.error("factor", "factor belongs to a file");
  if (stage.step && stage.steps) table.error("steps", "a stage has either step or steps");
  if (!arc && stage.arc) table.error("arc", "arc belongs to control = \"arc-length\"");
  if (!arc && stage.max_points) table.error("max_points", "max_points belongs to control = \"arc-length\"");
}

void check(TableReader& table, const OutputOptions& output) {
  static const std::vector<std::string> known(history_names.begin(), history_names.end());
  for (const std::string& name : output.history)
    if (std::find(known.begin(), known.end(), name) == known.end())
      table.error("history", fmt::format("there is no history '{}'{}", name, did_you_mean(name, known)));
  if (!output.fibers.empty() && std::find(output.history.begin(), output.history.end(), "fibers") == output.history.end())
    table.error("fibers", "to keep fibers, history needs \"fibers\"");
}

}  // namespace nsframe
