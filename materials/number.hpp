// The number types that uniaxial laws are written for: double, and Lanes (one SIMD register of doubles, Highway).
// Both know + - * /, comparisons, abs, min, max, exp, select(mask, a, b), pow for positive bases, and of masks
// both, either, except (the first and not the second), all.
#if defined(NSFRAME_MATERIALS_NUMBER_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef NSFRAME_MATERIALS_NUMBER_HPP
#undef NSFRAME_MATERIALS_NUMBER_HPP
#else
#define NSFRAME_MATERIALS_NUMBER_HPP
#endif

#include <hwy/highway.h>
// math-inl.h must follow highway.h
#include <hwy/contrib/math/math-inl.h>

#include <algorithm>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace nsframe {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

inline double abs(double x) { return std::abs(x); }
inline double min(double a, double b) { return std::min(a, b); }
inline double max(double a, double b) { return std::max(a, b); }
inline double select(bool mask, double a, double b) { return mask ? a : b; }
inline bool all(bool mask) { return mask; }
inline bool both(bool a, bool b) { return a && b; }
inline bool either(bool a, bool b) { return a || b; }
inline bool except(bool a, bool b) { return a && !b; }
inline double exp(double x) { return std::exp(x); }
// x^p for x >= 0.
inline double pow(double x, double p) { return std::pow(x, p); }
// A whole number above the logarithm of x >= 0 to base 2 (its exponent plus one), cheap.
inline double log2_bound(double x) { return x > 0 ? std::ilogb(x) + 1.0 : -1023.0; }

using LaneTag = hn::ScalableTag<double>;

struct LaneMask {
  hn::Mask<LaneTag> mask;
};

struct Lanes {
  hn::Vec<LaneTag> lanes;
  Lanes() : lanes(hn::Zero(LaneTag())) {}
  Lanes(double value) : lanes(hn::Set(LaneTag(), value)) {}  // NOLINT: a number converts to every number type
  Lanes(hn::Vec<LaneTag> value) : lanes(value) {}            // NOLINT
  static Lanes load(const double* from) { return hn::LoadU(LaneTag(), from); }
  void store(double* to) const { hn::StoreU(lanes, LaneTag(), to); }
  double sum() const { return hn::GetLane(hn::SumOfLanes(LaneTag(), lanes)); }
};

inline Lanes operator+(Lanes a, Lanes b) { return hn::Add(a.lanes, b.lanes); }
inline Lanes operator-(Lanes a, Lanes b) { return hn::Sub(a.lanes, b.lanes); }
inline Lanes operator*(Lanes a, Lanes b) { return hn::Mul(a.lanes, b.lanes); }
inline Lanes operator/(Lanes a, Lanes b) { return hn::Div(a.lanes, b.lanes); }
inline Lanes operator-(Lanes a) { return hn::Neg(a.lanes); }
inline LaneMask operator<(Lanes a, Lanes b) { return {hn::Lt(a.lanes, b.lanes)}; }
inline LaneMask operator>(Lanes a, Lanes b) { return {hn::Gt(a.lanes, b.lanes)}; }
inline LaneMask operator<=(Lanes a, Lanes b) { return {hn::Le(a.lanes, b.lanes)}; }
inline LaneMask operator>=(Lanes a, Lanes b) { return {hn::Ge(a.lanes, b.lanes)}; }
inline LaneMask operator==(Lanes a, Lanes b) { return {hn::Eq(a.lanes, b.lanes)}; }
inline LaneMask both(LaneMask a, LaneMask b) { return {hn::And(a.mask, b.mask)}; }
inline LaneMask either(LaneMask a, LaneMask b) { return {hn::Or(a.mask, b.mask)}; }
inline LaneMask except(LaneMask a, LaneMask b) { return {hn::AndNot(b.mask, a.mask)}; }
inline bool all(LaneMask a) { return hn::AllTrue(LaneTag(), a.mask); }
inline Lanes abs(Lanes a) { return hn::Abs(a.lanes); }
inline Lanes min(Lanes a, Lanes b) { return hn::Min(a.lanes, b.lanes); }
inline Lanes max(Lanes a, Lanes b) { return hn::Max(a.lanes, b.lanes); }
inline Lanes select(LaneMask mask, Lanes a, Lanes b) { return hn::IfThenElse(mask.mask, a.lanes, b.lanes); }
inline Lanes exp(Lanes a) { return hn::Exp(LaneTag(), a.lanes); }
// Below 1e-300 the base counts as 1e-300, so that the logarithm stays finite; the result underflows to zero.
inline Lanes pow(Lanes x, Lanes p) {
  const LaneTag tag;
  const auto logarithm = hn::Log(tag, hn::Max(x.lanes, hn::Set(tag, 1e-300)));
  return hn::Exp(tag, hn::Min(hn::Mul(p.lanes, logarithm), hn::Set(tag, 700.0)));
}

inline Lanes log2_bound(Lanes x) {
  const hn::RebindToUnsigned<LaneTag> bits;
  const hn::RebindToSigned<LaneTag> integers;
  const auto exponent = hn::BitCast(integers, hn::ShiftRight<52>(hn::BitCast(bits, x.lanes)));
  // 2^52 + exponent as bits of a double, less 2^52: exact, and available on every instruction set
  const auto magic = hn::Set(integers, 0x4330000000000000LL);
  const auto number = hn::BitCast(LaneTag(), hn::Or(exponent, magic));
  return hn::Sub(number, hn::Set(LaneTag(), 4503599627370496.0 + 1022.0));
}

}  // namespace HWY_NAMESPACE
}  // namespace nsframe
HWY_AFTER_NAMESPACE();

#endif
