// The SIMD kernel of spectra, compiled for every instruction set and chosen at run time (Highway). Time is the inner
// loop, so that two vectors of oscillators and their peaks stay in registers.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "spectra/spectrum_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "spectra/oscillators.hpp"
#include "spectra/spectrum_kernel.hpp"

HWY_BEFORE_NAMESPACE();
namespace nsframe {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, block_periods / 2>;
using Vector = hn::Vec<Tag>;

// Oscillators of one vector, from place `first` of the block on.
class Lanes {
 public:
  HWY_INLINE Lanes(SpectrumBlock& block, std::size_t first)
      : first_(first),
        uu_(at(block.uu)),
        uv_(at(block.uv)),
        ua_(at(block.ua)),
        ub_(at(block.ub)),
        vu_(at(block.vu)),
        vv_(at(block.vv)),
        va_(at(block.va)),
        vb_(at(block.vb)),
        u_(at(block.u)),
        v_(at(block.v)),
        peak_(at(block.peak)),
        h_(hn::Set(Tag(), block.piece)) {}

  HWY_INLINE void store(SpectrumBlock& block) const {
    hn::Store(u_, Tag(), block.u + first_);
    hn::Store(v_, Tag(), block.v + first_);
    hn::Store(peak_, Tag(), block.peak + first_);
  }

  template <bool between>
  HWY_INLINE void advance(Vector a0, Vector a1, bool at_end) {
    const Vector u0 = u_, v0 = v_;
    u_ = hn::MulAdd(uv_, v0, hn::MulAdd(uu_, u0, hn::MulAdd(ua_, a0, hn::Mul(ub_, a1))));
    v_ = hn::MulAdd(vv_, v0, hn::MulAdd(vu_, u0, hn::MulAdd(va_, a0, hn::Mul(vb_, a1))));
    const Vector size = hn::Abs(u_);
    if (between || at_end) peak_ = hn::Max(peak_, size);
    if constexpr (!between) return;
    // a turning point between: nowhere further from both ends than the velocities reach
    const Vector reach = hn::MulAdd(h_, hn::Max(hn::Abs(v0), hn::Abs(v_)), hn::Max(hn::Abs(u0), size));
    const auto turns = hn::And(hn::Lt(hn::Mul(v0, v_), hn::Zero(Tag())), hn::Gt(reach, peak_));
    if (HWY_UNLIKELY(!hn::AllFalse(Tag(), turns))) turn(u0, v0, turns);
  }

 private:
  HWY_INLINE Vector at(const double* values) const { return hn::Load(Tag(), values + first_); }

  HWY_NOINLINE void turn(Vector u0, Vector v0, hn::Mask<Tag> turns) {
    constexpr std::size_t most = block_periods / 2;
    alignas(64) double from[most], slope[most], to[most], last[most], peak[most], marked[most];
    hn::Store(u0, Tag(), from);
    hn::Store(hn::Mul(h_, v0), Tag(), slope);
    hn::Store(u_, Tag(), to);
    hn::Store(hn::Mul(h_, v_), Tag(), last);
    hn::Store(peak_, Tag(), peak);
    hn::Store(hn::IfThenElseZero(turns, hn::Set(Tag(), 1.0)), Tag(), marked);
    for (std::size_t i = 0; i < hn::Lanes(Tag()); ++i)
      if (marked[i] != 0) peak[i] = std::max(peak[i], turning_point(from[i], slope[i], to[i], last[i]));
    peak_ = hn::Load(Tag(), peak);
  }

  std::size_t first_;
  Vector uu_, uv_, ua_, ub_, vu_, vv_, va_, vb_, u_, v_, peak_, h_;
};

template <bool between>
HWY_INLINE void run(SpectrumBlock& block, const double* acceleration, std::size_t count) {
  const std::size_t width = hn::Lanes(Tag());
  for (std::size_t first = 0; first < block_periods; first += 2 * width) {
    Lanes one(block, first), two(block, first + width);
    for (std::size_t i = 0; i + 1 < count; ++i) {
      const double start = acceleration[i], change = acceleration[i + 1] - start;
      for (int k = 0; k < block.pieces; ++k) {
        const Vector a0 = hn::Set(Tag(), start + k * change / block.pieces),
                     a1 = hn::Set(Tag(), start + (k + 1) * change / block.pieces);
        const bool at_end = k + 1 == block.pieces;
        one.template advance<between>(a0, a1, at_end);
        two.template advance<between>(a0, a1, at_end);
      }
    }
    one.store(block);
    two.store(block);
  }
}

void run_target(SpectrumBlock& block, const double* acceleration, std::size_t count, bool at_samples) {
  if (at_samples) {
    run<false>(block, acceleration, count);
  } else {
    run<true>(block, acceleration, count);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace nsframe
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nsframe {

HWY_EXPORT(run_target);

void run_block(SpectrumBlock& block, std::span<const double> acceleration, bool at_samples) {
  HWY_DYNAMIC_DISPATCH(run_target)(block, acceleration.data(), acceleration.size(), at_samples);
}

}  // namespace nsframe
#endif
