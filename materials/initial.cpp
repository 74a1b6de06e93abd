#include "materials/initial.hpp"

#include <cmath>

#include "materials/uniaxial.hpp"

namespace nsframe {

namespace {

// Virgin history of the law inside after it was strained to `strain`.
void start_at(double strain, const InnerLaw& material, double* history) {
  std::vector<double> virgin(static_cast<std::size_t>(history_size(material)));
  initialize_history(material, virgin.data());
  respond(material.law->law, strain, virgin.data(), history);
}

void respond_shifted(const PointArrays& p, const double* shift, int shift_step, int first, const InnerLaw& material,
                     Evaluate evaluate) {
  double inside[wrapped_points];
  for (int i = 0; i < p.count; ++i) inside[i] = p.strain[i] + shift[i * shift_step];
  evaluate(*material.law, p.inside(first, inside, p.stress, p.tangent));
}

}  // namespace

int InitStrain::history_size() const { return nsframe::history_size(material); }
void InitStrain::initialize_history(double* history) const { start_at(epsInit, material, history); }
double InitStrain::initial_tangent() const { return nsframe::initial_tangent(material); }
double InitStrain::yield_strain() const { return nsframe::yield_strain(material); }
bool InitStrain::has_yielded(double strain, double stress) const {
  return nsframe::has_yielded(material.law->law, strain + epsInit, stress);
}
void InitStrain::respond(const PointArrays& p, Evaluate evaluate) const {
  respond_shifted(p, &epsInit, 0, 0, material, evaluate);
}

void InitStress::check() const {
  if (material.law) require(initial_strain().has_value(), "sigInit is not reached by the material's first loading");
}

// Newton on the virgin curve; where that doesn't settle, the first crossing is bracketed and halved.
std::optional<double> InitStress::initial_strain() const {
  if (sigInit == 0) return 0.0;
  const double E = nsframe::initial_tangent(material);
  if (!(E > 0)) return std::nullopt;
  std::vector<double> virgin(static_cast<std::size_t>(nsframe::history_size(material))), scratch = virgin;
  nsframe::initialize_history(material, virgin.data());
  const auto at = [&](double strain) {
    return nsframe::respond(material.law->law, strain, virgin.data(), scratch.data());
  };
  const double tolerance = 4 * std::numeric_limits<double>::epsilon() * std::abs(sigInit);
  double strain = sigInit / E;
  for (int i = 0; i < 50; ++i) {
    const UniaxialPoint point = at(strain);
    if (std::abs(point.stress - sigInit) <= tolerance) return strain;
    if (!(point.tangent > 1e-6 * E)) break;
    strain += (sigInit - point.stress) / point.tangent;
  }
  const auto short_of = [&](double e) { return std::abs(at(e).stress) < std::abs(sigInit); };
  double low = 0, high = sigInit / E;
  // hardening down to 1e-4 E carries it within this range
  for (int i = 0; i < 4000 && short_of(high); ++i) {
    low = high;
    high += 0.01 * (1 + 0.01 * i) * sigInit / E;
  }
  if (short_of(high)) return std::nullopt;
  for (int i = 0; i < 200 && high != low; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (short_of(middle) ? low : high) = middle;
  }
  // a jump over sigInit is no solution
  return std::abs(at(high).stress - sigInit) <= 1e-9 * std::abs(sigInit) ? std::optional(high) : std::nullopt;
}

// Component 0: the initial strain; then the law inside.
int InitStress::history_size() const { return 1 + nsframe::history_size(material); }
void InitStress::initialize_history(double* history) const {
  history[0] = initial_strain().value_or(0.0);
  start_at(history[0], material, history + 1);
}
double InitStress::initial_tangent() const { return nsframe::initial_tangent(material); }
double InitStress::yield_strain() const { return nsframe::yield_strain(material); }
bool InitStress::has_yielded(double strain, double stress) const {
  return nsframe::has_yielded(material.law->law, strain + initial_strain().value_or(0.0), stress);
}
void InitStress::respond(const PointArrays& p, Evaluate evaluate) const {
  respond_shifted(p, p.committed, 1, 1, material, evaluate);
  for (int i = 0; i < p.count; ++i) p.keep(i, 0, 1);
}

}  // namespace nsframe
