#include "elements/screening.hpp"

#include <algorithm>
#include <cmath>

namespace nsframe {

namespace {

template <class Law>
using Quiet = typename Law::template QuietHistory<double>;

QuietHead& head_of(double* history) { return *reinterpret_cast<QuietHead*>(history); }
const QuietHead& head_of(const double* history) { return *reinterpret_cast<const QuietHead*>(history); }

QuietPath noted_path(const QuietHead& head) {
  QuietPath path;
  path.steps = head.pending();
  std::copy_n(head.noted[0], 3 * (path.steps + 1), path.deformation[0]);
  return path;
}

// An empty struct has the size of a char.
template <class Law>
constexpr std::size_t quiet_components = std::is_empty_v<Quiet<Law>> ? 0 : sizeof(Quiet<Law>) / sizeof(double);

template <class Law>
void open_block(const Law& law, const FiberSection& section, const FiberBlock& block, const Vector3& deformation, double* history) {
  using History = typename Law::template History<double>;
  constexpr std::size_t components = sizeof(History) / sizeof(double);
  static_assert(quiet_components<Law> <= components);
  const auto count = static_cast<std::size_t>(block.count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = static_cast<std::size_t>(block.first) + i;
    const double strain = deformation[0] - section.y[at] * deformation[1] + section.z[at] * deformation[2];
    Quiet<Law> kept{};
    for (std::size_t k = 0; k < quiet_components<Law>; ++k) reinterpret_cast<double*>(&kept)[k] = history[k * count + i];
    const History opened = law.opened(strain, kept);
    for (std::size_t k = 0; k < components; ++k) history[k * count + i] = reinterpret_cast<const double*>(&opened)[k];
  }
}

}  // namespace

bool can_be_quiet(const FiberSection& section) {
  return std::all_of(section.blocks.begin(), section.blocks.end(), [](const FiberBlock& block) { return block.quiet_limit > 0; });
}

double quiet_limit(const UniaxialLaw& law, double error) {
  return std::visit(
      [error](const auto& l) {
        if constexpr (Screened<std::decay_t<decltype(l)>>) return l.quiet_limit(error);
        return 0.0;
      },
      law);
}

void copy_quiet(const FiberSection& section, const double* from, double* to) {
  for (const FiberBlock& block : section.blocks) {
    std::visit(
        [&](const auto& law) {
          using Law = std::decay_t<decltype(law)>;
          if constexpr (Screened<Law>) {
            std::copy_n(from + block.history_begin, quiet_components<Law> * static_cast<std::size_t>(block.count), to + block.history_begin);
          }
        },
        block.law);
  }
}

void begin_quiet(const Vector3& deformation, double name, double reach, double* history) {
  begin_note(head_of(history), name, deformation.data(), reach);
}

void start_quiet(const FiberSection& section, double* history) {
  std::fill_n(history, section.history_size, 0.0);
  head_of(history).quiet = 1;
}

void open_history(const FiberSection& section, const double* quiet, double* history) {
  const QuietPath path = noted_path(head_of(quiet));
  double reach = 0;
  follow_path(section, path, quiet, history, reach);  // stays on the line: it has been there
  const Vector3 deformation(path.deformation[path.steps]);
  std::fill_n(history, section_head, 0.0);
  for (const FiberBlock& block : section.blocks) {
    std::visit(
        [&](const auto& law) {
          if constexpr (Screened<std::decay_t<decltype(law)>>) {
            open_block(law, section, block, deformation, history + block.history_begin);
          }
        },
        block.law);
  }
}

bool stay_quiet(const FiberSection& section, const Vector3& deformation, const double* committed, double* trial) {
  const QuietHead& now = head_of(committed);
  QuietHead& next = head_of(trial);
  const double reach = now.reach - (std::abs(deformation[0] - now.last[0]) + section.largest_y * std::abs(deformation[1] - now.last[1]) +
                                    section.largest_z * std::abs(deformation[2] - now.last[2]));
  if (reach > 0 && now.pending() < pending_deformations) {
    note(now, next, deformation.data(), reach, [&] { copy_quiet(section, committed, trial); });
    return true;
  }
  QuietPath path = noted_path(now);
  std::copy_n(deformation.data(), 3, path.deformation[++path.steps]);
  double left = 0;
  next.quiet = 0;
  if (!follow_path(section, path, committed, trial, left)) return false;
  begin_note(next, name_after(now.path, deformation.data(), 3), deformation.data(), left);
  return true;
}

}  // namespace nsframe
