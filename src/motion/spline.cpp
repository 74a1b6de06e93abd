#include "motion/spline.hpp"

namespace nsframe {

std::vector<double> spline_accelerations(const std::vector<double>& u, double dt) {
  const std::size_t n = u.size();
  std::vector<double> a(n, 0.0);
  if (n < 2) return a;
  // a_{i-1} + 4 a_i + a_{i+1} = 6 (u_{i-1} - 2 u_i + u_{i+1})/dt^2, with half an equation for rest at each end; by elimination
  const double scale = 6 / (dt * dt);
  std::vector<double> above(n);
  for (std::size_t i = 0; i < n; ++i) {
    const bool ends = i == 0 || i + 1 == n;
    const double right = (i + 1 < n ? u[i + 1] - u[i] : 0) - (i > 0 ? u[i] - u[i - 1] : 0);
    const double pivot = (ends ? 2 : 4) - (i > 0 ? above[i - 1] : 0);
    above[i] = 1 / pivot;
    a[i] = (scale * right - (i > 0 ? a[i - 1] : 0)) / pivot;
  }
  for (std::size_t i = n - 1; i-- > 0;) a[i] -= above[i] * a[i + 1];
  return a;
}

}  // namespace nsframe
