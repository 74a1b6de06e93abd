#include "output/numerical_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nsframe {

namespace {

constexpr double heavy = 0.05, very_heavy = 0.1;  // effective masses of modes, of all

std::string percent(double ratio) {
  const double value = 100 * ratio;
  const int decimals = std::abs(value) < 0.095 ? 2 : std::abs(value) < 99.5 ? 1 : 0;
  return fmt::format("{:.{}f} %", value, decimals);
}

std::string mode_of(const ModeNumerics& mode) { return fmt::format("{} of '{}'", mode.mode, mode.structure); }

// The scheme adds a quarter or more of the damping that the scene asks for, and at least 0.05 %.
bool damped_too_much(const ModeNumerics& mode) {
  const double added = mode.damping_effective - mode.damping_asked;
  return added > std::max(5e-4, 0.25 * mode.damping_asked);
}

// Added over asked; undamped modes count as asking for 0.1 %.
double excess(const ModeNumerics& mode) {
  return (mode.damping_effective - mode.damping_asked) / std::max(mode.damping_asked, 1e-3);
}

std::string added_to(const ModeNumerics& mode) {
  return fmt::format("{} to {} ({} asked)", percent(mode.damping_effective - mode.damping_asked), mode_of(mode),
                     mode.damping_asked > undamped ? percent(mode.damping_asked) : "none");
}

constexpr double main_share = 0.3;  // of the mass, in a mode that carries a structure's response

// Of the modes that are damped too much: the lowest main mode of each of the first two structures, and the one that is
// furthest from what is asked for.
std::vector<const ModeNumerics*> modes_to_name(const std::vector<const ModeNumerics*>& damped) {
  std::vector<const ModeNumerics*> named;
  for (const ModeNumerics* mode : damped) {
    const auto same = std::find_if(named.begin(), named.end(),
                                   [&](const auto* other) { return other->structure == mode->structure; });
    if (same == named.end()) {
      if (named.size() < 2) named.push_back(mode);
    } else if ((*same)->participation < main_share && mode->participation > (*same)->participation) {
      *same = mode;
    }
  }
  const auto* worst = *std::max_element(damped.begin(), damped.end(),
                                        [](const auto* a, const auto* b) { return excess(*a) < excess(*b); });
  if (std::find(named.begin(), named.end(), worst) == named.end()) named.push_back(worst);
  return named;
}

void warn_of_damping(const Summary& summary, const std::vector<ModeNumerics>& modes,
                     std::vector<std::string>& warnings) {
  std::vector<const ModeNumerics*> damped;
  for (const ModeNumerics& mode : modes) {
    if (damped_too_much(mode)) damped.push_back(&mode);
  }
  if (damped.empty()) return;
  const auto named = modes_to_name(damped);
  std::string list;
  for (const ModeNumerics* mode : named) list += (list.empty() ? "" : ", ") + added_to(*mode);
  const auto others = damped.size() - named.size();
  if (others > 0) list += fmt::format(", and too much to {} other mode{}", others, others == 1 ? "" : "s");
  const bool by_rho = !summary.integrator.empty() && summary.integrator != "theta";
  const double value = by_rho ? summary.rho_infinity : summary.theta, none = by_rho ? 1 : 0.5;
  const char* option = by_rho ? "rho_infinity" : "theta";
  warnings.push_back(fmt::format("{} = {:g} at dt = {:g} ms adds damping of its own: {}: {}{}", option, value, 1e3 * summary.dt, list,
                                 summary.pairs.empty() ? "peaks come out too low" : "impacts may be missed",
                                 value != none ? fmt::format("; {} = {:g} adds none", option, none) : ""));
}

void warn_of_shift(const Summary& summary, const std::vector<ModeNumerics>& modes, std::vector<std::string>& warnings) {
  const auto shift = [](const ModeNumerics& mode) {
    return mode.frequency > 0 && mode.frequency_effective > 0 ? mode.frequency_effective / mode.frequency - 1 : 0.0;
  };
  const auto worst = std::max_element(modes.begin(), modes.end(), [&](const auto& a, const auto& b) {
    return std::abs(shift(a)) < std::abs(shift(b));
  });
  if (worst == modes.end() || std::abs(shift(*worst)) < 0.01) return;
  warnings.push_back(fmt::format("dt = {:g} ms shifts the frequency of mode {} by {}: a smaller step is needed for it",
                                 1e3 * summary.dt, mode_of(*worst), percent(shift(*worst))));
}

constexpr std::size_t enough_points = 20;  // of a stage: with fewer, half of the range is a step as it was asked for

// A displacement that is led on by small steps, and a load that jumps: the solution may have gone over to another state of equilibrium.
void warn_of_jumps(const StageResult& stage, std::vector<std::string>& warnings) {
  if (stage.control != "displacement" || stage.points.size() < enough_points) return;
  const auto less = [](const StagePoint& a, const StagePoint& b) { return a.load_factor < b.load_factor; };
  const auto [least, most] = std::minmax_element(stage.points.begin(), stage.points.end(), less);
  std::size_t at = 2;  // the first interval may be the stiffest by far
  const auto jump = [&](std::size_t k) { return std::abs(stage.points[k].load_factor - stage.points[k - 1].load_factor); };
  for (std::size_t k = 3; k < stage.points.size(); ++k) {
    if (jump(k) > jump(at)) at = k;
  }
  if (!(jump(at) > 0.5 * (most->load_factor - least->load_factor))) return;
  warnings.push_back(fmt::format("static stage '{}': from point {} to the next, at {:.4g} of {}, the load factor jumps from {:.4g} to {:.4g}: the path may have gone "
                                 "over to another equilibrium; a smaller step, or control = \"arc-length\", tells",
                                 stage.name, at - 1, stage.points[at].displacement, stage.at, stage.points[at - 1].load_factor, stage.points[at].load_factor));
}

void warn_of_resting_modes(const Summary& summary, std::vector<std::string>& warnings) {
  const auto heaviest = std::max_element(summary.modes.begin(), summary.modes.end(), [&](const auto& a, const auto& b) {
    const auto weight = [&](const ModeNumerics& mode) { return mode.frequency > summary.resting_frequency ? mode.participation : 0; };
    return weight(a) < weight(b);
  });
  if (summary.resting_frequency == 0 || heaviest == summary.modes.end()) return;
  if (!(heaviest->frequency > summary.resting_frequency && heaviest->participation > very_heavy)) return;
  warnings.push_back(fmt::format("dt = {:g} ms is too long for nonlinear elements to see mode {} ({:.3g} Hz) swing: they see it where it would rest; a smaller step, or "
                                 "accuracy, shows it",
                                 1e3 * summary.dt, mode_of(*heaviest), heaviest->frequency));
}

}  // namespace

std::vector<ModeNumerics> modes_that_matter(const Summary& summary) {
  std::vector<ModeNumerics> modes;
  std::copy_if(summary.modes.begin(), summary.modes.end(), std::back_inserter(modes), [](const auto& mode) {
    return mode.damping_asked > undamped || (mode.participation > heavy && mode.frequency < 30);
  });
  return modes.empty() ? summary.modes : modes;
}

std::vector<std::string> numerical_warnings(const Summary& summary) {
  std::vector<std::string> warnings;
  for (const StageResult& stage : summary.stages) {
    warn_of_jumps(stage, warnings);
    if (stage.least_gap >= 0) continue;
    warnings.push_back(fmt::format("static stage '{}' closes a contact by {:.3g} mm: contacts do not act in static stages, structures "
                                   "pass through each other there",
                                   stage.name, -1e3 * stage.least_gap));
  }
  if (summary.steps == 0 && !summary.stages.empty()) return warnings;  // static only
  const auto modes = modes_that_matter(summary);
  warn_of_damping(summary, modes, warnings);
  warn_of_shift(summary, modes, warnings);
  warn_of_resting_modes(summary, warnings);
  if (summary.worst_balance_error > 0.01) {
    warnings.push_back(
        fmt::format("the energy balance is off by {} of the largest energy: the results are not accurate",
                    percent(summary.worst_balance_error)));
  }
  if (summary.max_complementarity_error > 1e-6) {
    warnings.push_back(fmt::format("the contact problem is solved to {:.1e} only: impulses carry that relative error",
                                   summary.max_complementarity_error));
  }
  if (summary.accumulations.plastic > 0) {
    warnings.push_back(fmt::format("{} times impacts at one moment did not come to an end and were made plastic: e did not act there",
                                   summary.accumulations.plastic));
  }
  return warnings;
}

}  // namespace nsframe
