#include "output/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "output/files.hpp"
#include "output/numerical_warnings.hpp"

namespace nsframe {
std::string pair_name(const Summary& summary, int pair) {
  const auto i = static_cast<std::size_t>(pair);
  return pair >= 0 && i < summary.pairs.size() ? summary.pairs[i] : fmt::format("pair {}", pair);
}

namespace {

using OrderedJson = nlohmann::ordered_json;

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

}  // namespace

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
