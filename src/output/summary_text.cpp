#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

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

std::string pair_name(const Summary& summary, int pair) {
  const auto i = static_cast<std::size_t>(pair);
  return pair >= 0 && i < summary.pairs.size() ? summary.pairs[i] : fmt::format("pair {}", pair);
}

void put_head(Buffer& out, const Summary& summary) {
  if (!summary.title.empty()) line(out, "{}", shortened(summary.title, columns));
  line(out, "{}, dt {:g} ms, {} steps to {:g} s, {} free DOFs, {} elements, {} fibers", summary.scheme,
       1e3 * summary.dt, summary.steps, summary.end_time, summary.dofs, summary.elements, summary.fibers);
  if (!summary.completed) {
    line(out, "STOPPED at {:g} s of {:g} s:", summary.end_time, summary.duration);
    paragraph(out, summary.stop_reason, 4);
  }
}

void put_poundings(Buffer& out, const Summary& summary) {
  if (summary.pairs.empty()) return;
  if (summary.poundings.empty()) {
    line(out, "\nPoundings: none");
    return;
  }
  line(out, "\nPoundings: {} of {} impacts (impacts of one pair closer than 20 ms count as one)",
       summary.poundings.size(), summary.impacts.size());
  line(out, "  {:>9}  {:<38} {:>9}  {:>10}  {:>8}  {:>9}", "time", "pair", "approach", "impulse", "duration",
       "effective");
  line(out, "  {:>9}  {:<38} {:>9}  {:>10}  {:>8}  {:>9}", "s", "", "m/s", "N s", "ms", "e");
  for (std::size_t i = 0; i < std::min(most_rows, summary.poundings.size()); ++i) {
    const Pounding& p = summary.poundings[i];
    line(out, "  {:>9.4f}  {:<38} {:>9.4f}  {:>10.5g}  {:>8.1f}  {:>9.3f}", p.time,
         shortened(pair_name(summary, p.pair), 38), p.approach_velocity, p.impulse, 1e3 * p.duration,
         p.effective_restitution);
  }
  if (summary.poundings.size() > most_rows) line(out, "  ... and {} more", summary.poundings.size() - most_rows);
}

double largest(const Peak& peak) { return peak.displacement.norm(); }

void put_peaks(Buffer& out, const Summary& summary) {
  if (summary.peaks.empty()) return;
  std::vector<Peak> peaks = summary.peaks;
  std::stable_sort(peaks.begin(), peaks.end(), [](const Peak& a, const Peak& b) { return largest(a) > largest(b); });
  const std::size_t rows = std::min<std::size_t>(peaks.size(), 12);
  line(out, "\nPeaks (largest absolute values; displacement and velocity relative to the base)");
  line(out, "  {:<24} {:>24}  {:>10}  {:>24}  {:>8}", "node", "displacement x y z, mm", "twist, rad",
       "acceleration x y z, m/s2", "v, m/s");
  for (std::size_t i = 0; i < rows; ++i) {
    const Peak& p = peaks[i];
    const Vector3 d = 1e3 * p.displacement, a = p.acceleration;
    line(out, "  {:<24} {:>8.2f}{:>8.2f}{:>8.2f}  {:>10.5f}  {:>8.2f}{:>8.2f}{:>8.2f}  {:>8.3f}", shortened(p.node, 24),
         d.x(), d.y(), d.z(), p.twist, a.x(), a.y(), a.z(), p.velocity.maxCoeff());
  }
  if (peaks.size() > rows) line(out, "  ... and {} more nodes with less displacement", peaks.size() - rows);
}

void put_energy(Buffer& out, const Summary& summary) {
  const Energy& e = summary.energy;
  line(out, "\nEnergy at the end, J");
  line(out, "  {:>11} {:>11} {:>11} {:>11} {:>11} {:>11} {:>11} {:>11}", "input", "initial", "kinetic", "strain",
       "damping", "contact", "numerical", "error");
  line(out, "  {:>11.4g} {:>11.4g} {:>11.4g} {:>11.4g} {:>11.4g} {:>11.4g} {:>11.4g} {:>11.1e}", e.input, e.initial,
       e.kinetic, e.strain, e.damping, e.contact, e.numerical, e.balance_error());
  line(out, "  largest balance error of the run: {:.1e} of the largest energy", summary.worst_balance_error);
}

void put_modes(Buffer& out, const Summary& summary) {
  if (summary.modes.empty()) return;
  line(out, "\nDamping of the modes, as the scene asks for and as scheme and step make it");
  line(out, "  {:<26} {:<6} {:>12} {:>14} {:>9} {:>9} {:>10}", "structure", "mode", "frequency, Hz", "effective, Hz",
       "asked, %", "added, %", "in all, %");
  for (std::size_t i = 0; i < std::min(most_rows, summary.modes.size()); ++i) {
    const ModeNumerics& m = summary.modes[i];
    line(out, "  {:<26} {:<6} {:>13.4g} {:>14.4g} {:>9.3f} {:>9.3f} {:>10.3f}", shortened(m.structure, 26),
         shortened(m.mode, 6), m.frequency, m.frequency_effective, 100 * m.damping_asked,
         100 * (m.damping_effective - m.damping_asked), 100 * m.damping_effective);
  }
  if (summary.modes.size() > most_rows) line(out, "  ... and {} more", summary.modes.size() - most_rows);
}

void put_solution(Buffer& out, const Summary& summary) {
  line(out, "\nSolution");
  if (!summary.pairs.empty()) {
    line(out, "  largest penetration {:.3g} mm, largest complementarity error {:.1e}", 1e3 * summary.max_penetration,
         summary.max_complementarity_error);
  }
  line(out, "  Newton iterations {} ({:.2f} a step), halved steps {}, factorizations {}", summary.newton_iterations,
       summary.steps > 0 ? double(summary.newton_iterations) / summary.steps : 0.0, summary.halved_steps,
       summary.factorizations);
  const Timing& t = summary.timing;
  line(out, "  wall time: setup {:.3f} s, step loop {:.3f} s ({:.1f} us a step), output {:.3f} s", t.setup, t.step_loop,
       summary.steps > 0 ? 1e6 * t.step_loop / summary.steps : 0.0, t.output);
}

}  // namespace

std::string summary_text(const Summary& summary) {
  Buffer out;
  put_head(out, summary);
  put_poundings(out, summary);
  put_peaks(out, summary);
  put_modes(out, summary);
  put_energy(out, summary);
  put_solution(out, summary);
  if (!summary.warnings.empty()) {
    line(out, "\nWarnings");
    for (const auto& warning : summary.warnings) paragraph(out, warning, 4);
  }
  return out;
}

}  // namespace nsframe
