#include "output/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "output/files.hpp"

namespace nsframe {
std::string pair_name(const Summary& summary, int pair) {
  const auto i = static_cast<std::size_t>(pair);
  return pair >= 0 && i < summary.pairs.size() ? summary.pairs[i] : fmt::format("pair {}", pair);
}

namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr double undamped = 1e-9;  // damping ratios below are rounding
constexpr double heavy = 0.05, very_heavy = 0.1;  // effective masses of modes, of all

OrderedJson to_json(const Vector3& vector) { return {vector.x(), vector.y(), vector.z()}; }

OrderedJson impacts_json(const Summary& summary) {
  OrderedJson list = OrderedJson::array();
  for (const auto& impact : summary.impacts) {
    list.push_back({{"t", impact.time},
                    {"pair", pair_name(summary, impact.pair)},
                    {"approach_velocity", impact.approach_velocity},
                    {"impulse", impact.impulse},
                    {"rate_before", impact.rate_before},
                    {"rate_after", impact.rate_after},
                    {"duration", impact.duration}});
  }
  return list;
}

OrderedJson poundings_json(const Summary& summary) {
  OrderedJson list = OrderedJson::array();
  for (const auto& pounding : summary.poundings) {
    list.push_back({{"t", pounding.time},
                    {"duration", pounding.duration},
                    {"pair", pair_name(summary, pounding.pair)},
                    {"approach_velocity", pounding.approach_velocity},
                    {"impulse", pounding.impulse},
                    {"effective_restitution", pounding.effective_restitution},
                    {"impacts", pounding.impacts}});
  }
  return list;
}

OrderedJson friction_json(const Summary& summary) {
  OrderedJson list = OrderedJson::array();
  for (const Slip& slip : summary.slips) {
    list.push_back({{"pair", pair_name(summary, slip.pair)}, {"slip", slip.distance}, {"energy", slip.energy}});
  }
  return list;
}

OrderedJson state_work_json(const StateWorkSums& work) {
  OrderedJson json = OrderedJson::object();
  visit_state_work(work, [&json](const char* name, long number) { json[name] = number; });
  return json;
}

OrderedJson ladder_json(const std::vector<LadderRecord>& records) {
  OrderedJson list = OrderedJson::array();
  for (const auto& record : records) {
    OrderedJson attempts = OrderedJson::array();
    for (const auto& attempt : record.attempts) {
      attempts.push_back({{"algorithm", attempt.algorithm},
                          {"iterations", attempt.iterations},
                          {"converged", attempt.converged},
                          {"error", attempt.error},
                          {"reason", attempt.reason}});
    }
    list.push_back({{"step", record.step}, {record.stage.empty() ? "t" : "load_factor", record.at}, {"attempts", attempts}});
  }
  return list;
}

// The whole curve is in results.h5; here its ends and its largest load factor.
OrderedJson stages_json(const Summary& summary) {
  OrderedJson list = OrderedJson::array();
  for (const auto& stage : summary.stages) {
    const auto by_factor = [](const StagePoint& a, const StagePoint& b) { return a.load_factor < b.load_factor; };
    const auto [least, most] = std::minmax_element(stage.points.begin(), stage.points.end(), by_factor);
    list.push_back({{"stage", stage.name},
                    {"control", stage.control},
                    {"at", stage.at},
                    {"completed", stage.completed},
                    {"stop_reason", stage.stop_reason},
                    {"points", stage.points.size() - 1},
                    {"load_factor", stage.points.back().load_factor},
                    {"control_displacement", stage.points.back().displacement},
                    {"largest_load_factor", most->load_factor},
                    {"displacement_at_largest", most->displacement},
                    {"least_load_factor", least->load_factor},
                    {"displacement_at_least", least->displacement},
                    {"iterations", stage.iterations},
                    {"halved", stage.halved},
                    {"factorizations", stage.factorizations},
                    {"ladder", ladder_json(stage.ladder)}});
  }
  return list;
}

OrderedJson peaks_json(const Summary& summary) {
  OrderedJson list = OrderedJson::array();
  for (const auto& peak : summary.peaks) {
    list.push_back({{"node", peak.node},
                    {"displacement", to_json(peak.displacement)},
                    {"velocity", to_json(peak.velocity)},
                    {"acceleration", to_json(peak.acceleration)},
                    {"twist", peak.twist}});
  }
  return list;
}

OrderedJson drifts_json(const Summary& summary) {
  OrderedJson list = OrderedJson::array();
  for (const auto& drift : summary.drifts) {
    list.push_back({{"structure", drift.structure},
                    {"story", drift.story},
                    {"bottom", drift.bottom},
                    {"top", drift.top},
                    {"drift", {drift.drift.x(), drift.drift.y()}}});
  }
  return list;
}

OrderedJson floor_spectra_json(const Summary& summary) {
  OrderedJson list = OrderedJson::array();
  for (const auto& peak : summary.floor_spectra) {
    list.push_back({{"node", peak.node},
                    {"direction", std::string(1, static_cast<char>('x' + peak.direction))},
                    {"damping", summary.floor_spectra_damping},
                    {"psa", peak.psa},
                    {"psa_period", peak.psa_period},
                    {"psv", peak.psv},
                    {"psv_period", peak.psv_period}});
  }
  return list;
}

OrderedJson energy_json(const Summary& summary) {
  const Energy& energy = summary.energy;
  return {{"kinetic", energy.kinetic},
          {"strain", energy.strain},
          {"damping", energy.damping},
          {"contact", energy.contact},
          {"friction", energy.friction},
          {"numerical", energy.numerical},
          {"input", energy.input},
          {"initial", energy.initial},
          {"balance_error", energy.balance_error()},
          {"worst_relative_balance_error", summary.worst_balance_error}};
}

OrderedJson modes_json(const Summary& summary) {
  OrderedJson list = OrderedJson::array();
  for (const auto& mode : summary.modes) {
    list.push_back({{"structure", mode.structure},
                    {"mode", mode.mode},
                    {"frequency", mode.frequency},
                    {"asked", mode.damping_asked > undamped ? mode.damping_asked : 0.0},
                    {"effective", mode.damping_effective},
                    {"added", mode.damping_effective - mode.damping_asked},
                    {"effective_frequency", mode.frequency_effective},
                    {"period_error", mode.frequency_effective > 0 ? mode.frequency / mode.frequency_effective - 1 : 0.0}});
    if (mode.complex_frequency == 0) continue;
    list.back()["complex_frequency"] = mode.complex_frequency;
    list.back()["complex_damping"] = mode.complex_damping;
  }
  return list;
}

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

std::string summary_json(const Summary& summary) {
  const OrderedJson json = {
      {"program", "nsframe"},
      {"version", NSFRAME_VERSION},
      {"title", summary.title},
      {"completed", summary.completed},
      {"stop_reason", summary.stop_reason},
      {"end_time", summary.end_time},
      {"scheme", summary.scheme},
      {"scheme_reason", summary.scheme_reason},
      {"dt", summary.dt},
      {"duration", summary.duration},
      {"theta", summary.theta},
      {"gamma", summary.gamma},
      {"integrator", summary.integrator},
      {"rho_infinity", summary.rho_infinity},
      {"steps", summary.steps},
      {"nodes", summary.nodes},
      {"elements", summary.elements},
      {"fibers", summary.fibers},
      {"dofs", summary.dofs},
      {"structures", summary.structures},
      {"frequencies", summary.frequencies},
      {"numerical_damping", modes_json(summary)},
      {"pairs", summary.pairs},
      {"stages", stages_json(summary)},
      {"impacts", impacts_json(summary)},
      {"poundings", poundings_json(summary)},
      {"peaks", peaks_json(summary)},
      {"drifts", drifts_json(summary)},
      {"floor_spectra", floor_spectra_json(summary)},
      {"friction", friction_json(summary)},
      {"restitution",
       {{"created_energy", summary.created.sum},
        {"largest_created", summary.created.largest},
        {"largest_created_t", summary.created.largest_time}}},
      {"energy", energy_json(summary)},
      {"max_penetration", summary.max_penetration},
      {"max_complementarity_error", summary.max_complementarity_error},
      {"newton_iterations", summary.newton_iterations},
      {"halved_steps", summary.halved_steps},
      {"evaluations", summary.evaluations},
      {"rejected_parts", summary.rejected_parts},
      {"stiffened_steps", summary.stiffened_steps},
      {"struck_frequency", summary.struck_frequency},
      {"resting_frequency", summary.resting_frequency},
      {"left_out_modes", summary.left_out_modes},
      {"kept_mass", summary.kept_mass},
      {"laddered_steps", summary.laddered_steps},
      {"ladder", ladder_json(summary.ladder)},
      {"factorizations", summary.factorizations},
      {"accumulations",
       {{"ended", summary.accumulations.ended},
        {"largest_bounce", summary.accumulations.largest_bounce},
        {"plastic", summary.accumulations.plastic}}},
      {"softened_members", summary.softened_members},
      {"savings",
       {{"elements_assembled_once", summary.savings.elements_assembled_once},
        {"quiet_fibers", summary.savings.quiet_fibers},
        {"guessed_steps", summary.savings.guessed_steps},
        {"factorizations_avoided", summary.savings.factorizations_avoided},
        {"massless_dofs", summary.savings.massless_dofs},
        {"condensed_dofs", summary.savings.condensed_dofs},
        {"condensed_entries", summary.savings.condensed_entries},
        {"stored_entries", summary.savings.stored_entries}}},
      {"state_determination", state_work_json(summary.state_work)},
      {"timing",
       {{"setup", summary.timing.setup}, {"step_loop", summary.timing.step_loop}, {"output", summary.timing.output}}},
      {"warnings", summary.warnings}};
  // Names may come from a file in another encoding: bytes that are not UTF-8 are replaced, not fatal.
  return json.dump(1, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

void write_summary(const Summary& summary, const std::filesystem::path& path) {
  write_text_file(path, summary_json(summary));
}

}  // namespace nsframe
