#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "output/numerical_warnings.hpp"
#include "output/summary.hpp"

namespace nsframe {
namespace {

constexpr std::size_t most_rows = 20;
constexpr std::size_t columns = 100;

using Buffer = std::string;

template <class... Arguments>
void line(Buffer& out, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  fmt::format_to(std::back_inserter(out), format, std::forward<Arguments>(arguments)...);
  out += '\n';
}

// At most `width` characters; the middle of a long name is left out, since both ends tell names apart. Counts UTF-8
// characters, and never cuts one.
std::string shortened(const std::string& name, std::size_t width) {
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if ((static_cast<unsigned char>(name[i]) & 0xC0U) != 0x80U) starts.push_back(i);
  }
  if (starts.size() <= width) return name;
  const std::size_t head = (width - 2) / 2, tail = width - 2 - head;
  return name.substr(0, starts[head]) + ".." + name.substr(starts[starts.size() - tail]);
}

// Breaks at blanks; following lines are indented.
void paragraph(Buffer& out, const std::string& text, std::size_t indent) {
  const std::string margin(indent, ' ');
  std::string current = "  - ";
  bool empty = true;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_of(" \n", at), text.size());
    const std::string word = text.substr(at, end - at);
    if (!empty && current.size() + 1 + word.size() > columns) {
      line(out, "{}", current);
      current = margin;
      empty = true;
    }
    current += (empty ? "" : " ") + word;
    empty = false;
    at = end + 1;
  }
  line(out, "{}", current);
}

// "1 impact", "2 impacts".
std::string counted(std::size_t count, const std::string& what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

// 0 in place of what is only rounding beside `scale`; also of -0.
double rounded_off(double value, double scale) { return std::abs(value) <= scale ? 0.0 : value; }

std::string structure_of(const std::string& node) { return node.substr(0, node.rfind('.')); }

bool static_only(const Summary& summary) { return summary.steps == 0 && !summary.stages.empty(); }

void put_head(Buffer& out, const Summary& summary) {
  if (!summary.title.empty()) line(out, "{}", shortened(summary.title, columns));
  const auto count = [](int number, const char* what) { return counted(static_cast<std::size_t>(number), what); };
  if (static_only(summary)) {
    line(out, "static, {}, {}{}", count(summary.dofs, "free DOF"), count(summary.elements, "element"),
         summary.fibers > 0 ? ", " + count(summary.fibers, "fiber") : "");
    if (!summary.completed) paragraph(out, "STOPPED: " + summary.stop_reason, 4);
    return;
  }
  line(out, "{}, dt {:g} ms, {} to {:g} s, {}, {}{}", summary.scheme, 1e3 * summary.dt, count(summary.steps, "step"),
       summary.end_time, count(summary.dofs, "free DOF"), count(summary.elements, "element"),
       summary.fibers > 0 ? ", " + count(summary.fibers, "fiber") : "");
  if (!summary.scheme_reason.empty()) paragraph(out, fmt::format("{}: {}", summary.scheme, summary.scheme_reason), 2);
  if (!summary.completed) {
    line(out, "STOPPED at {:g} s of {:g} s:", summary.end_time, summary.duration);
    paragraph(out, summary.stop_reason, 4);
  }
}

// "newton failed (12 iterations), krylov converged in 7".
std::string told(const std::vector<Attempt>& attempts) {
  std::string text;
  for (const Attempt& attempt : attempts) {
    text += text.empty() ? "" : ", ";
    text += attempt.converged ? fmt::format("{} converged in {}", attempt.algorithm, attempt.iterations)
                              : fmt::format("{} failed ({})", attempt.algorithm,
                                            counted(static_cast<std::size_t>(attempt.iterations), "iteration"));
  }
  return text;
}

void put_ladder(Buffer& out, const std::vector<LadderRecord>& records, const char* step, long count) {
  constexpr std::size_t most = 5;
  for (std::size_t i = 0; i < std::min(most, records.size()); ++i) {
    paragraph(out, fmt::format("{} {}: {}", step, records[i].step, told(records[i].attempts)), 4);
  }
  if (count > static_cast<long>(most)) line(out, "  ... and {} more, in summary.json", count - static_cast<long>(most));
}

void put_stage(Buffer& out, const StageResult& stage) {
  line(out, "\nStatic stage '{}' by {}: {} to load factor {:.6g}, {}{}{}", stage.name, stage.control,
       counted(stage.points.size() - 1, "point"), stage.points.back().load_factor,
       counted(static_cast<std::size_t>(stage.iterations), "iteration"),
       stage.halved > 0 ? fmt::format(", {} smaller", counted(static_cast<std::size_t>(stage.halved), "increment")) : "",
       stage.completed ? "" : ", STOPPED");
  line(out, "  {:>7}  {:>14}  {:>20}  {:>10}", "point", "load factor", stage.at.empty() ? "-" : shortened(stage.at, 20), "iterations");
  const std::size_t last = stage.points.size() - 1, rows = std::min(most_rows, last);
  for (std::size_t i = 0; i <= rows; ++i) {
    const std::size_t number = rows > 0 ? i * last / rows : 0;
    const StagePoint& point = stage.points[number];
    line(out, "  {:>7}  {:>14.6g}  {:>20}  {:>10}", number, point.load_factor,
         stage.at.empty() ? "" : fmt::format("{:.6g}", point.displacement), point.iterations);
  }
  put_ladder(out, stage.ladder, "after point", static_cast<long>(stage.ladder.size()));
}

void put_poundings(Buffer& out, const Summary& summary) {
  if (summary.pairs.empty()) return;
  if (summary.poundings.empty()) {
    line(out, "\nPoundings: none");
    return;
  }
  line(out, "\nPoundings: {} in {} (impacts of one pair closer than 20 ms are one pounding)", summary.poundings.size(),
       counted(summary.impacts.size(), "impact"));
  line(out, "  {:>9}  {:<38} {:>9}  {:>10}  {:>8}  {:>9}", "time", "pair", "approach", "impulse", "duration",
       "effective");
  line(out, "  {:>9}  {:<38} {:>9}  {:>10}  {:>8}  {:>9}", "s", "", "m/s", "N s", "ms", "e");
  for (std::size_t i = 0; i < std::min(most_rows, summary.poundings.size()); ++i) {
    const Pounding& p = summary.poundings[i];
    line(out, "  {:>9.4f}  {:<38} {:>9.4f}  {:>10.5g}  {:>8.1f}  {:>9.3f}", p.time,
         shortened(pair_name(summary, p.pair), 38), p.approach_velocity, p.impulse, 1e3 * p.duration,
         rounded_off(p.effective_restitution, 5e-4));
  }
  if (summary.poundings.size() > most_rows) line(out, "  ... and {} more", summary.poundings.size() - most_rows);
}

// One row a level of each structure: its node that moves most. Structures in their order, the roof first; what stands
// still is left out.
std::vector<Peak> peaks_to_show(const Summary& summary) {
  std::vector<std::string> structures;
  std::map<std::pair<std::size_t, long>, Peak> best;  // by structure and level from the top
  for (const Peak& peak : summary.peaks) {
    if (peak.displacement.norm() == 0) continue;
    const std::string name = structure_of(peak.node);
    const auto found = std::find(structures.begin(), structures.end(), name);
    const auto structure = static_cast<std::size_t>(found - structures.begin());
    if (found == structures.end()) structures.push_back(name);
    const auto [at, first] = best.try_emplace({structure, -std::lround(1e3 * peak.level)}, peak);
    if (!first && peak.displacement.norm() > at->second.displacement.norm()) at->second = peak;
  }
  std::vector<Peak> shown;
  for (const auto& [key, peak] : best) shown.push_back(peak);
  return shown;
}

void put_peaks(Buffer& out, const Summary& summary) {
  const std::vector<Peak> peaks = peaks_to_show(summary);
  if (peaks.empty()) return;
  const std::size_t rows = std::min<std::size_t>(peaks.size(), 12);
  line(out, "\nPeaks of the node that moves most on each level (displacement and velocity relative to the base;");
  line(out, "acceleration absolute, over one step: at an impact it grows as the step shrinks)");
  line(out, "  {:<24} {:>24}  {:>10}  {:>24}  {:>8}", "node", "displacement x y z, mm", "twist, rad",
       "acceleration x y z, m/s2", "v, m/s");
  for (std::size_t i = 0; i < rows; ++i) {
    const Peak& p = peaks[i];
    const Vector3 d = 1e3 * p.displacement, a = p.acceleration;
    line(out, "  {:<24} {:>8.2f}{:>8.2f}{:>8.2f}  {:>10.5f}  {:>8.2f}{:>8.2f}{:>8.2f}  {:>8.3f}", shortened(p.node, 24),
         d.x(), d.y(), d.z(), p.twist, a.x(), a.y(), a.z(), p.velocity.maxCoeff());
  }
  if (peaks.size() > rows) line(out, "  ... and {} more levels", peaks.size() - rows);
}

void put_drifts(Buffer& out, const Summary& summary) {
  if (summary.drifts.empty()) return;
  line(out, "\nPeak drifts of the stories (relative displacement of the floors over the height)");
  line(out, "  {:<24} {:>5}  {:>15}  {:>9}  {:>9}", "structure", "story", "from, to z, m", "x, %", "y, %");
  const std::size_t rows = std::min(most_rows, summary.drifts.size());
  for (std::size_t i = 0; i < rows; ++i) {
    const StoryDrift& d = summary.drifts[i];
    line(out, "  {:<24} {:>5}  {:>7.2f} {:>7.2f}  {:>9.3f}  {:>9.3f}", shortened(d.structure, 24), d.story, d.bottom,
         d.top, 100 * d.drift.x(), 100 * d.drift.y());
  }
  if (summary.drifts.size() > rows) line(out, "  ... and {} more", summary.drifts.size() - rows);
}

void put_floor_spectra(Buffer& out, const Summary& summary) {
  if (summary.floor_spectra.empty()) return;
  double most = 0;
  for (const FloorSpectrumPeak& peak : summary.floor_spectra) most = std::max(most, peak.psa);
  std::vector<FloorSpectrumPeak> shown = summary.floor_spectra;
  std::erase_if(shown, [most](const FloorSpectrumPeak& peak) { return peak.psa < 1e-6 * most; });
  line(out, "\nLargest values of the floor spectra ({:g} % damping; impacts as jumps of velocity)", 100 * summary.floor_spectra_damping);
  line(out, "  {:<24} {:>9}  {:>9}  {:>11}  {:>9}  {:>9}  {:>9}", "node", "direction", "PSA, m/s2", "PSA, g", "at T, s", "PSV, m/s",
       "at T, s");
  const std::size_t rows = std::min(most_rows, shown.size());
  for (std::size_t i = 0; i < rows; ++i) {
    const FloorSpectrumPeak& p = shown[i];
    line(out, "  {:<24} {:>9}  {:>9.3f}  {:>11.3f}  {:>9.3f}  {:>9.3f}  {:>9.3f}", shortened(p.node, 24),
         std::string(1, static_cast<char>('x' + p.direction)), p.psa, p.psa / 9.80665, p.psa_period, p.psv, p.psv_period);
  }
  if (shown.size() > rows) line(out, "  ... and {} more", shown.size() - rows);
}

void put_energy(Buffer& out, const Summary& summary) {
  const Energy& e = summary.energy;
  line(out, "\nEnergy at the end, J");
  line(out, "  {:>11} {:>11} {:>11} {:>11} {:>11} {:>11} {:>11} {:>11}", "input", "initial", "kinetic", "strain",
       "damping", "contact", "numerical", "error");
  double most = 0;
  for (const double part : {e.input, e.initial, e.kinetic, e.strain, e.damping, e.contact, e.numerical}) {
    most = std::max(most, std::abs(part));
  }
  const auto tidy = [most](double part) { return rounded_off(part, 1e-12 * most); };
  line(out, "  {:>11.4g} {:>11.4g} {:>11.4g} {:>11.4g} {:>11.4g} {:>11.4g} {:>11.4g} {:>11.1e}", tidy(e.input),
       tidy(e.initial), tidy(e.kinetic), tidy(e.strain), tidy(e.damping), tidy(e.contact + e.friction), tidy(e.numerical),
       e.balance_error());
  if (!summary.slips.empty()) {
    const auto shorter = [](const Slip& a, const Slip& b) { return a.distance < b.distance; };
    const auto most_slip = std::max_element(summary.slips.begin(), summary.slips.end(), shorter);
    line(out, "  of what contact took, friction took {:.4g}; the longest slip, {:.4g} mm, is that of {}", e.friction, 1e3 * most_slip->distance,
         summary.pairs[static_cast<std::size_t>(most_slip->pair)]);
  }
  line(out, "  largest balance error of the run: {:.1e} of the largest energy", summary.worst_balance_error);
}

void put_modes(Buffer& out, const Summary& summary) {
  std::vector<ModeNumerics> modes = modes_that_matter(summary);
  std::erase_if(modes, [](const auto& mode) { return mode.frequency <= 0; });
  if (modes.empty()) return;
  line(out, "\nDamping of the modes, as the scene asks for and as scheme and step make it");
  line(out, "  {:<26} {:<6} {:>12} {:>14} {:>9} {:>9} {:>10}", "structure", "mode", "frequency, Hz", "effective, Hz",
       "asked, %", "added, %", "in all, %");
  const std::size_t rows = std::min(most_rows, modes.size());
  for (std::size_t i = 0; i < rows; ++i) {
    const ModeNumerics& m = modes[i];
    if (summary.left_out_modes > 0 && m.frequency_effective == 0) {
      line(out, "  {:<26} {:<6} {:>13.4g} {:>14} {:>9.3f}", shortened(m.structure, 26), shortened(m.mode, 6), m.frequency, "left out",
           rounded_off(100 * m.damping_asked, 5e-4));
      continue;
    }
    line(out, "  {:<26} {:<6} {:>13.4g} {:>14.4g} {:>9.3f} {:>9.3f} {:>10.3f}", shortened(m.structure, 26),
         shortened(m.mode, 6), m.frequency, m.frequency_effective, rounded_off(100 * m.damping_asked, 5e-4),
         rounded_off(100 * (m.damping_effective - m.damping_asked), 5e-4), rounded_off(100 * m.damping_effective, 5e-4));
  }
  if (summary.modes.size() > rows) {
    line(out, "  ... and {} of less mass or without damping of the scene", counted(summary.modes.size() - rows, "mode"));
  }
}

void put_savings(Buffer& out, const Summary& summary) {
  const Savings& s = summary.savings;
  fmt::format_to(std::back_inserter(out), "  saved: {} of {} assembled once", s.elements_assembled_once, counted(static_cast<std::size_t>(summary.elements), "element"));
  if (summary.fibers > 0) fmt::format_to(std::back_inserter(out), ", {:.0f} % of the fibers in quiet sections", 100 * s.quiet_fibers);
  if (s.guessed_steps > 0) fmt::format_to(std::back_inserter(out), ", {} steps solved by their first guess", s.guessed_steps);
  if (summary.left_out_modes > 0) fmt::format_to(std::back_inserter(out), ", {} left out", counted(static_cast<std::size_t>(summary.left_out_modes), "mode"));
  line(out, ", {} factorizations avoided", s.factorizations_avoided);
  if (s.condensed_dofs > 0) {
    line(out, "  condensed: {} of {} DOFs, which have no mass: factors and stiffness keep {:.0f} % of their entries", s.condensed_dofs, summary.dofs,
         100 * s.condensed_entries);
  } else if (s.massless_dofs > 0) {
    const auto by_arc = [](const StageResult& stage) { return stage.control == "arc-length"; };
    line(out, "  kept: {} DOFs without mass, {}", s.massless_dofs,
         std::any_of(summary.stages.begin(), summary.stages.end(), by_arc)
             ? "since the arc length of static stages counts them"
             : "since factors and stiffness would lose less than a quarter of their entries with them");
  }
  if (s.stored_entries < 1) {
    line(out, "  shared: of the entries of factors and stiffness {:.0f} % are stored, the others equal them", 100 * s.stored_entries);
  }
}

void put_state_work(Buffer& out, const StateWorkSums& work) {
  if (work.evaluations == 0) return;
  line(out, "  force-based members: {} evaluations in {} passes over their sections, {} iterated; {} iterations saved by carrying what was left",
       work.evaluations, work.passes, work.iterated, work.carried - work.finished);
}

void put_solution(Buffer& out, const Summary& summary) {
  line(out, "\nSolution");
  if (!summary.pairs.empty()) {
    line(out, "  largest penetration {:.3g} mm, largest complementarity error {:.1e}", 1e3 * summary.max_penetration,
         summary.max_complementarity_error);
  }
  line(out, "  iterations {} ({:.2f} a step), halved steps {}, factorizations {}", summary.newton_iterations,
       summary.steps > 0 ? double(summary.newton_iterations) / summary.steps : 0.0, summary.halved_steps,
       summary.factorizations);
  if (summary.evaluations > 0) {
    line(out, "  evaluations of the elements {} ({:.2f} a step), parts made anew, shorter, {}", summary.evaluations,
         summary.steps > 0 ? double(summary.evaluations) / summary.steps : 0.0, summary.rejected_parts);
  }
  put_savings(out, summary);
  put_state_work(out, summary.state_work);
  put_ladder(out, summary.ladder, "step", summary.laddered_steps);
  const Timing& t = summary.timing;
  line(out, "  wall time: setup {:.3f} s, step loop {:.3f} s ({:.1f} us a step), output {:.3f} s", t.setup, t.step_loop,
       summary.steps > 0 ? 1e6 * t.step_loop / summary.steps : 0.0, t.output);
}

}  // namespace

std::string summary_text(const Summary& summary) {
  Buffer out;
  put_head(out, summary);
  for (const StageResult& stage : summary.stages) put_stage(out, stage);
  if (!static_only(summary)) {
    put_poundings(out, summary);
    put_peaks(out, summary);
    put_drifts(out, summary);
    put_floor_spectra(out, summary);
    put_modes(out, summary);
    put_energy(out, summary);
    put_solution(out, summary);
  } else if (summary.state_work.evaluations > 0) {
    line(out, "\nSolution");
    put_state_work(out, summary.state_work);
  }
  if (!summary.warnings.empty()) {
    line(out, "\nWarnings");
    for (const auto& warning : summary.warnings) paragraph(out, warning, 4);
  }
  return out;
}

}  // namespace nsframe
