// Floor spectra of the pull-back pair, whose motion is known in closed form, and of motions given by hand.
#include <doctest/doctest.h>

#include "integrators/simulation.hpp"
#include "output/floor_spectra.hpp"
#include "output/history_file.hpp"
#include "tests/support/files.hpp"
#include "tests/support/hdf5_reader.hpp"
#include "tests/support/small_models.hpp"
#include "tests/verification/closed_forms.hpp"
#include "tests/verification/pair_of_masses.hpp"
#include "tests/verification/two_story_model.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

const std::vector<double> periods = logarithmic_periods(0.002, 2, 25);

// Does not tell its observer of the jumps: all change of velocity then is acceleration over a step.
class WithoutJumps : public Observer {
 public:
  explicit WithoutJumps(Observer& observer) : observer_(observer) {}
  void start(const Model& model, const State& state) override { observer_.start(model, state); }
  void step(const State& before, const State& after, const StepReport&, const Energy& energy) override {
    observer_.step(before, after, {}, energy);
  }

 private:
  Observer& observer_;
};

// PSA of the two masses of the pull-back test, by period.
std::array<std::vector<double>, 2> pull_back_psa(double dt, bool jumps) {
  ModelDescription d;
  d.structures = {oscillator(0, {4600, 2.11e6, 0.005, -0.024}), oscillator(1, {3500, 5.31e6, 0.005})};
  d.contacts = {contact_of(0, 1, 0.02, 0.6)};
  const Model model = build(d);
  AnalysisOptions options;
  options.scheme = "moreau-jean";
  options.dt = dt;
  options.theta = 0.5;
  options.duration = 1;
  Simulation simulation(model, options);
  FloorSpectra spectra({{"floors"}, periods, 0.05}, dt);
  WithoutJumps smooth(spectra);
  simulation.run({jumps ? static_cast<Observer*>(&spectra) : &smooth});
  return {pseudo_acceleration(periods, spectra.displacement(0, 0)), pseudo_acceleration(periods, spectra.displacement(1, 0))};
}

// The same from the closed-form motion, its acceleration linear over steps of about 20 us.
std::array<std::vector<double>, 2> exact_psa() {
  const std::array<FreeOscillator, 2> mass{FreeOscillator{std::sqrt(2.11e6 / 4600), 0.005}, FreeOscillator{std::sqrt(5.31e6 / 3500), 0.005}};
  std::array<std::vector<double>, 2> psa;
  for (std::size_t k = 0; k < 2; ++k) {
    Oscillators o(periods.size());
    double start = 0, x = k == 0 ? -0.024 : 0, v = 0;
    const double a = 2 * mass[k].xi * mass[k].w, b = mass[k].w * mass[k].w;
    std::vector<ExactImpact> stretches = pull_back_impacts();
    stretches.push_back({1.0, 0, {}, {}});
    for (const ExactImpact& impact : stretches) {
      const int n = static_cast<int>((impact.time - start) / 2e-5) + 1;
      const double h = (impact.time - start) / n;
      const OscillatorStep step(periods, 0.05, h);
      std::array<double, 2> from{x, v};
      for (int i = 1; i <= n; ++i) {
        const std::array<double, 2> to = mass[k].at(x, v, i * h);
        o.advance(step, -a * from[1] - b * from[0], -a * to[1] - b * to[0]);
        from = to;
      }
      o.jump(impact.v[k] - from[1]);
      start = impact.time;
      x = impact.x[k];
      v = impact.v[k];
    }
    psa[k] = pseudo_acceleration(periods, o.peak());
  }
  return psa;
}

// The same by FloorSpectra from the closed-form motion at the ends of steps of dt.
std::array<std::vector<double>, 2> exact_motion_psa(double dt, bool jumps) {
  const std::array<FreeOscillator, 2> mass{FreeOscillator{std::sqrt(2.11e6 / 4600), 0.005}, FreeOscillator{std::sqrt(5.31e6 / 3500), 0.005}};
  ModelDescription d;
  d.structures = {oscillator(0, {4600, 2.11e6, 0.005}), oscillator(1, {3500, 5.31e6, 0.005})};
  const Model model = build(d);
  FloorSpectra spectra({{"floors"}, periods, 0.05}, dt);
  ExactImpact last{0, 0, {-0.024, 0}, {0, 0}};  // where the present stretch of free motion starts
  const auto velocity = [&](double t) {
    return Vector2(mass[0].at(last.x[0], last.v[0], t - last.time)[1], mass[1].at(last.x[1], last.v[1], t - last.time)[1]);
  };
  State before;
  before.displacement = before.velocity = VectorX::Zero(2);
  spectra.start(model, before);
  auto next = pull_back_impacts().begin();
  for (int i = 1; i <= std::lround(1 / dt); ++i) {
    State after = before;
    after.time = i * dt;
    StepReport report;
    if (next != pull_back_impacts().end() && next->time <= after.time) {
      const Vector2 change = Vector2(next->v[0], next->v[1]) - velocity(next->time);
      if (jumps) report.jumps.push_back({next->time, change});
      last = *next++;
    }
    after.velocity = velocity(after.time);
    spectra.step(before, after, report, {});
    before = after;
  }
  return {pseudo_acceleration(periods, spectra.displacement(0, 0)), pseudo_acceleration(periods, spectra.displacement(1, 0))};
}

double largest_difference(const std::array<std::vector<double>, 2>& one, const std::array<std::vector<double>, 2>& other) {
  double difference = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    for (std::size_t i = 0; i < periods.size(); ++i) difference = std::max(difference, std::abs(one[k][i] / other[k][i] - 1));
  }
  return difference;
}

// One node that moves along x, driven by hand; its base by `motions`.
Model free_node(std::vector<MotionDescription> motions = {}) {
  ModelDescription d;
  d.structures = {oscillator(0, {1, 1, 0})};
  d.motions = std::move(motions);
  return build(d);
}

State moving(double time, double velocity) {
  State state;
  state.time = time;
  state.displacement = VectorX::Zero(1);
  state.velocity = VectorX::Constant(1, velocity);
  return state;
}

}  // namespace

TEST_CASE("floor spectra over impacts don't depend on the time step, those of dv/h do") {
  // the exact motion, known at the ends of steps, and its exact impacts: what is left is the error of the spectra alone
  const auto exact = exact_psa();
  for (const double dt : {1e-3, 5e-4, 1e-4}) {
    CAPTURE(dt);
    CHECK(largest_difference(exact_motion_psa(dt, true), exact) < 0.005);
  }
  CHECK(largest_difference(exact_motion_psa(1e-3, false), exact_motion_psa(1e-4, false)) > 0.3);
}

TEST_CASE("floor spectra of a run are off by no more than the scheme's own error of the impacts, which is first order") {
  // an impact is found within a step and a half: its velocity, and with it the spectrum of stiff oscillators, is within
  // a dt = 9.2 m/s2 dt of -0.27 m/s, 3.4 % at 1 ms
  const auto exact = exact_psa();
  CHECK(largest_difference(pull_back_psa(1e-3, true), exact) < 0.034);
  CHECK(largest_difference(pull_back_psa(5e-4, true), exact) < 0.017);
  CHECK(largest_difference(pull_back_psa(1e-4, true), exact) < 0.0034);
  CHECK(largest_difference(pull_back_psa(1e-3, false), exact) > 0.3);  // by dv/h
}

TEST_CASE("on a floor in harmonic motion the spectrum is that of the closed form") {
  const Model model = free_node();
  const double W = 2 * pi * 3, amplitude = 2, h = 1e-3, xi = 0.05;  // a = amplitude sin W t
  const std::vector<double> some = logarithmic_periods(0.05, 2, 12);
  FloorSpectra spectra({{"s0.1"}, some, xi}, h);
  const auto velocity = [&](double t) { return amplitude / W * (1 - std::cos(W * t)); };
  spectra.start(model, moving(0, 0));
  for (int i = 0; i < 3000; ++i) spectra.step(moving(i * h, velocity(i * h)), moving((i + 1) * h, velocity((i + 1) * h)), {}, {});
  for (std::size_t k = 0; k < some.size(); ++k) {
    CAPTURE(some[k]);
    // steady C sin W t + D cos W t, and the free motion that starts from rest with it
    const double w = 2 * pi / some[k], q = w * w - W * W, c = 2 * xi * w * W, scale = -amplitude / (q * q + c * c);
    const double C = scale * q, D = -scale * c;
    const FreeOscillator free{w, xi};
    double peak = 0;
    for (int i = 0; i <= 300000; ++i) {
      const double t = 1e-5 * i;
      peak = std::max(peak, std::abs(C * std::sin(W * t) + D * std::cos(W * t) + free.at(-D, -C * W, t)[0]));
    }
    // the acceleration is its mean over each step: (W h)^2 / 24 = 1.5e-5, and the cubic between steps 2e-5 at 0.05 s
    CHECK(spectra.displacement(0, 0)[k] == doctest::Approx(peak).epsilon(5e-5));
    CHECK(spectra.displacement(0, 1)[k] == 0);
  }
}

TEST_CASE("a floor that follows the ground has the ground's spectrum") {
  const Scene scene = example_scene("two_story_elastic");
  const Model model = free_node(scene.model.motions);
  const MotionDescription& record = scene.model.motions[0];
  const std::vector<double> some = logarithmic_periods(0.05, 4, 12);
  const double h = 1e-3;
  FloorSpectra spectra({{"floors"}, some, 0.05}, h);
  spectra.start(model, moving(0, 0));
  const auto steps = static_cast<int>(std::lround(record.dt / h * double(record.acceleration.size() - 1)));
  for (int i = 0; i < steps; ++i) spectra.step(moving(i * h, 0), moving((i + 1) * h, 0), {}, {});
  Oscillators ground(some.size());
  const OscillatorStep step(some, 0.05, record.dt);
  for (std::size_t i = 0; i + 1 < record.acceleration.size(); ++i) ground.advance(step, record.acceleration[i], record.acceleration[i + 1]);
  for (std::size_t k = 0; k < some.size(); ++k) {
    CAPTURE(some[k]);
    CHECK(spectra.displacement(0, 0)[k] == doctest::Approx(ground.peak()[k]).epsilon(5e-4));  // cubic, pieces of w h <= 1/2
  }
}

TEST_CASE("floors are the centres of the slabs, and maxima and file agree") {
  const TemporaryFolder folder;
  const Scene scene = example_scene("two_story_elastic", {"analysis.duration=3 s", "analysis.theta=0.5"});
  const Model model = model_of(scene);
  Simulation simulation(model, scene.analysis);
  FloorSpectra spectra(*scene.output.floor_spectra, scene.analysis.dt);
  HistoryFile history(folder / "results.h5", scene.output, "", &spectra);
  simulation.run({&history, &spectra});
  CHECK(spectra.nodes() == std::vector<std::string>{"left.15", "left.25", "right.15", "right.25"});
  const Hdf5Reader file(folder / "results.h5");
  CHECK(file.texts("/floor_spectra/node") == spectra.nodes());
  CHECK(file.shape("/floor_spectra/pseudo_acceleration") == std::vector<hsize_t>{4, 3, 60});
  CHECK(file.units("/floor_spectra/pseudo_acceleration") == "m/s2");
  CHECK(file.units("/floor_spectra/pseudo_velocity") == "m/s");
  CHECK(file.attribute("/floor_spectra", "damping") == 0.05);
  const auto period = file.numbers("/floor_spectra/period"), psa = file.numbers("/floor_spectra/pseudo_acceleration"),
             psv = file.numbers("/floor_spectra/pseudo_velocity"), displacement = file.numbers("/floor_spectra/displacement");
  CHECK(period.front() == 0.02);
  CHECK(period.back() == 4);
  for (std::size_t i = 0; i < psa.size(); ++i) {
    const double w = 2 * pi / period[i % 60];
    CHECK(psv[i] == doctest::Approx(w * displacement[i]).epsilon(1e-14));
    CHECK(psa[i] == doctest::Approx(w * psv[i]).epsilon(1e-14));
  }
  const auto peaks = spectra.peaks();
  REQUIRE(peaks.size() == 12);
  for (std::size_t i = 0; i < peaks.size(); ++i) {
    const auto begin = psa.begin() + static_cast<long>(60 * i);
    const auto most = std::max_element(begin, begin + 60);
    CHECK(peaks[i].node == spectra.nodes()[i / 3]);
    CHECK(peaks[i].psa == *most);
    CHECK(peaks[i].psa_period == period[static_cast<std::size_t>(most - begin)]);
  }
  // the stiffest oscillator moves with its floor: no less than the floor's own smooth acceleration, here of the roofs
  CHECK(peaks[3].psa > peaks[0].psa);
}

TEST_CASE("periods below ten steps are warned of") {
  CHECK(spectrum_warnings(FloorSpectra({{"floors"}, {0.01, 1}, 0.05}, 1e-3), 1e-3).empty());
  const auto warnings = spectrum_warnings(FloorSpectra({{"floors"}, {0.009, 1}, 0.05}, 1e-3), 1e-3);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].find("below a period of 0.01 s") != std::string::npos);
}
