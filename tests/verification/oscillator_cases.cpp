// Oscillators of Chopra, Dynamics of Structures.
#include <fmt/format.h>

#include "integrators/simulation.hpp"
#include "spectra/oscillators.hpp"
#include "tests/support/small_models.hpp"
#include "tests/verification/pair_of_masses.hpp"
#include "tests/verification/registry.hpp"
#include "tests/verification/two_story_model.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

constexpr double mass_of_book = 0.2533;  // [kip s2/in]

// Half a sine of 10 kip over 0.6 s in steps of 0.1 s, as base acceleration, on a spring of 10 kip/in with 5 % damping.
std::vector<State> under_half_sine(const SpringDescription& spring) {
  ModelDescription d;
  d.materials = {{"yielding", {}, ElasticPP{10, 0.75}}};
  StructureDescription s = oscillator(0, {mass_of_book, 10, 0});
  s.springs = {spring};
  s.springs[0].damping[0] = 2 * 0.05 * std::sqrt(10 * mass_of_book);
  d.structures = {s};
  MotionDescription motion;
  motion.dt = 0.1;
  for (int i = 0; i <= 10; ++i) motion.acceleration.push_back(i < 6 ? -10 * std::sin(pi * i / 6) / mass_of_book : 0);
  d.motions = {motion};
  const Model model = build(d);
  AnalysisOptions options;
  options.scheme = "moreau-jean";
  options.dt = 0.1;
  options.theta = 0.5;
  options.duration = 1;
  Simulation simulation(model, options);
  Recorder recorder;
  simulation.run({&recorder});
  return recorder.states;
}

void add_displacements(VerificationRows& rows, const std::vector<State>& states, const std::vector<double>& printed) {
  for (std::size_t i = 0; i < printed.size(); ++i) {
    // four decimals are printed, from steps that the book rounds to as many
    rows.add(fmt::format("displacement at {:.1f} s, in", 0.1 * double(i + 1)), states.at(i + 1).displacement[0], printed[i], absolute(2e-4));
  }
}

}  // namespace

VERIFICATION_CASE("Oscillators and time integration", "Half a sine on an elastic oscillator",
                  "m = 0.2533 kip s2/in, k = 10 kip/in, 5 % damping, 10 kip over 0.6 s; average acceleration in steps of 0.1 s is theta = 1/2. "
                  "Chopra, examples 5.3 and 5.4.") {
  add_displacements(rows, under_half_sine(ground_spring("k", "1", 10 * Vector6::Unit(0))), {0.0437, 0.2326, 0.6121, 1.0825, 1.4309, 1.4231});
}

VERIFICATION_CASE("Oscillators and time integration", "Half a sine on an elastoplastic oscillator",
                  "The same, yielding at 7.5 kip. Chopra, examples 5.5 and 5.6.") {
  SpringDescription spring = ground_spring("k", "1", Vector6::Zero());
  spring.law[0] = Reference{"yielding", {}};
  add_displacements(rows, under_half_sine(spring), {0.0437, 0.2326, 0.6121, 1.1143, 1.6214, 1.9891, 2.0951, 1.9240, 1.5602});
}

VERIFICATION_CASE("Spectra", "El Centro 1940, spectral displacements",
                  "The NS component that ships with the examples, exact oscillators; Chopra, section 6.4. The book looks at the ends of the "
                  "record's steps of 0.02 s, and so do these values.") {
  const Scene scene = example_scene("two_story_elastic", {"motion.pga=0.31882 g"});
  const std::vector<double>& record = scene.model.motions.at(0).acceleration;
  struct Printed {
    double period, damping, displacement;  // [s], [-], [in]
  };
  for (const auto& [period, damping, printed] : {Printed{0.5, 0.02, 2.67}, {1, 0.02, 5.97}, {2, 0.02, 7.47}, {2, 0, 9.91}, {2, 0.05, 5.37}}) {
    Oscillators o(1);
    const OscillatorStep step({period}, damping, 0.02);
    double largest = 0;
    for (std::size_t i = 0; i + 1 < record.size(); ++i) {
      o.advance(step, record[i], record[i + 1]);
      largest = std::max(largest, std::abs(o.displacement()[0]));
    }
    rows.add(fmt::format("T = {:g} s, damping {:g} %, in", period, 100 * damping), largest / 0.0254, printed, absolute(0.0055));
  }
}
