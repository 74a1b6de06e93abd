// The SIMD kernel of fiber sections, compiled for every instruction set and chosen at run time (Highway).
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "elements/fiber_kernel.cpp"
#include <hwy/foreach_target.h>
// after foreach_target.h, so that every instruction set gets its own laws
#include <utility>

#include "elements/screening.hpp"
#include "materials/laws.hpp"

HWY_BEFORE_NAMESPACE();
namespace nsframe {
namespace HWY_NAMESPACE {

// A law's history of Lanes is an array of Lanes, as law.hpp demands (members of type T only). Its members are reached
// by constant indices, not in a loop: the compiler then keeps them in registers.
template <class History>
using Components = std::make_index_sequence<sizeof(History) / sizeof(Lanes)>;

template <class History, std::size_t... k>
HWY_INLINE History load_history(const double* from, std::ptrdiff_t stride, std::index_sequence<k...>) {
  return {Lanes::load(from + static_cast<std::ptrdiff_t>(k) * stride)...};
}

template <class History, std::size_t... k>
HWY_INLINE void store_history(const History& history, double* to, std::ptrdiff_t stride, std::index_sequence<k...>) {
  (reinterpret_cast<const Lanes*>(&history)[k].store(to + static_cast<std::ptrdiff_t>(k) * stride), ...);
}

template <bool with_tangent, class Law>
HWY_NOINLINE void add_block(const Law& block_law, const FiberSection& section, const FiberBlock& block,
                            const Vector3& deformation, const double* committed, double* trial, SectionResponse& total) {
  using History = typename Law::template History<Lanes>;
  const Law law = block_law;  // a copy that no store can change: what follows from its parameters is computed once
  const Lanes e0(deformation[0]), kz(deformation[1]), ky(deformation[2]);
  Lanes n, mz, my, ea, eay, eaz, eayy, eazz, eayz;
  const std::ptrdiff_t width = static_cast<std::ptrdiff_t>(hn::Lanes(LaneTag())), count = block.count;
  const double* const ys = section.y.data() + block.first;
  const double* const zs = section.z.data() + block.first;
  const double* const areas = section.area.data() + block.first;
  for (std::ptrdiff_t i = 0; i < count; i += width) {
    const Lanes y = Lanes::load(ys + i), z = Lanes::load(zs + i), area = Lanes::load(areas + i);
    const History before = load_history<History>(committed + block.history_begin + i, count, Components<History>());
    const auto response = respond(law, e0 - y * kz + z * ky, before);
    store_history(response.history, trial + block.history_begin + i, count, Components<History>());
    const Lanes force = response.stress * area;
    n = n + force;
    mz = mul_add(force, y, mz);
    my = mul_add(force, z, my);
    if constexpr (!with_tangent) continue;
    const Lanes stiffness = response.tangent * area, stiffness_y = stiffness * y, stiffness_z = stiffness * z;
    ea = ea + stiffness;
    eay = eay + stiffness_y;
    eaz = eaz + stiffness_z;
    eayy = mul_add(stiffness_y, y, eayy);
    eazz = mul_add(stiffness_z, z, eazz);
    eayz = mul_add(stiffness_y, z, eayz);
  }
  total.force += Vector3(n.sum(), -mz.sum(), my.sum());
  if constexpr (!with_tangent) return;
  const double EA = ea.sum(), EAy = eay.sum(), EAz = eaz.sum(), EAyz = eayz.sum();
  Matrix3 tangent;
  tangent << EA, -EAy, EAz, -EAy, eayy.sum(), -EAyz, EAz, -EAyz, eazz.sum();
  total.tangent += tangent;
}

constexpr double farthest_reach = 1e300;

template <class QuietHistory>
using QuietComponents = std::make_index_sequence<std::is_empty_v<QuietHistory> ? 0 : sizeof(QuietHistory) / sizeof(Lanes)>;

// Brings the block's quiet histories along the path; false when a fiber leaves the line. Lowers `reach` to what is left to its fibers.
template <class Law>
HWY_NOINLINE bool follow_block(const Law& block_law, const FiberSection& section, const FiberBlock& block, const QuietPath& path,
                               const double* committed, double* trial, double& reach) {
  using QuietHistory = typename Law::template QuietHistory<Lanes>;
  const Law law = block_law;
  const std::ptrdiff_t width = static_cast<std::ptrdiff_t>(hn::Lanes(LaneTag())), count = block.count;
  Lanes least(reach);
  for (std::ptrdiff_t i = 0; i < count; i += width) {
    const Lanes y = Lanes::load(section.y.data() + block.first + i), z = Lanes::load(section.z.data() + block.first + i);
    const auto strain_at = [&](int step) HWY_ATTR {
      const double* const d = path.deformation[step];
      return Lanes(d[0]) - y * Lanes(d[1]) + z * Lanes(d[2]);
    };
    auto quiet = load_history<QuietHistory>(committed + block.history_begin + i, count, QuietComponents<QuietHistory>());
    Lanes strain = strain_at(0);
    for (int step = 1; step <= path.steps; ++step) {
      const Lanes before = strain;
      strain = strain_at(step);
      if (!all(stays_linear(law, block.quiet_limit, before, strain, quiet))) return false;
    }
    store_history(quiet, trial + block.history_begin + i, count, QuietComponents<QuietHistory>());
    least = min(least, linear_reach(law, block.quiet_limit, strain, quiet));
  }
  reach = least.least();
  return true;
}

bool follow_path_target(const FiberSection& section, const QuietPath& path, const double* committed, double* trial, double& reach) {
  bool quiet = true;
  reach = farthest_reach;
  for (const FiberBlock& block : section.blocks) {
    std::visit(
        [&](const auto& law) HWY_ATTR {
          if constexpr (Screened<std::decay_t<decltype(law)>>) {
            quiet = quiet && follow_block(law, section, block, path, committed, trial, reach);
          }
        },
        block.law);
  }
  reach = 0.99 * reach - 1e-15;  // sums of strains are rounded
  return quiet;
}

void respond_target(const FiberSection& section, const Vector3& deformation, const double* committed, double* trial,
                    bool with_tangent, SectionResponse& total) {
  for (const FiberBlock& block : section.blocks) {
    std::visit(
        [&](const auto& law) HWY_ATTR {
          if constexpr (!PlainLaw<std::decay_t<decltype(law)>>)
            add_wrapped_block(section, block, deformation, committed, trial, total);
          else if (with_tangent)
            add_block<true>(law, section, block, deformation, committed, trial, total);
          else
            add_block<false>(law, section, block, deformation, committed, trial, total);
        },
        block.law);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace nsframe
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nsframe {

HWY_EXPORT(respond_target);
HWY_EXPORT(follow_path_target);

bool follow_path(const FiberSection& section, const QuietPath& path, const double* committed, double* trial, double& reach) {
  return HWY_DYNAMIC_DISPATCH(follow_path_target)(section, path, committed, trial, reach);
}

SectionResponse respond(const FiberSection& section, const Vector3& deformation, const double* committed, double* trial,
                        bool with_tangent) {
  SectionResponse sum;
  if (is_quiet(committed)) {
    if (stay_quiet(section, deformation, committed, trial)) {
      sum.force.noalias() = section.virgin.tangent * deformation;
      sum.force += section.virgin.force;
      if (with_tangent) sum.tangent = section.virgin.tangent;
      return sum;
    }
    open_history(section, committed, trial);
    committed = trial;  // a fiber's history is read before it is written
  }
  trial[0] = 0;
  HWY_DYNAMIC_DISPATCH(respond_target)(section, deformation, committed, trial, with_tangent, sum);
  return sum;
}

}  // namespace nsframe
#endif
