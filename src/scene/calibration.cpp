#include "scene/calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>

#include "base/errors.hpp"
#include "scene/describe.hpp"
#include "scene/scene_keys.hpp"

namespace nsframe {

namespace {

// What every key of a parameter has in common.
struct KeyRule {
  Dimension dimension;
  std::vector<Range> ranges;
  std::vector<double> values;  // in the scene
};

class ParameterReader {
 public:
  ParameterReader(const Scene& scene, Diagnostics& diagnostics) : tables_(scene.tables), diagnostics_(diagnostics) {}

  std::optional<SceneParameter> read(const CalibrationParameterTable& table) {
    SceneParameter out;
    out.name = table.name.name;
    if (const auto [first, is_new] = names_.try_emplace(out.name, table.name.at); !is_new)
      diagnostics_.error(table.name.at, fmt::format("there are two parameters '{}'", out.name));
    out.scales = !table.scales.empty();
    const std::size_t errors = diagnostics_.messages().size();
    const KeyRule rule = keys(out.scales ? table.scales : table.sets, out);
    if (diagnostics_.messages().size() > errors) return std::nullopt;
    const Dimension dimension = out.scales ? dimension::none : rule.dimension;
    out.unit = si_unit(dimension);
    const auto low = value(table.bounds[0], "bounds", dimension), high = value(table.bounds[1], "bounds", dimension);
    std::optional<double> start;
    if (table.start) {
      start = value(*table.start, "start", dimension);
    } else if (out.scales) {
      start = 1;
    } else if (std::any_of(rule.values.begin(), rule.values.end(), [&](double v) { return v != rule.values.front(); })) {
      diagnostics_.error(table.at, fmt::format("the keys of '{}' have several values in the scene: give its start", out.name));
    } else {
      start = rule.values.front();
    }
    if (!low || !high || !start) return std::nullopt;
    out.lower = *low;
    out.upper = *high;
    out.start = *start;
    check_interval(table, rule, out);
    return out;
  }

 private:
  KeyRule keys(const std::vector<Reference>& names, SceneParameter& out) {
    KeyRule rule;
    for (const Reference& key : names) {
      try {
        const SceneNumbers numbers = find_numbers(tables_, key.name);
        if (!out.keys.empty() && !(numbers.dimension == rule.dimension))
          diagnostics_.error(key.at, fmt::format("'{}' is {}, the parameter's other keys are {}", key.name,
                                                 dimension_name(numbers.dimension), dimension_name(rule.dimension)));
        rule.dimension = numbers.dimension;
        for (double* number : numbers.values) {
          rule.ranges.push_back(numbers.range);
          rule.values.push_back(*number);
          if (const auto [other, is_new] = owner_.try_emplace(number, out.name); !is_new)
            diagnostics_.error(key.at, fmt::format("'{}' is set by parameter '{}' already", key.name, other->second));
          if (out.scales && *number == 0)
            diagnostics_.error(key.at, fmt::format("'{}' is 0 in the scene: a factor does nothing", key.name));
        }
        out.keys.push_back(key.name);
      } catch (const SceneKeyError& fault) {
        diagnostics_.error(key.at, fmt::format("{}: {}", key.name, fault.what()));
      }
    }
    return rule;
  }

  std::optional<double> value(const KeyQuantity& quantity, const char* key, const Dimension& dimension) {
    if (quantity.text.empty()) return quantity.number;
    try {
      return parse_quantity(quantity.text, dimension);
    } catch (const QuantityError& fault) {
      diagnostics_.error(quantity.at, fmt::format("{} = \"{}\"{}", key, quantity.text, fault.what()));
      return std::nullopt;
    }
  }

  void check_interval(const CalibrationParameterTable& table, const KeyRule& rule, const SceneParameter& p) {
    if (!(p.lower > 0 && p.lower < p.upper)) {
      diagnostics_.error(table.bounds[0].at,
                         fmt::format("bounds of '{}' are [{:g}, {:g}], must be positive and rise", p.name, p.lower, p.upper));
      return;
    }
    for (std::size_t i = 0; i < rule.ranges.size(); ++i) {
      const double factor = p.scales ? rule.values[i] : 1;
      for (const KeyQuantity* bound : {&table.bounds[0], &table.bounds[1]}) {
        const double reached = factor * (bound == &table.bounds[0] ? p.lower : p.upper);
        if (!rule.ranges[i].contains(reached))
          diagnostics_.error(bound->at,
                             fmt::format("at this bound of '{}' {} = {:g}, {}", p.name, p.keys.front(), reached, rule.ranges[i].rule()));
      }
    }
    if (p.start < p.lower || p.start > p.upper)
      diagnostics_.error(table.start ? table.start->at : table.bounds[0].at,
                         fmt::format("'{}' starts at {:g}{}, outside its bounds [{:g}, {:g}]", p.name, p.start,
                                     table.start ? "" : ", the scene's value", p.lower, p.upper));
  }

  SceneTables tables_;  // a copy: keys point into it
  Diagnostics& diagnostics_;
  std::map<std::string, Location> names_;
  std::map<const double*, std::string> owner_;
};

void check_targets(const Scene& scene, Diagnostics& diagnostics) {
  std::map<std::pair<std::string, std::string>, bool> seen;
  for (const CalibrationTargetTable& target : scene.tables.calibration->targets) {
    std::vector<std::string> names;
    for (const StructureDescription& structure : scene.model.structures) names.push_back(structure.name);
    const auto found = std::find(names.begin(), names.end(), target.structure.name);
    if (found == names.end()) {
      diagnostics.error(target.structure.at,
                        fmt::format("there is no structure '{}'{}", target.structure.name, did_you_mean(target.structure.name, names)));
      continue;
    }
    if (target.mode && !seen.try_emplace({target.structure.name, target.mode->name}, true).second)
      diagnostics.error(target.mode->at, fmt::format("mode {} of '{}' is measured twice", target.mode->name, target.structure.name));
    std::vector<std::string> nodes;
    for (const NodeDescription& node : scene.model.structures[static_cast<std::size_t>(found - names.begin())].nodes)
      nodes.push_back(node.id);
    for (const CalibrationShapeTable& ordinate : target.shape)
      if (std::find(nodes.begin(), nodes.end(), ordinate.node.name) == nodes.end())
        diagnostics.error(ordinate.node.at, fmt::format("structure '{}' has no node '{}'{}", target.structure.name, ordinate.node.name,
                                                        did_you_mean(ordinate.node.name, nodes)));
  }
}

// The rules across keys that hold when a scene is read, for changed numbers.
void require_possible(const SceneTables& tables) {
  for (const MaterialTable& material : tables.materials) {
    try {
      check_parameters(material.law);
    } catch (const std::invalid_argument& fault) {
      throw InputError(fmt::format("error: material '{}' with fitted values: {}", material.name, fault.what()));
    }
  }
  for (const SectionTable& section : tables.sections) {
    const SectionFaults found = std::visit([](const auto& kind) { return faults(kind); }, section.kind);
    if (!found.empty()) throw InputError(fmt::format("error: section '{}' with fitted values: {}", section.name, found.front().message));
  }
  for (const StructureTable& structure : tables.structures) {
    const auto* frame = std::get_if<StoryFrameTable>(&structure);
    if (!frame) continue;
    const std::vector<std::string> found = faults(frame->frame);
    if (!found.empty()) throw InputError(fmt::format("error: structure '{}' with fitted values: {}", frame->frame.name, found.front()));
  }
}

}  // namespace

std::vector<SceneParameter> calibration_parameters(const Scene& scene, Diagnostics& diagnostics) {
  std::vector<SceneParameter> out;
  if (!scene.tables.calibration) return out;
  ParameterReader reader(scene, diagnostics);
  for (const CalibrationParameterTable& table : scene.tables.calibration->parameters)
    if (auto parameter = reader.read(table)) out.push_back(std::move(*parameter));
  return out;
}

void check_calibration(const Scene& scene, Diagnostics& diagnostics) {
  if (!scene.tables.calibration) return;
  calibration_parameters(scene, diagnostics);
  check_targets(scene, diagnostics);
}

void set_parameters(const std::vector<SceneParameter>& parameters, const VectorX& values, SceneTables& tables) {
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const double value = values[static_cast<Eigen::Index>(i)];
    for (const std::string& key : parameters[i].keys)
      for (double* number : find_numbers(tables, key).values) *number = parameters[i].scales ? *number * value : value;
  }
}

ParametricModel::ParametricModel(const Scene& scene, std::vector<SceneParameter> parameters)
    : scene_(scene), parameters_(std::move(parameters)) {
  scene_.tables.motions.clear();
  scene_.tables.contacts.clear();
  scene_.tables.stages.clear();
}

ModelDescription ParametricModel::operator()(const VectorX& values) const {
  Scene scene = scene_;
  set_parameters(parameters_, values, scene.tables);
  require_possible(scene.tables);
  Diagnostics diagnostics;
  describe_model(scene, diagnostics);
  diagnostics.throw_if_any();
  scene.model.screening = scene.analysis.screening;
  return std::move(scene.model);
}

}  // namespace nsframe
