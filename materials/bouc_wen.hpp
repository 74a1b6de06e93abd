// Bouc-Wen hysteresis with degradation (Baber and Noori 1985; time discretisation of Haukaas and Der Kiureghian 2003;
// OpenSees' BoucWen): stress = alpha ko e + (1 - alpha) ko z,
//   dz/de = (A - |z|^n (gamma + beta sgn(z de)) nu) / eta,
//   A = Ao - deltaA w, nu = 1 + deltaNu w, eta = 1 + deltaEta w,  dw = (1 - alpha) ko z de,
// by one step of backward Euler from the committed state: stresses depend (to first order) on the size of the step.
#if defined(NSFRAME_MATERIALS_BOUC_WEN_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef NSFRAME_MATERIALS_BOUC_WEN_HPP
#undef NSFRAME_MATERIALS_BOUC_WEN_HPP
#else
#define NSFRAME_MATERIALS_BOUC_WEN_HPP
#endif

#include "materials/law.hpp"
#include "materials/number.hpp"

#ifndef NSFRAME_MATERIALS_BOUC_WEN_PARAMETERS
#define NSFRAME_MATERIALS_BOUC_WEN_PARAMETERS
namespace nsframe {

struct BoucWen {
  static constexpr const char* name = "BoucWen";
  double alpha = 0;     // post-yield over initial stiffness [-]
  double ko = 0;        // initial stiffness where Ao = 1 [Pa]
  double n = 1;         // sharpness of the yielding, at least 1 [-]
  double gamma = 0;     // [-], where n = 1 (1/strain^n)
  double beta = 0;      // [-]
  double Ao = 1;        // [-]
  double deltaA = 0;    // decay of A with the energy w [m3/J]
  double deltaNu = 0;   // growth of nu, strength degradation [m3/J]
  double deltaEta = 0;  // growth of eta, stiffness degradation [m3/J]

  template <class T>
  struct History {
    T strain;  // [-]
    T z;       // [-]
    T energy;  // w [J/m3]
  };
  History<double> virgin() const { return {0, 0, 0}; }
  double initial_tangent() const { return alpha * ko + (1 - alpha) * ko * Ao; }
  // Where the initial tangent meets the largest z; infinity where nothing limits z.
  double yield_strain() const {
    return beta + gamma > 0 ? std::pow(Ao / (beta + gamma), 1 / n) / Ao : std::numeric_limits<double>::infinity();
  }
  void check() const { require(beta + gamma >= 0, "gamma must be at least -beta: z would grow without bound"); }
  template <class Visit, class Law>
  static void visit_parameters(Visit&& visit, Law& law) {
    using namespace parameter;
    visit(required(number("alpha", "post-yield over initial stiffness", {0, 1, false, true})), law.alpha);
    visit(required(stress("ko", "initial stiffness", range::positive)), law.ko);
    visit(required(number("n", "sharpness of the yielding", range::at_least_one)), law.n);
    visit(required(number("gamma", "shape of the loop")), law.gamma);
    visit(required(number("beta", "shape of the loop", range::non_negative)), law.beta);
    visit(number("Ao", "initial slope of z", range::positive), law.Ao);
    visit(number("deltaA", "decay of the slope with energy", range::non_negative), law.deltaA);
    visit(number("deltaNu", "loss of strength with energy", range::non_negative), law.deltaNu);
    visit(number("deltaEta", "loss of stiffness with energy", range::non_negative), law.deltaEta);
  }
};

}  // namespace nsframe
#endif

HWY_BEFORE_NAMESPACE();
namespace nsframe {
namespace HWY_NAMESPACE {

// The equation of the step, mirrored so that the strain grows by increment >= 0; its zero is the new z.
template <class T>
struct BoucWenStep {
  const BoucWen& law;
  T z0, energy0, increment;

  struct Value {
    T residual, slope;       // of the equation by z
    T rate, rate_by_energy;  // dz/de; its derivative by w
  };
  HWY_INLINE Value at(T z) const {
    const T one(1.0), zero(0.0), size = abs(z);
    const T work = T((1 - law.alpha) * law.ko) * increment;  // derivative of w by z
    const T energy = energy0 + work * z;
    const T A = T(law.Ao) - T(law.deltaA) * energy, nu = one + T(law.deltaNu) * energy;
    const T inverse_eta = one / (one + T(law.deltaEta) * energy);
    const T opposing = select(z >= zero, T(law.gamma + law.beta), T(law.gamma - law.beta));
    const T power = law.n == 1 ? one : law.n == 2 ? size : pow(size, T(law.n - 1));
    const T limit = power * size * opposing;
    const T rate = (A - limit * nu) * inverse_eta;
    const T rate_by_energy = (T(-law.deltaA) - limit * T(law.deltaNu) - rate * T(law.deltaEta)) * inverse_eta;
    const T by_size = T(law.n) * power * opposing * nu * inverse_eta;
    const T rate_by_z = work * rate_by_energy - select(z >= zero, by_size, -by_size);
    return {z - z0 - increment * rate, one - increment * rate_by_z, rate, rate_by_energy};
  }
};

// Newton's method kept in a bracket, which is halved where Newton leaves it.
template <class T>
HWY_INLINE T solve(const BoucWenStep<T>& step) {
  const T zero(0.0), half(0.5), two(2.0);
  const auto start = step.at(step.z0);
  const T direction = select(start.residual <= zero, T(1.0), T(-1.0));
  // the residual has the other sign far enough away: its z grows without bound against the rate
  T width = abs(start.residual) * T(1.0 + 1e-9) + T(1e-300), near = step.z0, far = near + direction * width;
  for (int i = 0; i < 60; ++i) {
    const T excess = direction * step.at(far).residual;
    if (all(excess >= zero)) break;
    const auto inside = excess < zero;
    near = select(inside, far, near);
    width = width * two;
    far = select(inside, far + direction * width, far);
  }
  T z = far;
  for (int i = 0; i < 100; ++i) {
    const auto value = step.at(z);
    const auto beyond = direction * value.residual >= zero;
    far = select(beyond, z, far);
    near = select(beyond, near, z);
    const T newton = z - value.residual / value.slope;
    const auto bracketed = both(direction * (newton - near) >= zero, direction * (far - newton) >= zero);
    const T next = select(bracketed, newton, half * (near + far));
    const T change = abs(next - z);
    z = next;
    if (all(change <= T(4e-16) * abs(z))) break;
  }
  return z;
}

template <class T>
HWY_INLINE Response<T, BoucWen> respond(const BoucWen& law, T strain, const BoucWen::History<T>& committed) {
  const T zero(0.0), one(1.0), hysteretic((1 - law.alpha) * law.ko);
  const T increment = strain - committed.strain;
  const T sign = select(increment >= zero, one, -one);
  const BoucWenStep<T> step{law, sign * committed.z, committed.energy, abs(increment)};
  const T z = solve(step);
  const auto value = step.at(z);
  // z - z0 - increment rate(z, w0 + hysteretic increment z) = 0, differentiated by the increment
  const T z_by_strain = (value.rate + step.increment * value.rate_by_energy * hysteretic * z) / value.slope;
  const T energy = committed.energy + hysteretic * step.increment * z;
  return {T(law.alpha * law.ko) * strain + hysteretic * sign * z,
          T(law.alpha * law.ko) + hysteretic * z_by_strain,
          {strain, sign * z, energy}};
}

}  // namespace HWY_NAMESPACE
}  // namespace nsframe
HWY_AFTER_NAMESPACE();

#endif
