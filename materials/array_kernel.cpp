// Uniaxial laws on arrays of points, compiled for every instruction set and chosen at run time (Highway). Wrapped laws
// run through it (wrapper.hpp); blocks of plain laws in fiber sections have their own kernel, which adds up as it goes.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "materials/array_kernel.cpp"
#include <hwy/foreach_target.h>
// after foreach_target.h, so that every instruction set gets its own laws
#include "materials/laws.hpp"
#include "materials/uniaxial.hpp"

HWY_BEFORE_NAMESPACE();
namespace nsframe {
namespace HWY_NAMESPACE {

constexpr std::size_t most_lanes = hn::MaxLanes(LaneTag());

// Lanes beyond the last point repeat it; their answers are dropped.
inline Lanes load_some(const double* from, int count, int width) {
  if (count == width) return Lanes::load(from);
  double full[most_lanes];
  for (int i = 0; i < width; ++i) full[i] = from[std::min(i, count - 1)];
  return Lanes::load(full);
}
inline void store_some(Lanes value, double* to, int count, int width) {
  if (count == width) return value.store(to);
  double full[most_lanes];
  value.store(full);
  std::copy_n(full, count, to);
}

template <PlainLaw Law>
HWY_NOINLINE void respond_plain(const Law& law, const PointArrays& p) {
  using History = typename Law::template History<Lanes>;
  constexpr int components = history_doubles<Law>;
  const int width = static_cast<int>(hn::Lanes(LaneTag()));
  for (int i = 0; i < p.count; i += width) {
    const int n = std::min(width, p.count - i);
    History before;
    auto* const from = reinterpret_cast<Lanes*>(&before);
    for (int k = 0; k < components; ++k) from[k] = load_some(p.committed + k * p.stride + i, n, width);
    const auto response = respond(law, load_some(p.strain + i, n, width), before);
    const auto* const to = reinterpret_cast<const Lanes*>(&response.history);
    for (int k = 0; k < components; ++k) store_some(to[k], p.trial + k * p.stride + i, n, width);
    store_some(response.stress, p.stress + i, n, width);
    store_some(response.tangent, p.tangent + i, n, width);
  }
}

void respond_target(const UniaxialLaw& law, const PointArrays& p);
inline void respond_inner(const WrappedLaw& law, const PointArrays& p) { respond_target(law.law, p); }

void respond_target(const UniaxialLaw& law, const PointArrays& all) {
  std::visit(
      [&](const auto& l) HWY_ATTR {
        if constexpr (PlainLaw<std::decay_t<decltype(l)>>) {
          respond_plain(l, all);
        } else {
          for (int i = 0; i < all.count; i += wrapped_points) {
            PointArrays some = all.point(i);
            some.count = std::min(wrapped_points, all.count - i);
            l.respond(some, respond_inner);
          }
        }
      },
      law);
}

}  // namespace HWY_NAMESPACE
}  // namespace nsframe
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nsframe {

HWY_EXPORT(respond_target);

void respond_points_simd(const UniaxialLaw& law, const PointArrays& points) {
  HWY_DYNAMIC_DISPATCH(respond_target)(law, points);
}

}  // namespace nsframe
#endif
