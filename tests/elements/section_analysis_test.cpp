// Moment-curvature and interaction of sections against closed forms of elastic and elastic-plastic theory.
#include "elements/section_analysis.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "base/errors.hpp"
#include "elements/catalogue.hpp"
#include "elements/fiber_cutting.hpp"

using namespace nsframe;

namespace {

constexpr double E = 200e9, fy = 250e6, steel_yield = fy / E;

AnalysedSection rectangle(double h, double b, int ny, int nz, const UniaxialLaw& law) {
  FiberSectionDescription d;
  add_rectangle(d.fibers, {{-h / 2, h / 2}, {-b / 2, b / 2}}, ny, nz, {"steel", {}});
  return analysed_section("r", d, {{"steel", law}});
}

MomentCurvature bend(const AnalysedSection& section, double to, double axial = 0, double angle = 0, bool free = false,
                     int steps = 50) {
  return moment_curvature(section, {axial, angle, {to}, steps, free});
}

const ElasticPP plastic{E, steel_yield};

}  // namespace

TEST_CASE("an elastic-plastic rectangle bends as M = My (3 - (ky/k)^2)/2, towards a shape factor of 1.5") {
  const double h = 0.2, b = 0.1, My = fy * b * h * h / 6, ky = 2 * steel_yield / h;
  const int n = 2000;
  const auto curve = bend(rectangle(h, b, n, 1, plastic), 50 * ky);
  REQUIRE(curve.states.size() == 51);
  CHECK(curve.end.empty());
  for (const BendingState& s : curve.states) {
    const double k = s.curvature / ky;
    const double exact = k < 1 ? My * k : My * (3 - 1 / (k * k)) / 2;
    CHECK(std::abs(s.moment - exact) < 1e-6 * My);  // strips lose 1/n^2
    CHECK(std::abs(s.force[0]) < 1e-9 * fy * b * h);
  }
  CHECK(curve.states.back().moment == doctest::Approx(1.5 * My).epsilon(3e-4));
  const BendingSummary s = summarize(rectangle(h, b, n, 1, plastic), curve);
  REQUIRE(s.yield);
  CHECK(s.yield->curvature == doctest::Approx(ky).epsilon(1e-3));  // the outermost strip's middle
  CHECK(s.yield->moment == doctest::Approx(My).epsilon(2e-3));
  CHECK_FALSE(s.fallen);
  CHECK(s.ultimate.curvature == doctest::Approx(50 * ky));
}

TEST_CASE("axial force lowers the plastic moment of a rectangle by (N/Np)^2") {
  const double h = 0.2, b = 0.1, Mp = fy * b * h * h / 4, Np = fy * b * h;
  for (const double n : {-0.7, -0.3, 0.2, 0.9}) {
    CAPTURE(n);
    const auto curve = bend(rectangle(h, b, 1000, 1, plastic), 400 * steel_yield / h, n * Np);
    CHECK(curve.states.back().moment == doctest::Approx(Mp * (1 - n * n)).epsilon(1e-3));
    for (const BendingState& s : curve.states) CHECK(s.force[0] == doctest::Approx(n * Np).epsilon(1e-10));
    CHECK(curve.states.front().curvature == 0);
    CHECK(curve.states.front().deformation[0] == doctest::Approx(n * steel_yield).epsilon(1e-10));
  }
  CHECK_THROWS_AS(bend(rectangle(h, b, 10, 1, plastic), 0.1, 1.01 * Np), ConvergenceError);
}

TEST_CASE("an I shape reaches its plastic moments about both axes") {
  const CatalogueShape& shape = *find_shape("HEB300");
  FiberSectionDescription d;
  d.fibers = shape_fibers(shape, {40, 10, 80, false}, {"steel", {}});
  const AnalysedSection section = analysed_section("i", d, {{"steel", plastic}});
  const double web = shape.h - 2 * shape.tf;
  const double strong = shape.b * shape.tf * (shape.h - shape.tf) + shape.tw * web * web / 4;
  const double weak = shape.tf * shape.b * shape.b / 2;  // the web's fibers lie on the axis
  CHECK(bend(section, 1).states.back().moment == doctest::Approx(fy * strong).epsilon(1e-3));
  CHECK(bend(section, 1, 0, pi / 2).states.back().moment == doctest::Approx(fy * weak).epsilon(1e-3));
  // and in the other direction the same
  CHECK(bend(section, -1).states.back().moment == doctest::Approx(-fy * strong).epsilon(1e-3));
  CHECK(bend(section, 1, 0, pi).states.back().moment == doctest::Approx(fy * strong).epsilon(1e-3));
}

TEST_CASE("with a free axis an elastic angle bends without moment across, with a held one without curvature") {
  FiberSectionDescription d;
  add_rectangle(d.fibers, {{0, 0.2}, {0, 0.02}}, 40, 4, {"steel", {}});
  add_rectangle(d.fibers, {{0, 0.02}, {0.02, 0.12}}, 4, 20, {"steel", {}});
  const AreaMoments m = moments(d.fibers);
  for (FiberDescription& f : d.fibers) {
    f.y -= m.centroid.x();
    f.z -= m.centroid.y();
  }
  const AnalysedSection section = analysed_section("l", d, {{"steel", Elastic{E}}});
  const double Iz = m.second(0, 0), Iy = m.second(1, 1), Iyz = m.second(0, 1);
  const BendingState held = bend(section, 0.01).states.back(), free = bend(section, 0.01, 0, 0, true).states.back();
  CHECK(held.moment == doctest::Approx(E * Iz * 0.01).epsilon(1e-10));
  CHECK(held.transverse_moment == doctest::Approx(-E * Iyz * 0.01).epsilon(1e-10));
  CHECK(held.deformation[2] == 0);
  CHECK(free.moment == doctest::Approx(E * (Iz - Iyz * Iyz / Iy) * 0.01).epsilon(1e-10));
  CHECK(std::abs(free.transverse_moment) < 1e-9 * free.moment);
  // an axis between: k = 0.01 (cos 30, sin 30), M by the tensor
  const BendingState slanted = bend(section, 0.01, 0, pi / 6).states.back();
  const double c = std::cos(pi / 6), s = std::sin(pi / 6);
  CHECK(slanted.moment == doctest::Approx(E * 0.01 * (Iz * c * c + Iy * s * s - 2 * Iyz * s * c)).epsilon(1e-10));
}

TEST_CASE("a cycle of a kinematic law closes on itself") {
  const AnalysedSection section = rectangle(0.2, 0.1, 50, 1, Steel01{fy, E, 0.02});
  const auto curve = moment_curvature(section, {0, 0, {0.1, -0.1, 0.1, -0.1, 0.1}, 40, false});
  REQUIRE(curve.states.size() == 201);
  for (std::size_t i = 0; i <= 80; ++i) {
    const double moment = curve.states[40 + i].moment, scale = curve.states[40].moment;
    CHECK(std::abs(moment - curve.states[120 + i].moment) < 1e-9 * scale);
    CHECK(std::abs(moment + curve.states[80 + i].moment) < 1e-9 * scale);  // the way back mirrors the way there
  }
}

TEST_CASE("interaction of an elastic-plastic rectangle is M/Mp = 1 - (N/Np)^2 when strains are large") {
  const double h = 0.2, b = 0.1, Mp = fy * b * h * h / 4, Np = fy * b * h;
  const AnalysedSection section = rectangle(h, b, 1000, 1, plastic);
  const auto points = interaction(section, {0, {{1, 1}}, 41, 20});
  REQUIRE(points.size() == 41);
  CHECK(points.front().force[0] == doctest::Approx(-Np).epsilon(1e-12));
  CHECK(points.back().force[0] == doctest::Approx(Np).epsilon(1e-12));
  for (const InteractionPoint& p : points) {
    const double n = p.force[0] / Np;
    CHECK(std::abs(p.moment - Mp * (1 - n * n)) < 0.003 * Mp);
    CHECK(p.governing == 0);
  }
}

TEST_CASE("points of interaction just reach a limit, and lie on the moment-curvature path of their axial force") {
  const AnalysedSection section = rectangle(0.3, 0.2, 60, 1, Steel01{fy, E, 0.01});
  const StrainLimit limit{0.004, 0.01};
  for (const double angle : {0.0, pi}) {
    for (const InteractionPoint& p : interaction(section, {angle, {limit}, 15, 20})) {
      const auto [low, high] = strain_range(section.parts[0], p.deformation);
      CHECK(std::max(-low / limit.shortening, high / limit.elongation) == doctest::Approx(1).epsilon(1e-12));
      const double curvature = std::hypot(p.deformation[1], p.deformation[2]);
      // beyond steel_yield the axial force alone leaves plastic strain, and the order of loading matters
      if (curvature == 0 || std::abs(p.force[0]) > fy * 0.3 * 0.2) continue;
      const BendingState s = bend(section, curvature, p.force[0], angle).states.back();
      CHECK(s.moment == doctest::Approx(p.moment).epsilon(1e-6));
      CHECK(p.moment > 0);
    }
  }
}

TEST_CASE("a reinforced-concrete beam reaches the moment of the stress block, As fy (d - As fy/(2 fc b))") {
  const double h = 0.6, b = 0.3, d = 0.55, As = 15e-4, fc = 30e6, fs = 500e6;
  FiberSectionDescription section;
  add_rectangle(section.fibers, {{-h / 2, h / 2}, {-b / 2, b / 2}}, 3000, 1, {"concrete", {}});
  add_bars(section.fibers, Vector2(h / 2 - d, -0.1), Vector2(h / 2 - d, 0.1), 3, As / 3, {"steel", {}});
  // stiff, so that the block is rectangular, and without tension
  const ElasticPP concrete{3e12, 1e-12, -fc / 3e12}, steel{200e9, fs / 200e9};
  const AnalysedSection rc = analysed_section("rc", section, {{"concrete", concrete}, {"steel", steel}});
  const auto block = [&](double N) {  // about mid-depth; tension positive
    const double a = (As * fs - N) / (fc * b);
    return fc * a * b * (h / 2 - a / 2) + As * fs * (d - h / 2);
  };
  for (const double N : {0.0, -500e3, 200e3})
    CHECK(bend(rc, 0.2, N).states.back().moment == doctest::Approx(block(N)).epsilon(5e-4));
  CHECK(block(0) == doctest::Approx(As * fs * (d - As * fs / (2 * fc * b))).epsilon(1e-12));
  // pure compression and tension, and the point of no axial force between them
  const auto points = interaction(rc, {0, {{0.0035, 0.02}, {0.0035, 0.02}}, 201, 50});
  CHECK(points.front().force[0] == doctest::Approx(-fc * b * h - As * fs).epsilon(1e-6));
  CHECK(points.back().force[0] == doctest::Approx(As * fs).epsilon(1e-6));
  for (const InteractionPoint& p : points) {
    const bool steel_yields = p.deformation[0] - (h / 2 - d) * p.deformation[1] > fs / 200e9;
    if (steel_yields && p.force[0] < 0.9 * As * fs) CHECK(p.moment == doctest::Approx(block(p.force[0])).epsilon(5e-3));
    // cracked concrete bounds nothing: in tension the steel governs
    if (p.force[0] > 0.5 * As * fs) CHECK(rc.parts[std::size_t(p.governing)].material == "steel");
  }
}

TEST_CASE("displaced fibers take their part out") {
  FiberSectionDescription d;
  add_rectangle(d.fibers, {{-0.1, 0.1}, {-0.1, 0.1}}, 10, 10, {"concrete", {}});
  d.fibers.push_back({0.05, 0, 1e-3, {"steel", {}}});
  d.fibers.push_back({0.05, 0, 1e-3, {"concrete", {}}, true});
  const AnalysedSection section =
      analysed_section("rc", d, {{"concrete", Elastic{30e9}}, {"steel", Elastic{200e9}}});
  CHECK(initial_tangent(section.fibers)(0, 0) == doctest::Approx(30e9 * 0.039 + 200e9 * 1e-3).epsilon(1e-12));
  CHECK(section.parts[0].area == doctest::Approx(0.039).epsilon(1e-12));
  CHECK(section.parts[0].points.size() == 100);
}
