// The number types that uniaxial laws are written for: double, and Lanes (one SIMD register of doubles, Highway).
// Both know + - * /, comparisons, abs, min, max, exp, select(mask, a, b), mul_add, powers of positive bases, and of
// masks both, either, except (the first and not the second), all.
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
// a b + c, in one rounding where the machine can.
inline double mul_add(double a, double b, double c) { return a * b + c; }
// x^p for x >= 0.
inline double pow(double x, double p) { return std::pow(x, p); }
// (1 + x)^-p for x >= 0 and p of the order of 1.
inline double one_plus_pow(double x, double p) { return std::pow(1 + x, -p); }
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
  static constexpr int width() { return static_cast<int>(hn::MaxLanes(LaneTag())); }
  double sum() const { return hn::GetLane(hn::SumOfLanes(LaneTag(), lanes)); }
  double least() const { return hn::GetLane(hn::MinOfLanes(LaneTag(), lanes)); }
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
inline Lanes mul_add(Lanes a, Lanes b, Lanes c) { return hn::MulAdd(a.lanes, b.lanes, c.lanes); }

// Logarithm to base 2 of x in [2^-1022, 2^1023], within 2 epsilon (|result| + 1); 0 counts as 2^-1023. With x = 2^k m,
// m in [sqrt(1/2), sqrt(2)], s = (m - 1)/(m + 1): k + 2 artanh(s)/ln 2, a polynomial in s^2 of relative error 1e-18.
inline Lanes log2(Lanes x) {
  const LaneTag tag;
  const hn::RebindToUnsigned<LaneTag> integers;
  const auto bits = hn::BitCast(integers, x.lanes);
  // adding the distance from sqrt(1/2) to 1 carries into the exponent where m is to be halved
  const auto biased = hn::ShiftRight<52>(hn::Add(bits, hn::Set(integers, 0x00095F619980C433ULL)));
  const auto mantissa = hn::Sub(bits, hn::Sub(hn::ShiftLeft<52>(biased), hn::Set(integers, 0x3FF0000000000000ULL)));
  const Lanes m(hn::BitCast(tag, mantissa));
  // 2^52 + exponent as bits of a double, less 2^52: exact, and available on every instruction set
  const Lanes k(hn::Sub(hn::BitCast(tag, hn::Or(biased, hn::Set(integers, 0x4330000000000000ULL))),
                        hn::Set(tag, 4503599627370496.0 + 1023.0)));
  const Lanes s = (m - Lanes(1.0)) / (m + Lanes(1.0)), z = s * s, z2 = z * z, z4 = z2 * z2;
  const Lanes low = mul_add(mul_add(0.41219858585246444, z, 0.5770780163454643), z2, mul_add(0.9617966939259899, z, 2.8853900817779268));
  const Lanes high = mul_add(mul_add(0.21367305007447, z, 0.22091164958661377), z2, mul_add(0.26233440986463025, z, 0.3205985337770434));
  return mul_add(s, mul_add(high, z4, low), k);
}

// 2^x, within 2 epsilon, for x in [-1020, 1020]; beyond, the value there. With x = n + f, |f| <= 1/2:
// 2^n (1 + f q(f)), a polynomial of relative error 3e-18.
inline Lanes exp2(Lanes x) {
  const LaneTag tag;
  const hn::RebindToUnsigned<LaneTag> integers;
  const auto held = hn::Min(hn::Max(x.lanes, hn::Set(tag, -1020.0)), hn::Set(tag, 1020.0));
  const auto rounder = hn::Set(tag, 6755399441055744.0);  // 1.5 2^52: the sum ends in the bits of the nearest integer
  const auto rounded = hn::Add(held, rounder);
  const Lanes f(hn::Sub(held, hn::Sub(rounded, rounder))), f2 = f * f, f4 = f2 * f2;
  const Lanes low = mul_add(mul_add(0.00961812910759412, f, 0.055504108664820084), f2, mul_add(0.2402265069591013, f, 0.6931471805599453));
  const Lanes middle = mul_add(mul_add(1.32154352822259e-06, f, 1.525273349311071e-05), f2, mul_add(0.00015403530457112156, f, 0.001333355814677463));
  const Lanes high = mul_add(4.434769940546444e-10, f2, mul_add(7.073783271975683e-09, f, 1.017819958037045e-07));
  const Lanes power = mul_add(f, mul_add(mul_add(high, f4, middle), f4, low), 1.0);
  return hn::BitCast(tag, hn::Add(hn::BitCast(integers, power.lanes), hn::ShiftLeft<52>(hn::BitCast(integers, rounded))));
}

// Carries the rounding of p log2(x), about |p log(x)| epsilons. 0 and -0 count as 2^-1023.
inline Lanes pow(Lanes x, Lanes p) { return exp2(p * log2(abs(x))); }

inline Lanes log2_bound(Lanes x) {
  const hn::RebindToUnsigned<LaneTag> bits;
  const hn::RebindToSigned<LaneTag> integers;
  const auto exponent = hn::BitCast(integers, hn::ShiftRight<52>(hn::BitCast(bits, x.lanes)));
  const auto magic = hn::Set(integers, 0x4330000000000000LL);
  const auto number = hn::BitCast(LaneTag(), hn::Or(exponent, magic));
  return hn::Sub(number, hn::Set(LaneTag(), 4503599627370496.0 + 1022.0));
}

// While all x are small, the binomial series to x^3: the next term is below p (p + 1) (p + 2) (p + 3)/24 2^-56.
inline Lanes one_plus_pow(Lanes x, Lanes p) {
  const Lanes one(1.0), p1 = p + one;
  if (all(x < Lanes(6.103515625e-05))) {  // 2^-14
    const Lanes third = p1 * (p1 + one) * Lanes(1.0 / 6);  // of x^3, over p
    return one - p * x * (one - x * (p1 * Lanes(0.5) - x * third));
  }
  return exp2(-p * log2(one + x));
}

}  // namespace HWY_NAMESPACE
}  // namespace nsframe
HWY_AFTER_NAMESPACE();

#endif
