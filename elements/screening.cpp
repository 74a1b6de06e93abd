#include "elements/screening.hpp"

#include <algorithm>

namespace nsframe {

namespace {

template <class Law>
concept Screened = requires(const Law& law) { law.quiet_limit(0.0); };

template <class Law>
using Quiet = typename Law::template QuietHistory<double>;

// An empty struct has the size of a char.
template <class Law>
constexpr std::size_t quiet_components = std::is_empty_v<Quiet<Law>> ? 0 : sizeof(Quiet<Law>) / sizeof(double);

template <class Law>
void open_block(const Law& law, const FiberSection& section, const FiberBlock& block, const Vector3& deformation,
                const double* quiet, double* history) {
  using History = typename Law::template History<double>;
  constexpr std::size_t components = sizeof(History) / sizeof(double);
  static_assert(quiet_components<Law> <= components);
  const auto count = static_cast<std::size_t>(block.count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = static_cast<std::size_t>(block.first) + i;
    const double strain = deformation[0] - section.y[at] * deformation[1] + section.z[at] * deformation[2];
    Quiet<Law> kept{};
    for (std::size_t k = 0; k < quiet_components<Law>; ++k) reinterpret_cast<double*>(&kept)[k] = quiet[k * count + i];
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

void start_quiet(const FiberSection& section, double* history) {
  std::fill_n(history, section.history_size, 0.0);
  history[0] = 1;
}

void open_history(const FiberSection& section, const double* quiet, double* history) {
  const Vector3 deformation(quiet[1], quiet[2], quiet[3]);
  std::fill_n(history, section_head, 0.0);
  for (const FiberBlock& block : section.blocks) {
    std::visit(
        [&](const auto& law) {
          if constexpr (Screened<std::decay_t<decltype(law)>>) {
            open_block(law, section, block, deformation, quiet + block.history_begin, history + block.history_begin);
          }
        },
        block.law);
  }
}

}  // namespace nsframe
