// Free and forced vibration benchmarks of NAFEMS for beams: FV2, FV4, FV5, 5H, 5T. Closed forms (Euler-Bernoulli arms,
// Timoshenko's beam) stand beside NAFEMS' own figures.
#include <fmt/format.h>

#include <complex>

#include "integrators/simulation.hpp"
#include "tests/support/small_models.hpp"
#include "tests/verification/registry.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

constexpr double steel_E = 200e9, steel_G = steel_E / 2.6, density = 8000;
const MemberMass with_rotary{0, density, true, true};

std::vector<double> frequencies(const ModelDescription& d, int count) {
  const Model model = build(d);
  AnalysisOptions options;
  options.scheme = "moreau-jean";
  options.duration = 1;
  const Simulation simulation(model, options, count);
  std::vector<double> f;
  for (const double w : simulation.modes().front().modes.circular_frequency) f.push_back(w / (2 * pi));
  f.resize(static_cast<std::size_t>(count));
  return f;
}

void add_frequencies(VerificationRows& rows, const std::string& what, const std::vector<double>& found,
                     const std::vector<double>& expected, double tolerance) {
  for (std::size_t i = 0; i < expected.size(); ++i)
    rows.add(fmt::format("{}frequency {}, Hz", what, i + 1), found.at(i), expected[i], relative(tolerance));
}

// A line of n beams from `a` to `b`; node ids PREFIX0 (if new) to PREFIXn.
void add_line(StructureDescription& s, const std::string& prefix, const std::string& first, const Vector3& a,
              const Vector3& b, int n, const MemberMass& mass) {
  std::string before = first;
  for (int i = 1; i <= n; ++i) {
    const Vector3 at = a + (b - a) * i / n;
    const std::string id = prefix + std::to_string(i);
    s.nodes.push_back(node(id, at.x(), at.y(), at.z()));
    ElementDescription e = beam("e" + id, before, id, "s");
    e.mass = mass;
    s.elements.push_back(e);
    before = id;
  }
}

// Simply supported beam of 10 m with a square section of 2 m, torsion held at one end. J is the polar moment, as in
// NAFEMS' figures; the shear coefficient Cowper's (1966), 10 (1 + nu)/(12 + 11 nu).
constexpr double fv5_shear = 10 * 1.3 / (12 + 11 * 0.3);
ModelDescription deep_beam(int n) {
  ModelDescription d;
  const double A = 4, I = 16.0 / 12;
  d.sections = {elastic_section("s", {steel_E, steel_G, A, I, I, 2 * I, fv5_shear * A, fv5_shear * A})};
  StructureDescription s;
  s.name = "beam";
  s.nodes = {node("0", 0, 0, 0)};
  add_line(s, "", "0", Vector3::Zero(), Vector3(10, 0, 0), n, with_rotary);
  s.supports = {fixed("0", {true, true, true, true, false, false}),
                fixed(std::to_string(n), {false, true, true, false, false, false})};
  d.structures = {s};
  return d;
}

// Bending frequency n of Timoshenko's simply supported beam [Hz].
double timoshenko(int n, double L, double A, double I, double shear_area) {
  const double k = n * pi / L, a = density * I * density / (shear_area / A * steel_G);
  const double b = density * A + density * I * k * k + steel_E * I * density * k * k / (shear_area / A * steel_G),
               c = steel_E * I * std::pow(k, 4);
  return std::sqrt((b - std::sqrt(b * b - 4 * a * c)) / (2 * a)) / (2 * pi);
}

}  // namespace

VERIFICATION_CASE("Modes", "NAFEMS FV5: deep simply supported beam",
                  "10 m, square of 2 m, E = 200 GPa, nu = 0.3, 8000 kg/m3, rotary inertia, Cowper's shear coefficient; forty elements. "
                  "Closed forms of Timoshenko's beam and of rods, and the figures of NAFEMS.") {
  const std::vector<double> f = frequencies(deep_beam(40), 9);
  const auto bending = [](int n) { return timoshenko(n, 10, 4, 16.0 / 12, fv5_shear * 4); };
  const double torsion = std::sqrt(steel_G / density) / 40, axial = std::sqrt(steel_E / density) / 40;
  add_frequencies(rows, "closed form: ", f,
                  {bending(1), bending(1), torsion, axial, bending(2), bending(2), 3 * torsion, bending(3), bending(3)}, 1e-3);
  add_frequencies(rows, "NAFEMS: ", f, {42.649, 42.649, 77.542, 125.00, 148.31, 148.31, 233.10, 284.55, 284.55}, 5e-3);
}

namespace {

// `stretch`: times the axial stiffness of the arms; the mass stays.
ModelDescription double_cross(double stretch) {
  ModelDescription d;
  const double h = 0.125, A = h * h, I = A * h * h / 12;
  d.sections = {elastic_section("s", {steel_E, steel_G, stretch * A, I, I, 2 * I})};
  StructureDescription s;
  s.name = "cross";
  s.nodes = {node("c", 0, 0, 0)};
  for (int arm = 0; arm < 8; ++arm) {
    const std::string prefix(1, static_cast<char>('p' + arm));
    const Vector3 tip = 5 * Vector3(std::cos(arm * pi / 4), std::sin(arm * pi / 4), 0);
    add_line(s, prefix, "c", Vector3::Zero(), tip, 10, {density * A, 0, true, false});
    s.supports.push_back(fixed(prefix + "10", {true, true, true, true, true, false}));
  }
  for (const NodeDescription& n : s.nodes) {  // in the plane z = 0
    if (!n.id.ends_with("10")) s.supports.push_back(fixed(n.id, {false, false, true, true, true, false}));
  }
  d.structures = {s};
  return d;
}

}  // namespace

VERIFICATION_CASE("Modes", "NAFEMS FV2: pin-ended double cross",
                  "Eight arms of 5 m, square of 0.125 m, in their plane; ten elements an arm. The figures are those of arms that don't "
                  "stretch; arms that do let the centre move in two modes of each cluster. Closed form of a clamped and pinned beam.") {
  const double h = 0.125, A = h * h, I = A * h * h / 12;
  const double unit = std::sqrt(steel_E * I / (density * A)) / (2 * pi * 25);  // arms of 5 m
  const std::vector<double> rigid = frequencies(double_cross(1e3), 16), f = frequencies(double_cross(1), 16);
  const std::array<std::tuple<int, double, double>, 4> clusters{{{0, pi * pi * unit, 11.336},
                                                                {7, 15.4182057 * unit, 17.709},
                                                                {8, 4 * pi * pi * unit, 45.345},
                                                                {15, 49.9648620 * unit, 57.390}}};
  for (const auto& [last, exact, nafems] : clusters) {  // the elements leave 0.018 % of the second clamped and pinned mode
    const auto i = static_cast<std::size_t>(last);
    rows.add(fmt::format("closed form: frequency {}, Hz", last + 1), rigid[i], exact, relative(3e-4));
    rows.add(fmt::format("NAFEMS: frequency {}, Hz", last + 1), rigid[i], nafems, relative(3e-4));
    rows.add(fmt::format("NAFEMS: frequency {} of arms that stretch, Hz", last + 1), f[i], nafems, relative(6e-3));
  }
  rows.add("spread of the first cluster of seven", rigid[7] / rigid[1], 1, relative(3e-4));
  rows.add("frequency 2 of arms that stretch, Hz", f[1], f[2], relative(1e-9));
  rows.add("frequency 4 of arms that stretch, Hz", f[3], f[7], relative(1e-9));
}

VERIFICATION_CASE("Modes", "NAFEMS FV4: cantilever with off-centre masses",
                  "10 m, round of 0.5 m; 10 and 1 t on rigid arms of 2 m to both sides of the tip; twenty elements.") {
  ModelDescription d;
  const double r = 0.25, A = pi * r * r, I = A * r * r / 4;
  d.sections = {elastic_section("s", {steel_E, steel_G, A, I, I, 2 * I})};
  StructureDescription s;
  s.name = "cantilever";
  s.nodes = {node("0", 0, 0, 0), node("heavy", 10, 2, 0), node("light", 10, -2, 0)};
  add_line(s, "", "0", Vector3::Zero(), Vector3(10, 0, 0), 20, with_rotary);
  s.supports = {fixed("0")};
  s.masses = {mass("heavy", 10000), mass("light", 1000)};
  s.constraints = {constraint(ConstraintKind::rigid_body, "20", {"heavy", "light"})};
  d.structures = {s};
  add_frequencies(rows, "", frequencies(d, 6), {1.723, 1.727, 7.413, 9.972, 18.155, 26.957}, 3e-4);
}

VERIFICATION_CASE("Oscillators and time integration", "NAFEMS 5H: deep beam under a harmonic line load",
                  "The beam of FV5 in ten elements under 1 MN/m, damping 2 % in every mode; amplitude of the middle at its peak.") {
  ModelDescription d = deep_beam(10);
  d.structures.front().damping.kind = DampingKind::modal;
  d.structures.front().damping.ratios = std::vector<double>(9, 0.02);
  const Model model = build(d);
  AnalysisOptions options;
  options.scheme = "moreau-jean";
  options.duration = 1;
  Simulation simulation(model, options, 9);
  const MatrixX M = model.mass, K = simulation.initial_stiffness();
  const MatrixX U = simulation.system().damping.modal.front();
  const VectorX load =
      model.inertia[2] * (1e6 / (density * 4));  // a line load is the inertia of a uniform acceleration
  const int middle =
      static_cast<int>(std::find_if(model.dofs.free.begin(), model.dofs.free.end(),
                                    [&](const FreeDof& dof) {
                                      return dof.node == full_dof(model, "beam.5", 0) / 6 && dof.direction == 2;
                                    }) -
                       model.dofs.free.begin());
  double peak = 0, at = 0;
  for (double f = 40; f < 46; f += 0.01) {
    const std::complex<double> iw(0, 2 * pi * f);
    const Eigen::MatrixXcd dynamic = K.cast<std::complex<double>>() + iw * iw * M + iw * (U * U.transpose());
    const double amplitude =
        std::abs(Eigen::VectorXcd(dynamic.partialPivLu().solve(load.cast<std::complex<double>>()))[middle]);
    if (amplitude > peak) peak = amplitude, at = f;
  }
  rows.add("peak amplitude, mm", 1e3 * peak, 13.45, relative(5e-3));
  rows.add("its frequency, Hz", at, 42.65, relative(2e-3));
}

VERIFICATION_CASE("Oscillators and time integration", "NAFEMS 5T: deep beam under a sudden line load",
                  "The beam of FV5 in ten elements under 1 MN/m from t = 0 on, damping 2 % in every mode; theta = 1/2, dt = 20 us.") {
  ModelDescription d = deep_beam(10);
  d.structures.front().damping.kind = DampingKind::modal;
  d.structures.front().damping.ratios = std::vector<double>(9, 0.02);
  LoadDescription load;
  for (const ElementDescription& e : d.structures.front().elements) load.elements.push_back({e.id, {}});
  load.uniform = Vector3(0, 0, -1e6);
  d.structures.front().loads = {load};
  const auto middle_of = [](const Model& model, const State& state) {
    return -model.dofs.expand(state.displacement)[full_dof(model, "beam.5", 2)];
  };
  AnalysisOptions options;
  options.scheme = "moreau-jean";
  options.duration = 0.02;
  options.dt = 2e-5;
  options.theta = 0.5;
  const Model statically = build(d);
  Simulation at_rest(statically, options);
  const double rest = 1e3 * middle_of(statically, at_rest.state());
  rows.add("static displacement of the middle, mm", rest, 0.538, relative(5e-3));
  const double EI = steel_E * 16 / 12, GA = steel_G * fv5_shear * 4;  // 5 w L^4/384 EI + w L^2/8 GA
  rows.add("the same, closed form", rest, 1e3 * (5e10 / 384 / EI + 1e8 / 8 / GA), relative(1e-9));

  d.gravity.statically_first = false;
  const Model model = build(d);
  struct Peak : Observer {
    const Model* model = nullptr;
    double value = 0, time = 0;
    void step(const State&, const State& after, const StepReport&, const Energy&) override {
      const double u = -model->dofs.expand(after.displacement)[full_dof(*model, "beam.5", 2)];
      if (u > value) value = u, time = after.time;
    }
  } peak;
  peak.model = &model;
  Simulation simulation(model, options);
  simulation.run({&peak});
  rows.add("largest displacement, mm", 1e3 * peak.value, 1.043, relative(5e-3));
  rows.add("its time, s", peak.time, 0.0117, relative(0.01));
}
