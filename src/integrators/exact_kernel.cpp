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

void step_target(int padded, const StepArrays& c, const double* x, const double* y, const double* f0, const double* f1, double* x_after,
                 double* y_after) {
  const hn::ScalableTag<double> tag;
  const auto width = static_cast<int>(hn::Lanes(tag));
  const auto load = [&](const double* array, int i) { return hn::LoadU(tag, array + i); };
  for (int i = 0; i < padded; i += width) {
    const auto x0 = load(x, i), y0 = load(y, i), p = load(f0, i), q = load(f1, i);
    const auto x_low = hn::MulAdd(load(c.xx_low, i), x0, hn::Mul(load(c.xy_low, i), y0));
    const auto y_low = hn::MulAdd(load(c.yx_low, i), x0, hn::Mul(load(c.yy_low, i), y0));
    const auto x_load = hn::MulAdd(load(c.x0, i), p, hn::MulAdd(load(c.x1, i), q, x_low));
    const auto y_load = hn::MulAdd(load(c.y0, i), p, hn::MulAdd(load(c.y1, i), q, y_low));
    hn::StoreU(hn::MulAdd(load(c.xx, i), x0, hn::MulAdd(load(c.xy, i), y0, x_load)), tag, x_after + i);
    hn::StoreU(hn::MulAdd(load(c.yx, i), x0, hn::MulAdd(load(c.yy, i), y0, y_load)), tag, y_after + i);
  }
}

FlightEnergy energy_target(int padded, double s, const FlightArrays& m, const double* load0, const double* load1) {
  const hn::ScalableTag<double> tag;
  const auto width = static_cast<int>(hn::Lanes(tag));
  const auto load = [&](const double* array, int i) { return hn::LoadU(tag, array + i); };
  const auto time = hn::Set(tag, s), half_time = hn::Set(tag, 0.5 * s);
  auto work = hn::Zero(tag), strain = work, kinetic = work;
  for (int i = 0; i < padded; i += width) {
    const auto x = load(m.x, i), y = load(m.y, i), x2 = load(m.x_after, i), y2 = load(m.y_after, i);
    const auto p = load(load0, i), q = load(load1, i), a = load(m.decay, i);
    const auto dx = hn::Sub(x2, x), dy = hn::Sub(y2, y);
    // int f y dt = [f x] - f1 int x dt, and int x dt from the equation of motion
    const auto change = hn::MulAdd(hn::Add(a, a), dx, dy);
    const auto integral = hn::Mul(hn::MulSub(time, hn::MulAdd(half_time, load(m.f1, i), load(m.f0, i)), change), load(m.flexibility, i));
    work = hn::MulAdd(p, dx, hn::MulAdd(q, hn::MulSub(time, x2, integral), work));
    strain = hn::MulAdd(load(m.square, i), hn::Mul(dx, hn::Add(x2, x)), strain);
    kinetic = hn::MulAdd(dy, hn::Add(y2, y), kinetic);
  }
  return {hn::GetLane(hn::SumOfLanes(tag, work)), 0.5 * hn::GetLane(hn::SumOfLanes(tag, strain)), 0.5 * hn::GetLane(hn::SumOfLanes(tag, kinetic))};
}

ModalSize size_target(int padded, const FlightArrays& m, const double* raised) {
  const hn::ScalableTag<double> tag;
  const auto width = static_cast<int>(hn::Lanes(tag));
  const auto load = [&](const double* array, int i) { return hn::LoadU(tag, array + i); };
  auto energy = hn::Zero(tag), square = energy;
  for (int i = 0; i < padded; i += width) {
    const auto w2 = load(m.square, i), a = load(m.decay, i), flexibility = load(m.flexibility, i), x = load(m.x, i);
    const auto slope = hn::Mul(load(m.f1, i), flexibility);
    const auto u = hn::Sub(x, hn::Mul(hn::NegMulAdd(hn::Add(a, a), slope, load(m.f0, i)), flexibility));
    const auto v = hn::MulAdd(a, u, hn::Sub(load(m.y, i), slope));
    energy = hn::MulAdd(hn::Mul(w2, u), u, hn::MulAdd(hn::Mul(load(raised, i), v), v, energy));
    square = hn::MulAdd(x, x, square);
  }
  return {hn::GetLane(hn::SumOfLanes(tag, energy)), hn::GetLane(hn::SumOfLanes(tag, square))};
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

void multiply_gaps(int padded, int pairs, const double* G, const double* x, const double* y, double* gap, double* rate) {
  HWY_DYNAMIC_DISPATCH(gaps_target)(padded, pairs, G, x, y, gap, rate);
}

}  // namespace nsframe
#endif
