// Loads between the ends of corotational members: cantilevers under a pressure, which turns with them, and under a dead load, which
// doesn't, against their elasticas.
#include <doctest/doctest.h>

#include <cmath>

#include "integrators/simulation.hpp"
#include "tests/support/small_models.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

constexpr double length = 4, EI = 2e6, pressure = 5e5;  // [m], [N m2], [N/m]: the tip turns by about 1.8 rad

struct Tip {
  double x = 0, y = 0, angle = 0;
};

// The curve from the clamp by curvatures at equal distances, the first at the clamp.
Tip integrated(const std::vector<double>& curvature) {
  const std::size_t n = curvature.size() - 1;
  const double h = length / static_cast<double>(n);
  Tip tip;
  for (std::size_t i = 0; i < n; ++i) {
    const double mean = 0.5 * (curvature[i] + curvature[i + 1]), middle = tip.angle + h / 2 * mean;
    tip.x += h * std::cos(middle);
    tip.y += h * std::sin(middle);
    tip.angle += h * mean;
  }
  return tip;
}

// The elastica N' = k V, V' = -k N - q, M' = -V, M = EI k in its own axes, from the free end inwards by Runge-Kutta; then the
// angle and the curve from the clamp.
Tip elastica() {
  constexpr int n = 20000;
  const double h = length / n;
  std::vector<double> curvature(n + 1);  // at the distance i h from the clamp
  Vector3 s = Vector3::Zero();           // N, V, M
  const auto rate = [](const Vector3& f) {  // by the distance from the free end
    const double k = f[2] / EI;
    return Vector3(-k * f[1], k * f[0] + pressure, f[1]);
  };
  for (int i = 0; i < n; ++i) {
    const Vector3 a = rate(s), b = rate(s + h / 2 * a), c = rate(s + h / 2 * b), d = rate(s + h * c);
    s += h / 6 * (a + 2 * b + 2 * c + d);
    curvature[static_cast<std::size_t>(n - i - 1)] = s[2] / EI;
  }
  return integrated(curvature);
}

// The elastica M' = -(L - s) (q_y cos a - q_x sin a), a' = M / EI from the clamp by Runge-Kutta; the moment there by bisection, until
// none is left at the tip.
Tip dead_elastica(const Vector3& q) {
  constexpr int n = 20000;
  const double h = length / n;
  std::vector<double> curvature(n + 1);
  const auto tip_moment = [&](double at_clamp) {
    Vector2 s(0, at_clamp);  // angle, moment
    const auto rate = [&](double x, const Vector2& f) {
      return Vector2(f[1] / EI, -(length - x) * (q.y() * std::cos(f[0]) - q.x() * std::sin(f[0])));
    };
    for (int i = 0; i < n; ++i) {
      curvature[static_cast<std::size_t>(i)] = s[1] / EI;
      const double x = i * h;
      const Vector2 a = rate(x, s), b = rate(x + h / 2, s + h / 2 * a), c = rate(x + h / 2, s + h / 2 * b), d = rate(x + h, s + h * c);
      s += h / 6 * (a + 2 * b + 2 * c + d);
    }
    curvature[n] = s[1] / EI;
    return s[1];
  };
  double low = 0, high = q.norm() * length * length;  // the load's largest arm
  while (high - low > 1e-10 * high) {
    const double middle = 0.5 * (low + high);
    (tip_moment(middle) > 0 ? high : low) = middle;
  }
  tip_moment(0.5 * (low + high));
  return integrated(curvature);
}

ModelDescription cantilever_under(const Vector3& per_length, int elements, ElementKind kind, bool local) {
  ModelDescription d;
  const double E = 200e9, I = EI / E, A = 0.05;  // stretches by less than 1e-4
  const double y = std::sqrt(I / A);
  FiberSectionDescription fibers;
  for (const double sy : {-y, y})
    for (const double sz : {-y, y}) fibers.fibers.push_back({sy, sz, A / 4, {"m", {}}});
  fibers.torsion_stiffness = EI;
  d.materials = {{"m", {}, Elastic{E}}};
  d.sections.resize(1);
  d.sections[0].name = "s";
  d.sections[0].kind = fibers;
  StructureDescription s;
  s.name = "a";
  s.supports = {fixed("0")};
  LoadDescription load;
  load.local = local;
  load.uniform = per_length;
  for (int i = 0; i <= elements; ++i) {
    s.nodes.push_back(node(std::to_string(i), length * i / elements, 0, 0));
    if (i == 0) continue;
    s.elements.push_back(beam("e" + std::to_string(i), std::to_string(i - 1), std::to_string(i), "s", kind));
    s.elements.back().geometry = Geometry::corotational;
    s.elements.back().orientation = Vector3::UnitZ();  // local y along global Y
    load.elements.push_back({s.elements.back().id, {}});
    s.masses.push_back(mass(std::to_string(i), 1));
  }
  s.loads = {load};
  d.structures = {s};
  return d;
}

Tip cantilever(int elements, ElementKind kind, bool local, const Vector3& per_length) {
  const Model model = build(cantilever_under(per_length, elements, kind, local));
  Simulation simulation(model, {});
  const Vector6 u = model.dofs.expand(simulation.state().displacement).segment<6>(full_dof(model, "a." + std::to_string(elements), 0));
  return {length + u[0], u[1], u[5]};
}

double distance(const Tip& a, const Tip& b) { return std::hypot(a.x - b.x, a.y - b.y, a.angle - b.angle); }

// Members of every kind come to the elastica at second order.
void check_convergence(const Tip& exact, bool local, const Vector3& q) {
  for (const ElementKind kind : {ElementKind::elastic_beam, ElementKind::force_beam, ElementKind::displacement_beam}) {
    CAPTURE(int(kind));
    const Tip coarse = cantilever(8, kind, local, q), fine = cantilever(16, kind, local, q);
    CHECK(distance(coarse, exact) / distance(fine, exact) == doctest::Approx(4).epsilon(0.1));  // second order
    const auto limit = [](double a, double b) { return b + (b - a) / 3; };
    const Tip extrapolated{limit(coarse.x, fine.x), limit(coarse.y, fine.y), limit(coarse.angle, fine.angle)};
    CHECK(distance(extrapolated, exact) < 5e-4);
  }
}

}  // namespace

TEST_CASE("a pressure on corotational members stays normal to them, as in the elastica") {
  const Tip exact = elastica();
  CHECK(exact.angle > 1.5);
  check_convergence(exact, true, Vector3(0, pressure, 0));
}

TEST_CASE("a dead load on corotational members keeps its direction, as in the elastica") {
  for (const Vector3& q : {Vector3(0, pressure, 0), Vector3(-2e5, 4e5, 0)}) {
    const Tip exact = dead_elastica(q);
    CHECK(exact.angle > 1);
    check_convergence(exact, false, q);
  }
}

TEST_CASE("what rests under a load on its members alone stays at rest, without a halved step") {
  for (const ElementKind kind : {ElementKind::elastic_beam, ElementKind::force_beam, ElementKind::displacement_beam}) {
    for (const char* scheme : {"moreau-jean", "event-split"}) {
      CAPTURE(int(kind));
      CAPTURE(std::string(scheme));
      AnalysisOptions o;
      o.scheme = scheme;
      o.dt = 1e-3;
      o.duration = 0.1;
      const Model model = build(cantilever_under(Vector3(0, -pressure, 0), 8, kind, false));
      Simulation simulation(model, o);
      const VectorX start = simulation.state().displacement;
      CHECK(start.cwiseAbs().maxCoeff() > 1);
      const auto summary = simulation.run({});
      CAPTURE(summary.stop_reason);
      CHECK(summary.completed);
      CHECK(summary.halved_steps == 0);
      CHECK((simulation.state().displacement - start).cwiseAbs().maxCoeff() < 1e-6);
    }
  }
}
