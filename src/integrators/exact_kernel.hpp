// The inner loops of the scheme `exact` over all modes, by the widest SIMD the machine has (Highway, chosen at run time). All
// arrays have `padded` entries, a multiple of dense_row_padding.
#pragma once

namespace nsframe {

// x+ = A x + B y + L f0 + R f1, y+ = -w^2 B x + (A - 2 a B) y + B f0 + L f1, with the load f0 + f1 s (theory.md, 151), of
// oscillating modes after a time s: |w s| < 39000.
void propagate_oscillators(int padded, double s, const double* square, const double* decay, const double* damped, const double* x,
                           const double* y, const double* f0, const double* f1, double* x_after, double* y_after);

// The same with coefficients known before, the four of x and y in two parts each: high + low.
struct StepArrays {
  const double *xx, *xy, *yx, *yy, *xx_low, *xy_low, *yx_low, *yy_low, *x0, *x1, *y0, *y1;
};
void apply_step(int padded, const StepArrays& step, const double* x, const double* y, const double* f0, const double* f1, double* x_after,
                double* y_after);

// Over a free motion of length s from x, y under the loads f0 + f1 s to x_after, y_after: the work of the part load0 + load1 s of the loads
// on oscillators, the change of their strain and of their kinetic energy [J].
struct FlightEnergy {
  double work = 0, strain = 0, kinetic = 0;
};
struct FlightArrays {  // *_after: only where they are asked for
  const double *square, *decay, *flexibility, *x, *y, *f0, *f1, *x_after, *y_after;
};
FlightEnergy sum_energy(int padded, double s, const FlightArrays& flight, const double* load0, const double* load1);

// What the free parts u of oscillators can do from a state on, u = x less the particular solution: the sum of w^2 A^2 over their amplitudes A,
// and the sum of x^2.
struct ModalSize {
  double energy = 0, square = 0;
};
// `raised`: square / (square - decay^2).
ModalSize modal_size(int padded, const FlightArrays& flight, const double* raised);

// apply_step() into x_after, y_after, sum_energy() of all loads and modal_size() in one pass.
struct FlightSums {
  FlightEnergy energy;
  ModalSize size;
};
FlightSums step_and_sum(int padded, double s, const StepArrays& step, const FlightArrays& flight, const double* raised, double* x_after, double* y_after);

// gap = G x, rate = G y; G: pairs x padded, by rows.
void multiply_gaps(int padded, int pairs, const double* G, const double* x, const double* y, double* gap, double* rate);

}  // namespace nsframe
