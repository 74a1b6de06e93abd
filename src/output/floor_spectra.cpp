#include "output/floor_spectra.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "models/snapshot.hpp"

namespace nsframe {
namespace {

constexpr long whole_step = 1000000;     // millionths: places of jumps within a step are rounded to them
constexpr std::size_t most_steps = 64;   // lengths kept

std::string name_of(int node, const Model& model) { return model.nodes.id[static_cast<std::size_t>(node)]; }

// Centres of the slabs of a structure, or their corners; without slabs, the nodes that carry horizontal mass.
std::vector<std::string> spectra_floors_of(const Model& model, int structure) {
  std::vector<std::string> floors;
  for (const Slab& slab : model.slabs) {
    if (slab.structure != structure) continue;
    const std::vector<int> nodes = slab.center >= 0 ? std::vector<int>{slab.center} : slab.corners;
    for (const int node : nodes) floors.push_back(name_of(node, model));
  }
  if (!floors.empty()) return floors;
  for (const int node : model.structures[static_cast<std::size_t>(structure)].nodes) {
    if (model.nodal_mass.segment<2>(6 * node).maxCoeff() > 0) floors.push_back(name_of(node, model));
  }
  return floors;
}

// Names with "floors" replaced by the nodes that it stands for; each once.
std::vector<std::string> resolve(const std::vector<std::string>& names, const Model& model) {
  std::vector<std::string> resolved;
  std::set<std::string> known;
  const auto add = [&](const std::string& name) {
    if (known.insert(name).second) resolved.push_back(name);
  };
  for (const std::string& name : names) {
    if (name != "floors") {
      add(name);
      continue;
    }
    for (int s = 0; s < static_cast<int>(model.structures.size()); ++s) {
      for (const std::string& floor : spectra_floors_of(model, s)) add(floor);
    }
  }
  return resolved;
}

}  // namespace

FloorSpectra::FloorSpectra(const FloorSpectraOptions& options, double dt)
    : names_(options.nodes), periods_(options.periods), damping_(options.damping), dt_(dt) {
  if (periods_.empty()) periods_ = logarithmic_periods(0.02, 4, 60);
}

void FloorSpectra::start(const Model& model, const State&) {
  model_ = &model;
  names_ = resolve(names_, model);
  const auto nodes = names_.empty() ? std::vector<int>() : find_nodes(model.nodes, names_);
  level_.clear();
  for (const int node : nodes) level_.push_back(model.nodes.position[static_cast<std::size_t>(node)].z());
  rows_ = TransformationRows(model.dofs, full_dofs(nodes, {0, 1, 2}));
  oscillators_.assign(3 * nodes.size(), Oscillators(periods_.size()));
  acceleration_.assign(3 * nodes.size(), 0.0);
}

void FloorSpectra::advance(long part) {
  if (part == 0) return;
  auto step = steps_.find(part);
  if (step == steps_.end()) {
    if (steps_.size() >= most_steps) steps_.clear();
    const double length = dt_ * static_cast<double>(part) / whole_step;
    step = steps_.emplace(part, OscillatorStep(periods_, damping_, length)).first;
  }
  for (std::size_t i = 0; i < oscillators_.size(); ++i) {
    oscillators_[i].advance(step->second, acceleration_[i], acceleration_[i]);
  }
}

void FloorSpectra::step(const State& before, const State& after, const StepReport& report, const Energy&) {
  smooth_ = after.velocity - before.velocity;
  for (const VelocityJump& jump : report.jumps) smooth_ -= jump.change;
  const Vector3 ground = ground_velocity(*model_, after.time) - ground_velocity(*model_, before.time);
  for (std::size_t i = 0; i < acceleration_.size(); ++i) {
    const double change = rows_.value(static_cast<int>(i), smooth_.data()) + ground[static_cast<Eigen::Index>(i % 3)];
    acceleration_[i] = change / dt_;
  }
  long place = 0;
  for (const VelocityJump& jump : report.jumps) {
    const long at = std::clamp(std::lround((jump.time - before.time) / dt_ * whole_step), place, whole_step);
    advance(at - place);
    place = at;
    for (std::size_t i = 0; i < oscillators_.size(); ++i) {
      oscillators_[i].jump(rows_.value(static_cast<int>(i), jump.change.data()));
    }
  }
  advance(whole_step - place);
}

void FloorSpectra::save(Snapshot& snapshot) {
  std::vector<double> all;
  for (const Oscillators& o : oscillators_) {
    for (const auto* values : {&o.displacement(), &o.velocity(), &o.peak()}) all.insert(all.end(), values->begin(), values->end());
  }
  snapshot.put("floor_spectra", all);
}

void FloorSpectra::resume(const Model& model, const State& state, const Snapshot& snapshot) {
  start(model, state);
  const auto n = static_cast<std::ptrdiff_t>(periods_.size());
  std::vector<double> all(9 * names_.size() * periods_.size());
  snapshot.read("floor_spectra", all);
  auto from = all.begin();
  for (Oscillators& o : oscillators_) {
    o.restore({from, from + n}, {from + n, from + 2 * n}, {from + 2 * n, from + 3 * n});
    from += 3 * n;
  }
}

std::vector<FloorSpectrumPeak> FloorSpectra::peaks() const {
  std::vector<FloorSpectrumPeak> peaks;
  for (std::size_t i = 0; i < oscillators_.size(); ++i) {
    const auto psa = pseudo_acceleration(periods_, oscillators_[i].peak()), psv = pseudo_velocity(periods_, oscillators_[i].peak());
    const auto a = std::max_element(psa.begin(), psa.end()), v = std::max_element(psv.begin(), psv.end());
    if (*a <= 0) continue;
    peaks.push_back({names_[i / 3], static_cast<int>(i % 3), level_[i / 3], *a, periods_[static_cast<std::size_t>(a - psa.begin())],
                     *v, periods_[static_cast<std::size_t>(v - psv.begin())]});
  }
  return peaks;
}

std::vector<std::string> spectrum_warnings(const FloorSpectra& spectra, double dt) {
  const auto& periods = spectra.periods();
  const double shortest = *std::min_element(periods.begin(), periods.end());
  if (shortest >= 10 * dt * (1 - 1e-9)) return {};
  return {fmt::format("floor spectra below a period of {:g} s are not accurate: the motion of the floors is known in steps of {:g} ms",
                      10 * dt, 1e3 * dt)};
}

}  // namespace nsframe
