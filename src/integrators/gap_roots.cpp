#include "integrators/gap_roots.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace nsframe {

namespace {

std::array<double, 4> bernstein(const GapPiece& p) {
  return {p.start, p.start + p.h * p.start_rate / 3, p.end - p.h * p.end_rate / 3, p.end};
}

double cubic(const std::array<double, 4>& b, double t) {
  const double u = 1 - t;
  return u * u * u * b[0] + 3 * u * u * t * b[1] + 3 * u * t * t * b[2] + t * t * t * b[3];
}

// Parameter in [0, 1] where the cubic first falls through zero; 2 if nowhere. Halves until the pieces are monotone.
double fall(const std::array<double, 4>& b, int depth) {
  if (*std::min_element(b.begin(), b.end()) >= 0) return 2;
  const bool falls = b[0] >= b[1] && b[1] >= b[2] && b[2] >= b[3];
  if (falls || depth == 0) {
    if (b[0] <= 0) return b[3] < 0 ? 0 : 2;
    if (b[3] >= 0) return 2;
    double low = 0, high = 1;
    double t = b[0] / (b[0] - b[3]);
    for (int i = 0; i < 100 && high - low > 1e-17; ++i) {
      const double value = cubic(b, t), u = 1 - t;
      if (std::abs(value) <= machine_epsilon * (u * u * u * b[0] - t * t * t * b[3])) break;  // less than its largest terms are rounded by
      (value > 0 ? low : high) = t;
      const double slope = 3 * (u * u * (b[1] - b[0]) + 2 * u * t * (b[2] - b[1]) + t * t * (b[3] - b[2]));
      const double next = slope < 0 ? t - value / slope : -1;
      const double chosen = next > low && next < high ? next : 0.5 * (low + high);
      if (chosen == t) break;
      t = chosen;
    }
    return t;
  }
  const double p = 0.5 * (b[0] + b[1]), q = 0.5 * (b[1] + b[2]), r = 0.5 * (b[2] + b[3]), s = 0.5 * (p + q), v = 0.5 * (q + r), m = 0.5 * (s + v);
  const double left = fall({b[0], p, s, m}, depth - 1);
  if (left <= 1) return 0.5 * left;
  const double right = fall({m, v, r, b[3]}, depth - 1);
  return right <= 1 ? 0.5 + 0.5 * right : 2;
}

}  // namespace

Verdict judge(const GapPiece& piece, double tolerance) {
  const double h3 = piece.fourth * piece.h * piece.h * piece.h, error = h3 * piece.h / 384;
  const std::array<double, 4> b = bernstein(piece);
  const double least = *std::min_element(b.begin(), b.end());
  if (least > error) return Verdict::open;
  if (error <= 0.25 * tolerance) {
    if (least >= -0.5 * tolerance) return Verdict::open;
    return first_fall(piece, piece.start > tolerance ? 0 : -0.5 * tolerance) < piece.h ? Verdict::closes : Verdict::open;
  }
  if (piece.start > std::max(error, tolerance) && piece.end < -error) {
    const double slope_error = h3 * std::sqrt(3.0) / 216 * piece.h;  // times h
    const double steepest = 3 * std::max({b[1] - b[0], b[2] - b[1], b[3] - b[2]});
    if (steepest < -slope_error) return Verdict::closes;
  }
  return Verdict::unsure;
}

double first_fall(const GapPiece& piece, double level) {
  std::array<double, 4> b = bernstein(piece);
  for (double& value : b) value -= level;
  const double t = fall(b, 40);
  return t <= 1 ? t * piece.h : piece.h;
}

double certain_opening(double rate, double second, double third, double fourth_bound, double h) {
  for (int i = 0; i < 60; ++i, h *= 0.5) {
    // g / s, g / s^2 or g / s^3 at its least in (0, h]
    const double bound = fourth_bound * h / 24;
    const bool open = rate > 0     ? rate + h * std::min(0.0, 0.5 * second) + h * h * (std::min(0.0, third / 6) - bound) > 0
                      : second > 0 ? 0.5 * second + h * (std::min(0.0, third / 6) - bound) > 0
                                   : third / 6 - bound > 0;
    if (open) return h;
  }
  return 0;
}

double first_negative(VectorX b, double tolerance) {
  // the first of ever shorter pieces that may hold a root
  struct Piece {
    double start, length;
    VectorX b;
  };
  std::vector<Piece> stack{{0, 1, std::move(b)}};
  const auto last = stack[0].b.size() - 1;
  while (!stack.empty()) {
    Piece piece = std::move(stack.back());
    stack.pop_back();
    if (piece.b.minCoeff() >= -tolerance) continue;
    if (piece.length < 1e-15) return piece.start;
    VectorX left(last + 1), right = piece.b;
    for (Eigen::Index i = 0; i <= last; ++i) {
      left[i] = right[0];
      for (Eigen::Index j = 0; j < last - i; ++j) right[j] = 0.5 * (right[j] + right[j + 1]);
    }
    stack.push_back({piece.start + 0.5 * piece.length, 0.5 * piece.length, std::move(right)});
    stack.push_back({piece.start, 0.5 * piece.length, std::move(left)});
  }
  return 2;
}

}  // namespace nsframe
