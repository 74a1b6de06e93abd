// Trilinear backbone with pinching, damage and degrading unloading stiffness (OpenSees' Hysteretic).
//
// A branch runs from one side of the backbone (behind) to the other (ahead); it is written once, for increasing strain,
// and mirrored for decreasing strain. From a reversal the stress comes back to zero at e_z on the slope E1 k,
// k = min(1, (e_far/e1)^-beta) with e_far the largest strain of the side behind. Then it is zero up to e_r, and runs on
// two lines over the pinching point (e_p, pinchY s_t) to the target (e_t, s_t) on the backbone ahead, as long as the
// slope E1 k of that side isn't less. The target is the largest strain so far ahead, moved out at the reversal by
// 1 + damage1 (e_far/e1 - 1) + damage2 W/W_u, W the energy dissipated, W_u what the two backbones enclose.
#if defined(NSFRAME_MATERIALS_HYSTERETIC_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef NSFRAME_MATERIALS_HYSTERETIC_HPP
#undef NSFRAME_MATERIALS_HYSTERETIC_HPP
#else
#define NSFRAME_MATERIALS_HYSTERETIC_HPP
#endif

#include "materials/law.hpp"
#include "materials/number.hpp"

#ifndef NSFRAME_MATERIALS_HYSTERETIC_PARAMETERS
#define NSFRAME_MATERIALS_HYSTERETIC_PARAMETERS
namespace nsframe {

// One side of the backbone, signs so that it is the positive one.
struct HystereticSide {
  double s1, e1, s2, e2, s3, e3;  // [Pa], [-]
  double slope1() const { return s1 / e1; }
  double slope2() const { return (s2 - s1) / (e2 - e1); }
  double slope3() const { return (s3 - s2) / (e3 - e2); }
  double energy() const { return 0.5 * (e1 * s1 + (e2 - e1) * (s1 + s2) + (e3 - e2) * (s2 + s3)); }
  double stress(double strain) const {
    if (strain <= e1) return slope1() * strain;
    if (strain <= e2) return s1 + slope2() * (strain - e1);
    return strain <= e3 || slope3() > 0 ? s2 + slope3() * (strain - e2) : s3;
  }
  // Where a falling branch of the backbone has lost all strength: such a side, driven beyond, reloads from there.
  double exhausted(double crossing) const {
    return stress(crossing) <= 1e-12 * s1 ? crossing : std::numeric_limits<double>::infinity();
  }
  double exhausted2() const {
    return slope2() < 0 ? exhausted(e1 - s1 / slope2()) : std::numeric_limits<double>::infinity();
  }
  double exhausted3() const {
    return slope3() < 0 ? exhausted(e2 - s2 / slope3()) : std::numeric_limits<double>::infinity();
  }
};

struct Hysteretic {
  static constexpr const char* name = "Hysteretic";
  double s1p = 0, e1p = 0;         // first point of the backbone in tension [Pa], [-]
  double s2p = 0, e2p = 0;         // second
  std::optional<double> s3p = std::nullopt, e3p = std::nullopt;  // third; without it the second is the last
  double s1n = 0, e1n = 0;         // in compression, negative
  double s2n = 0, e2n = 0;
  std::optional<double> s3n = std::nullopt, e3n = std::nullopt;
  double pinchX = 1, pinchY = 1;  // [-]
  double damage1 = 0;             // by ductility [-]
  double damage2 = 0;             // by energy [-]
  double beta = 0;                // [-]

  template <class T>
  struct History {
    T strain;                  // [-]
    T stress;                  // [Pa]
    T largest, least;          // targets of the two sides; 0 before the side is entered
    T zero_above, zero_below;  // e_z of the last unloading from tension, from compression
    T energy;                  // W [J/m3]
    T direction;               // 0 before any strain, then +1 or -1
  };
  HystereticSide tension() const {
    if (e3p && s3p) return {s1p, e1p, s2p, e2p, *s3p, *e3p};
    return {s1p, e1p, 0.5 * (s1p + s2p), 0.5 * (e1p + e2p), s2p, e2p};
  }
  HystereticSide compression() const {
    if (e3n && s3n) return {-s1n, -e1n, -s2n, -e2n, -*s3n, -*e3n};
    return {-s1n, -e1n, -0.5 * (s1n + s2n), -0.5 * (e1n + e2n), -s2n, -e2n};
  }
  History<double> virgin() const { return {0, 0, 0, 0, 0, 0, 0, 0}; }
  double initial_tangent() const { return s1p / e1p; }
  double yield_strain() const { return std::min(e1p, -e1n); }
  void check() const {
    check_side(tension(), "p", "positive");
    check_side(compression(), "n", "negative");
    require(s3p.has_value() == e3p.has_value(), "s3p and e3p belong together");
    require(s3n.has_value() == e3n.has_value(), "s3n and e3n belong together");
  }
  template <class Visit, class Law>
  static void visit_parameters(Visit&& visit, Law& law) {
    using namespace parameter;
    visit(required(stress("s1p", "first point of the backbone in tension")), law.s1p);
    visit(required(strain("e1p", "its strain")), law.e1p);
    visit(required(stress("s2p", "second point of the backbone in tension")), law.s2p);
    visit(required(strain("e2p", "its strain")), law.e2p);
    visit(with_default(stress("s3p", "third point in tension"), "two points"), law.s3p);
    visit(with_default(strain("e3p", "its strain"), "two points"), law.e3p);
    visit(required(stress("s1n", "first point of the backbone in compression, negative")), law.s1n);
    visit(required(strain("e1n", "its strain")), law.e1n);
    visit(required(stress("s2n", "second point of the backbone in compression, negative")), law.s2n);
    visit(required(strain("e2n", "its strain")), law.e2n);
    visit(with_default(stress("s3n", "third point in compression, negative"), "two points"), law.s3n);
    visit(with_default(strain("e3n", "its strain"), "two points"), law.e3n);
    visit(number("pinchX", "where reloading is pinched, over its way; 1: no pinching", range::unit), law.pinchX);
    visit(number("pinchY", "stress there over the target's; 1: no pinching", range::unit), law.pinchY);
    visit(number("damage1", "damage by ductility", range::non_negative), law.damage1);
    visit(number("damage2", "damage by energy", range::non_negative), law.damage2);
    visit(number("beta", "power by which the unloading stiffness decays with ductility", range::non_negative),
          law.beta);
  }

 private:
  static void check_side(const HystereticSide& side, const std::string& end, const std::string& sign) {
    require(side.s1 > 0, "s1" + end + " must be " + sign);
    require(side.e1 > 0, "e1" + end + " must be " + sign);
    require(side.e2 > side.e1, "e2" + end + " must be farther out than e1" + end);
    require(side.e3 > side.e2, "e3" + end + " must be farther out than e2" + end);
    require(side.s2 > 0, "s2" + end + " must be " + sign);
    require(side.s3 >= 0, "s3" + end + " must not have the other sign");
  }
};

}  // namespace nsframe
#endif

HWY_BEFORE_NAMESPACE();
namespace nsframe {
namespace HWY_NAMESPACE {

template <class T>
struct HystereticSideOf {
  T s1, e1, s2, e2, s3, e3, slope1, slope2, slope3, exhausted2, exhausted3;

  Branch<T> backbone(T strain) const {
    const auto first = strain <= e1, second = strain <= e2;
    const auto third = either(strain <= e3, slope3 > T(0.0));
    const T beyond = select(third, s2 + slope3 * (strain - e2), s3);
    return {select(first, slope1 * strain, select(second, s1 + slope2 * (strain - e1), beyond)),
            select(first, slope1, select(second, slope2, select(third, slope3, T(0.0))))};
  }
  // min(1, (far/e1)^-beta) times the first slope
  T unloading(double beta, T far) const { return beta == 0 ? slope1 : slope1 * min(T(1.0), pow(far / e1, T(-beta))); }
  T exhausted(T far) const {
    const T never(std::numeric_limits<double>::infinity());
    return select(far <= e1, never, select(far <= e2, exhausted2, exhausted3));
  }
};

template <class T, class Mask>
HWY_INLINE HystereticSideOf<T> choose(Mask first, const HystereticSide& a, const HystereticSide& b) {
  const auto pick = [first](double x, double y) HWY_ATTR { return select(first, T(x), T(y)); };
  return {pick(a.s1, b.s1),
          pick(a.e1, b.e1),
          pick(a.s2, b.s2),
          pick(a.e2, b.e2),
          pick(a.s3, b.s3),
          pick(a.e3, b.e3),
          pick(a.slope1(), b.slope1()),
          pick(a.slope2(), b.slope2()),
          pick(a.slope3(), b.slope3()),
          pick(a.exhausted2(), b.exhausted2()),
          pick(a.exhausted3(), b.exhausted3())};
}

// Reloading ahead from zero stress at e_r to the target, over the pinching point; from (strain0, stress0), which may
// lie below these lines.
template <class T>
HWY_INLINE Branch<T> reload(const Hysteretic& law, T strain, T strain0, T stress0, T slope, T start, T target,
                            T target_stress) {
  const T x(law.pinchX), y(law.pinchY), one(1.0);
  const T elastic = target - (one - y) * target_stress / slope;
  const T pinching = start + x * (elastic - start);
  const auto early = strain < pinching, none = both(early, strain < start);
  const T line_slope =
      select(early, y * target_stress, (one - y) * target_stress) / select(early, pinching - start, target - pinching);
  const T line = select(early, (strain - start) * line_slope, y * target_stress + (strain - pinching) * line_slope);
  const T rise = stress0 + slope * (strain - strain0);
  // where the two meet, as at a zero increment, the lower one goes on
  const T gap = rise - line, meeting = T(1e-12) * (abs(stress0) + abs(line));
  const T lower = min(slope, line_slope);
  const T tangent = select(gap < -meeting, slope, select(gap > meeting, line_slope, lower));
  return {select(none, T(0.0), min(rise, line)), select(none, T(0.0), tangent)};
}

template <class T>
HWY_INLINE Response<T, Hysteretic> respond(const Hysteretic& law, T strain_given,
                                           const Hysteretic::History<T>& committed) {
  const HystereticSide tension = law.tension(), compression = law.compression();
  const T zero(0.0), one(1.0);
  const T increment = strain_given - committed.strain;
  const T way = select(increment > zero, one, select(increment < zero, -one, committed.direction));
  const auto up = way >= zero;
  const T sign = select(up, one, -one);
  // from here on the mirrored picture, in which the strain increases
  const HystereticSideOf<T> ahead = choose<T>(up, tension, compression), behind = choose<T>(up, compression, tension);
  const T strain = sign * strain_given, strain0 = sign * committed.strain, stress0 = sign * committed.stress;
  const T largest = select(up, committed.largest, -committed.least),
          far = select(up, -committed.least, committed.largest);

  const T slope = ahead.unloading(law.beta, largest), slope_behind = behind.unloading(law.beta, far);
  const auto turned = both(committed.direction * way < zero, stress0 <= zero);
  const T e_z =
      select(turned, strain0 - stress0 / slope_behind, select(up, committed.zero_below, -committed.zero_above));
  const T dissipated = committed.energy - T(0.5) * stress0 * stress0 / slope_behind;
  const T damage = T(law.damage2 / (tension.energy() + compression.energy())) * dissipated +
                   T(law.damage1) * (far / behind.e1 - one);
  // 1e16, as in OpenSees: damage multiplies the target at every reversal
  const T target =
      min(T(1e16), max(ahead.e1, select(both(turned, far > behind.e1), largest * (one + damage), largest)));

  const auto on_backbone = strain >= largest, unloading = strain < e_z;
  const Branch<T> backbone = ahead.backbone(strain);
  const T unloaded = stress0 + slope_behind * (strain - strain0);
  const auto unloaded_to_zero = unloaded >= zero;
  const Branch<T> reloading = reload(law, strain, strain0, stress0, slope, max(e_z, -behind.exhausted(far)), target,
                                     ahead.backbone(target).stress);
  T stress = select(unloading, min(unloaded, zero), reloading.stress);
  T tangent = select(unloading, select(unloaded_to_zero, zero, slope_behind), reloading.tangent);
  stress = select(on_backbone, backbone.stress, stress);
  tangent = select(on_backbone, backbone.tangent, tangent);

  const T new_target = select(on_backbone, strain, target);
  const T new_zero = select(on_backbone, select(up, committed.zero_below, -committed.zero_above), e_z);
  Hysteretic::History<T> h;
  h.strain = strain_given;
  h.stress = sign * stress;
  h.largest = select(up, new_target, committed.largest);
  h.least = select(up, committed.least, -new_target);
  h.zero_below = select(up, new_zero, committed.zero_below);
  h.zero_above = select(up, committed.zero_above, -new_zero);
  h.energy = committed.energy + T(0.5) * (stress0 + stress) * (strain - strain0);
  h.direction = way;
  return {h.stress, tangent, h};
}

}  // namespace HWY_NAMESPACE
}  // namespace nsframe
HWY_AFTER_NAMESPACE();

#endif
