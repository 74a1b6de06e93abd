#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "integrators/exact_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include <hwy/contrib/math/math-inl.h>

#include "integrators/exact_kernel.hpp"

HWY_BEFORE_NAMESPACE();
namespace nsframe {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void propagate_target(int padded, double s, const double* square, const double* decay, const double* damped, const double* x, const double* y,
                      const double* f0, const double* f1, double* x_after, double* y_after) {
  const hn::ScalableTag<double> tag;
  const auto width = static_cast<int>(hn::Lanes(tag));
  const auto time = hn::Set(tag, s), one = hn::Set(tag, 1.0);
  for (int i = 0; i < padded; i += width) {
    const auto w2 = hn::LoadU(tag, square + i), a = hn::LoadU(tag, decay + i), wd = hn::LoadU(tag, damped + i);
    const auto x0 = hn::LoadU(tag, x + i), y0 = hn::LoadU(tag, y + i), p = hn::LoadU(tag, f0 + i), q = hn::LoadU(tag, f1 + i);
    const auto angle = hn::Mul(wd, time), fade = hn::Exp(tag, hn::Neg(hn::Mul(a, time)));
    const auto B = hn::Div(hn::Mul(fade, hn::Sin(tag, angle)), wd);
    const auto A = hn::MulAdd(a, B, hn::Mul(fade, hn::Cos(tag, angle)));
    const auto B2 = hn::Mul(hn::Add(a, a), B);
    const auto L = hn::Div(hn::Sub(one, A), w2);
    const auto R = hn::Div(hn::Sub(hn::Sub(time, B), hn::Mul(hn::Add(a, a), L)), w2);
    hn::StoreU(hn::MulAdd(A, x0, hn::MulAdd(B, y0, hn::MulAdd(L, p, hn::Mul(R, q)))), tag, x_after + i);
    hn::StoreU(hn::MulAdd(hn::Sub(A, B2), y0, hn::MulAdd(B, hn::Sub(p, hn::Mul(w2, x0)), hn::Mul(L, q))), tag, y_after + i);
  }
}

// What the passes over all modes do with one register of them.
template <class D>
struct Modes {
  using V = hn::Vec<D>;
  D tag;
  V zero = hn::Zero(tag);
  V work = zero, strain = zero, kinetic = zero, energy = zero, square = zero;

  V load(const double* array, int i) const { return hn::LoadU(tag, array + i); }

  void step(int i, const StepArrays& c, V x, V y, V p, V q, V& x_after, V& y_after) const {
    const V x_low = hn::MulAdd(load(c.xx_low, i), x, hn::Mul(load(c.xy_low, i), y));
    const V y_low = hn::MulAdd(load(c.yx_low, i), x, hn::Mul(load(c.yy_low, i), y));
    const V x_load = hn::MulAdd(load(c.x0, i), p, hn::MulAdd(load(c.x1, i), q, x_low));
    const V y_load = hn::MulAdd(load(c.y0, i), p, hn::MulAdd(load(c.y1, i), q, y_low));
    x_after = hn::MulAdd(load(c.xx, i), x, hn::MulAdd(load(c.xy, i), y, x_load));
    y_after = hn::MulAdd(load(c.yx, i), x, hn::MulAdd(load(c.yy, i), y, y_load));
  }

  // Of a flight of `time` under the loads f0, f1, the work of their parts p, q.
  void add_energy(V time, V w2, V a, V flexibility, V f0, V f1, V p, V q, V x, V y, V x_after, V y_after) {
    const V dx = hn::Sub(x_after, x), dy = hn::Sub(y_after, y);
    // int f y dt = [f x] - f1 int x dt, and int x dt from the equation of motion
    const V change = hn::MulAdd(hn::Add(a, a), dx, dy), half_time = hn::Mul(hn::Set(tag, 0.5), time);
    const V integral = hn::Mul(hn::MulSub(time, hn::MulAdd(half_time, f1, f0), change), flexibility);
    work = hn::MulAdd(p, dx, hn::MulAdd(q, hn::MulSub(time, x_after, integral), work));
    strain = hn::MulAdd(w2, hn::Mul(dx, hn::Add(x_after, x)), strain);
    kinetic = hn::MulAdd(dy, hn::Add(y_after, y), kinetic);
  }

  void add_size(V w2, V a, V flexibility, V raised, V f0, V f1, V x, V y) {
    const V slope = hn::Mul(f1, flexibility);
    const V u = hn::Sub(x, hn::Mul(hn::NegMulAdd(hn::Add(a, a), slope, f0), flexibility));
    const V v = hn::MulAdd(a, u, hn::Sub(y, slope));
    energy = hn::MulAdd(hn::Mul(w2, u), u, hn::MulAdd(hn::Mul(raised, v), v, energy));
    square = hn::MulAdd(x, x, square);
  }

  double sum(V v) const { return hn::GetLane(hn::SumOfLanes(tag, v)); }
  FlightEnergy flight_energy() const { return {sum(work), 0.5 * sum(strain), 0.5 * sum(kinetic)}; }
  ModalSize size() const { return {sum(energy), sum(square)}; }
};

void step_target(int padded, const StepArrays& c, const double* x, const double* y, const double* f0, const double* f1, double* x_after,
                 double* y_after) {
  const hn::ScalableTag<double> tag;
  const Modes<decltype(tag)> modes{tag};
  for (int i = 0; i < padded; i += static_cast<int>(hn::Lanes(tag))) {
    hn::Vec<decltype(tag)> x2, y2;
    modes.step(i, c, modes.load(x, i), modes.load(y, i), modes.load(f0, i), modes.load(f1, i), x2, y2);
    hn::StoreU(x2, tag, x_after + i);
    hn::StoreU(y2, tag, y_after + i);
  }
}

FlightEnergy energy_target(int padded, double s, const FlightArrays& m, const double* load0, const double* load1) {
  const hn::ScalableTag<double> tag;
  Modes<decltype(tag)> modes{tag};
  const auto time = hn::Set(tag, s);
  for (int i = 0; i < padded; i += static_cast<int>(hn::Lanes(tag))) {
    const auto load = [&](const double* array) { return modes.load(array, i); };
    modes.add_energy(time, load(m.square), load(m.decay), load(m.flexibility), load(m.f0), load(m.f1), load(load0), load(load1), load(m.x), load(m.y),
                     load(m.x_after), load(m.y_after));
  }
  return modes.flight_energy();
}

ModalSize size_target(int padded, const FlightArrays& m, const double* raised) {
  const hn::ScalableTag<double> tag;
  Modes<decltype(tag)> modes{tag};
  for (int i = 0; i < padded; i += static_cast<int>(hn::Lanes(tag))) {
    const auto load = [&](const double* array) { return modes.load(array, i); };
    modes.add_size(load(m.square), load(m.decay), load(m.flexibility), load(raised), load(m.f0), load(m.f1), load(m.x), load(m.y));
  }
  return modes.size();
}

FlightSums step_and_sum_target(int padded, double s, const StepArrays& step, const FlightArrays& m, const double* raised, double* x_after,
                               double* y_after) {
  const hn::ScalableTag<double> tag;
  Modes<decltype(tag)> modes{tag};
  const auto time = hn::Set(tag, s);
  for (int i = 0; i < padded; i += static_cast<int>(hn::Lanes(tag))) {
    const auto load = [&](const double* array) { return modes.load(array, i); };
    const auto w2 = load(m.square), a = load(m.decay), flexibility = load(m.flexibility), f0 = load(m.f0), f1 = load(m.f1), x = load(m.x), y = load(m.y);
    hn::Vec<decltype(tag)> x2, y2;
    modes.step(i, step, x, y, f0, f1, x2, y2);
    hn::StoreU(x2, tag, x_after + i);
    hn::StoreU(y2, tag, y_after + i);
    modes.add_energy(time, w2, a, flexibility, f0, f1, f0, f1, x, y, x2, y2);
    modes.add_size(w2, a, flexibility, load(raised), f0, f1, x, y);
  }
  return {modes.flight_energy(), modes.size()};
}

void gaps_target(int padded, int pairs, const double* G, const double* x, const double* y, double* gap, double* rate) {
  const hn::ScalableTag<double> tag;
  const auto width = static_cast<int>(hn::Lanes(tag));
  for (int c = 0; c < pairs; ++c) {
    const double* const row = G + static_cast<long>(c) * padded;
    auto sum = hn::Zero(tag), rates = hn::Zero(tag);
    for (int i = 0; i < padded; i += width) {
      const auto factor = hn::LoadU(tag, row + i);
      sum = hn::MulAdd(factor, hn::LoadU(tag, x + i), sum);
      rates = hn::MulAdd(factor, hn::LoadU(tag, y + i), rates);
    }
    gap[c] = hn::GetLane(hn::SumOfLanes(tag, sum));
    rate[c] = hn::GetLane(hn::SumOfLanes(tag, rates));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace nsframe
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nsframe {

HWY_EXPORT(propagate_target);
HWY_EXPORT(step_target);
HWY_EXPORT(energy_target);
HWY_EXPORT(size_target);
HWY_EXPORT(step_and_sum_target);
HWY_EXPORT(gaps_target);

void propagate_oscillators(int padded, double s, const double* square, const double* decay, const double* damped, const double* x,
                           const double* y, const double* f0, const double* f1, double* x_after, double* y_after) {
  HWY_DYNAMIC_DISPATCH(propagate_target)(padded, s, square, decay, damped, x, y, f0, f1, x_after, y_after);
}

void apply_step(int padded, const StepArrays& step, const double* x, const double* y, const double* f0, const double* f1, double* x_after,
                double* y_after) {
  HWY_DYNAMIC_DISPATCH(step_target)(padded, step, x, y, f0, f1, x_after, y_after);
}

FlightEnergy sum_energy(int padded, double s, const FlightArrays& flight, const double* load0, const double* load1) {
  return HWY_DYNAMIC_DISPATCH(energy_target)(padded, s, flight, load0, load1);
}

ModalSize modal_size(int padded, const FlightArrays& flight, const double* raised) {
  return HWY_DYNAMIC_DISPATCH(size_target)(padded, flight, raised);
}

FlightSums step_and_sum(int padded, double s, const StepArrays& step, const FlightArrays& flight, const double* raised, double* x_after,
                        double* y_after) {
  return HWY_DYNAMIC_DISPATCH(step_and_sum_target)(padded, s, step, flight, raised, x_after, y_after);
}

void multiply_gaps(int padded, int pairs, const double* G, const double* x, const double* y, double* gap, double* rate) {
  HWY_DYNAMIC_DISPATCH(gaps_target)(padded, pairs, G, x, y, gap, rate);
}

}  // namespace nsframe
#endif
