// The SIMD kernel of fiber sections, compiled for every instruction set and chosen at run time (Highway).
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "elements/fiber_kernel.cpp"
#include <hwy/foreach_target.h>
// after foreach_target.h, so that every instruction set gets its own laws
#include "elements/fiber_section.hpp"
#include "materials/laws.hpp"

HWY_BEFORE_NAMESPACE();
namespace nsframe {
namespace HWY_NAMESPACE {

// A law's history of Lanes is an array of Lanes, as law.hpp demands (members of type T only).
template <class History>
constexpr int components = static_cast<int>(sizeof(History) / sizeof(Lanes));

template <class Law>
HWY_NOINLINE void add_block(const Law& law, const FiberSection& section, const FiberBlock& block, const Vector3& deformation,
               const double* committed, double* trial, SectionResponse& sum) {
  using History = typename Law::template History<Lanes>;
  const Lanes e0(deformation[0]), kz(deformation[1]), ky(deformation[2]);
  Lanes n, mz, my, ea, eay, eaz, eayy, eazz, eayz;
  const int width = static_cast<int>(hn::Lanes(LaneTag()));
  for (int i = 0; i < block.count; i += width) {
    const auto at = static_cast<std::size_t>(block.first + i);
    const Lanes y = Lanes::load(&section.y[at]), z = Lanes::load(&section.z[at]), area = Lanes::load(&section.area[at]);
    History before;
    auto* const before_components = reinterpret_cast<Lanes*>(&before);
    const double* const from = committed + block.history_begin + i;
    for (int k = 0; k < components<History>; ++k) before_components[k] = Lanes::load(from + k * block.count);
    const auto response = respond(law, e0 - y * kz + z * ky, before);
    const auto* const after = reinterpret_cast<const Lanes*>(&response.history);
    double* const to = trial + block.history_begin + i;
    for (int k = 0; k < components<History>; ++k) after[k].store(to + k * block.count);
    const Lanes force = response.stress * area, stiffness = response.tangent * area;
    const Lanes stiffness_y = stiffness * y, stiffness_z = stiffness * z;
    n = n + force;
    mz = mz + force * y;
    my = my + force * z;
    ea = ea + stiffness;
    eay = eay + stiffness_y;
    eaz = eaz + stiffness_z;
    eayy = eayy + stiffness_y * y;
    eazz = eazz + stiffness_z * z;
    eayz = eayz + stiffness_y * z;
  }
  sum.force += Vector3(n.sum(), -mz.sum(), my.sum());
  Matrix3 tangent;
  tangent << ea.sum(), -eay.sum(), eaz.sum(), -eay.sum(), eayy.sum(), -eayz.sum(), eaz.sum(), -eayz.sum(), eazz.sum();
  sum.tangent += tangent;
}

void respond_target(const FiberSection& section, const Vector3& deformation, const double* committed, double* trial,
                    SectionResponse& sum) {
  for (const FiberBlock& block : section.blocks) {
    std::visit(
        [&](const auto& law) HWY_ATTR {
          if constexpr (PlainLaw<std::decay_t<decltype(law)>>)
            add_block(law, section, block, deformation, committed, trial, sum);
          else
            add_wrapped_block(section, block, deformation, committed, trial, sum);
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

SectionResponse respond(const FiberSection& section, const Vector3& deformation, const double* committed,
                        double* trial) {
  SectionResponse sum;
  HWY_DYNAMIC_DISPATCH(respond_target)(section, deformation, committed, trial, sum);
  return sum;
}

}  // namespace nsframe
#endif
