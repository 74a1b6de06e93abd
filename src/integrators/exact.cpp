#include "integrators/exact.hpp"

#include <fmt/format.h>

#include <utility>

#include "base/errors.hpp"

namespace nsframe {

namespace {

const System& linear_only(const System& system, const Location& at) {
  const std::string nonlinear = nonlinear_element(system);
  Diagnostics diagnostics;
  if (!nonlinear.empty()) {
    diagnostics.error(at, fmt::format("scheme 'exact' is for linear scenes, and {} is nonlinear; use scheme = \"exponential\" or \"moreau-jean\"", nonlinear));
  }
  diagnostics.throw_if_any();
  return system;
}

}  // namespace

Exact::Exact(const AnalysisOptions& options, const System& system)
    : flow_(options, linear_only(system, options.scheme_at), system.assembler.tangent()) {}

void Exact::begin_anew(const System& system, const State& committed) {
  flow_.start(system, committed);
  goes_on_ = begins_ = true;
}

void Exact::step(System& system, const State& committed, State& trial, double h, StepResult& result) {
  result.clear();
  if (!std::exchange(goes_on_, false)) {
    flow_.start(system, committed);
    begins_ = true;
  }
  flow_.clear_impulse();
  flow_.travel(system, committed.time, h, std::exchange(begins_, false), result);
  trial.time = committed.time + h;
  flow_.write(trial.displacement, trial.velocity);
  trial.impulse = flow_.impulse();
  result.kinetic = flow_.kinetic_energy();
  goes_on_ = true;
}

void Exact::save(Snapshot& snapshot) const {
  flow_.save(snapshot);
  snapshot.put("exact.goes_on", goes_on_ ? 1.0 : 0.0);
  snapshot.put("exact.begins", begins_ ? 1.0 : 0.0);
}

void Exact::restore(System&, const Snapshot& snapshot) {
  flow_.restore(snapshot);
  goes_on_ = snapshot.number("exact.goes_on") != 0;
  begins_ = snapshot.number("exact.begins") != 0;
}

std::vector<std::string> Exact::describe() const {
  std::vector<std::string> lines = flow_.describe();
  lines.emplace_back("linear, every mode in closed form; impacts located, contact by an exact active-set method");
  return lines;
}

}  // namespace nsframe
