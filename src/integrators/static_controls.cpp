#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <map>

#include "base/errors.hpp"
#include "integrators/static_control.hpp"

namespace nsframe {

namespace {

constexpr double least_increment = 1.0 / 4096;  // of the increment asked for

struct ControlKind {
  std::function<std::unique_ptr<StaticControl>(const ControlSetup&)> make;
  bool needs_node, one_target;
};

const std::map<std::string, ControlKind>& control_kinds() {
  static const std::map<std::string, ControlKind> controls{
      {"load", {make_load_control, false, false}},
      {"displacement", {make_displacement_control, true, false}},
      {"arc-length", {make_arc_length, true, true}},
  };
  return controls;
}

}  // namespace

std::vector<std::string> control_names() {
  std::vector<std::string> names;
  for (const auto& entry : control_kinds()) names.push_back(entry.first);
  return names;
}

std::unique_ptr<StaticControl> make_control(const ControlSetup& setup) {
  return control_kinds().at(setup.stage.options.control).make(setup);
}

void check_stages(const std::vector<StaticStage>& stages, Diagnostics& diagnostics) {
  for (const StaticStage& stage : stages) {
    const auto found = control_kinds().find(stage.options.control);
    if (found == control_kinds().end()) {
      diagnostics.error(stage.options.control_at, fmt::format("control '{}' is not known{}", stage.options.control,
                                              did_you_mean(stage.options.control, control_names())));
      continue;
    }
    if (found->second.needs_node && stage.control_row.size() == 0) {
      diagnostics.error(stage.at, fmt::format("stage '{}': control by {} needs a node and a DOF: at = [\"structure.node\", \"ux\"]",
                                              stage.name, stage.options.control));
    }
    if (found->second.one_target && stage.options.targets.size() != 1) {
      diagnostics.error(stage.at, fmt::format("stage '{}': control by {} has one target, not {}", stage.name,
                                              stage.options.control, stage.options.targets.size()));
    }
    if (stage.options.targets.empty()) diagnostics.error(stage.at, fmt::format("stage '{}' has no target", stage.name));
  }
}

Path::Path(double start, const std::vector<double>& targets, double step, int steps)
    : targets_(targets), step_(step), steps_(steps), from_(start) {
  begin_branch();
}

void Path::begin_branch() {
  while (at_ < targets_.size() && targets_[at_] == from_) ++at_;
  if (done()) return;
  // a length that is a multiple of the step but for rounding takes no increment more
  count_ = step_ > 0 ? std::max(1.0, std::ceil(std::abs(targets_[at_] - from_) / step_ * (1 - 1e-12))) : steps_;
  reached_ = 0;
  increment_ = 1;
}

double Path::next() const {
  const double level = reached_ + increment_;
  return level >= count_ ? targets_[at_] : from_ + (targets_[at_] - from_) * level / count_;
}

void Path::accept() {
  reached_ += increment_;
  if (reached_ >= count_) {
    from_ = targets_[at_++];
    begin_branch();
  } else if (increment_ < 1 && std::fmod(reached_, 2 * increment_) == 0) {
    increment_ *= 2;
  }
}

bool Path::retreat() {
  increment_ /= 2;
  return increment_ >= least_increment;
}

}  // namespace nsframe
