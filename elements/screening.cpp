#include "elements/screening.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace nsframe {

namespace {

template <class Law>
using Quiet = typename Law::template QuietHistory<double>;

QuietHead& head_of(double* history) { return *reinterpret_cast<QuietHead*>(history); }
const QuietHead& head_of(const double* history) { return *reinterpret_cast<const QuietHead*>(history); }

QuietPath noted_path(const QuietHead& head) {
  QuietPath path;
  path.steps = static_cast<int>(head.pending);
  std::copy_n(head.deformation[0], 3 * (path.steps + 1), path.deformation[0]);
  return path;
}

// Blocks' histories follow from those before and the path: so does their stamp. 52 bits, exact in a double, never 0.
double stamp_after(double stamp, const QuietPath& path) {
  auto hash = std::bit_cast<std::uint64_t>(stamp);
  for (int i = 0; i < 3 * (path.steps + 1); ++i) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(path.deformation[i / 3][i % 3])) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 32;
  }
  return static_cast<double>(1 + (hash >> 12));
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

// What the blocks keep while they are quiet.
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
  const int noted = static_cast<int>(now.pending);
  const double* const last = now.deformation[noted];
  const double reach = now.reach - (std::abs(deformation[0] - last[0]) + section.largest_y * std::abs(deformation[1] - last[1]) +
                                    section.largest_z * std::abs(deformation[2] - last[2]));
  if (reach > 0 && noted < pending_deformations) {
    if (next.quiet == 0 || next.stamp != now.stamp) copy_quiet(section, committed, trial);
    std::copy_n(committed, 4 + 3 * (noted + 1), trial);
    next.pending = noted + 1;
    next.reach = reach;
    std::copy_n(deformation.data(), 3, next.deformation[noted + 1]);
    return true;
  }
  QuietPath path = noted_path(now);
  std::copy_n(deformation.data(), 3, path.deformation[++path.steps]);
  const double stamp = stamp_after(now.stamp, path);
  double left = 0;
  next.quiet = 0;
  if (!follow_path(section, path, committed, trial, left)) return false;
  next.quiet = 1;
  next.stamp = stamp;
  next.pending = 0;
  next.reach = left;
  std::copy_n(deformation.data(), 3, next.deformation[0]);
  return true;
}

}  // namespace nsframe
