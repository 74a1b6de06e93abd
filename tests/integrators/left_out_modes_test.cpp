// Modes above analysis.highest_frequency: what is left moves as the kept modes do in closed form, rests where the whole model does, and
// meets others with the mass of the kept modes.
#include <doctest/doctest.h>

#include <cmath>

#include "base/errors.hpp"
#include "tests/integrators/oscillators.hpp"
#include "tests/integrators/runs.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

// Masses on a line, each on a spring behind the one before, the first on the ground; free in x only.
struct Chain {
  std::vector<double> masses{100, 200, 150}, stiffness{1e5, 2e5, 4e5};
  VectorX frequency;  // circular
  MatrixX shape;

  Chain() {
    MatrixX K = MatrixX::Zero(3, 3);
    for (int i = 0; i < 3; ++i) {
      const double k = stiffness[static_cast<std::size_t>(i)];
      K(i, i) += k;
      if (i == 0) continue;
      K(i - 1, i - 1) += k;
      K(i, i - 1) = K(i - 1, i) = -k;
    }
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixX> eigen(K, MatrixX(Eigen::Map<const VectorX>(masses.data(), 3).asDiagonal()));
    frequency = eigen.eigenvalues().cwiseSqrt();
    shape = eigen.eigenvectors();
  }

  // With springs of a law where one is given, and dashpots of `relaxation` times their stiffness.
  ModelDescription model(const std::vector<UniaxialLaw>& laws = {}, double relaxation = 0) const {
    ModelDescription d;
    StructureDescription s;
    s.name = "s";
    s.at = at(1);
    for (std::size_t i = 0; i < masses.size(); ++i) {
      const std::string id = std::to_string(i + 1);
      s.nodes.push_back(node(id, static_cast<double>(i), 0, 0));
      s.supports.push_back(fixed(id, {false, true, true, true, true, true}));
      s.masses.push_back(mass(id, masses[i]));
      SpringDescription spring = ground_spring("k" + id, id, stiffness[i] * Vector6::Unit(0));
      if (i > 0) {
        spring.node_i = {std::to_string(i), {}};
        spring.node_j = Reference{id, {}};
      }
      if (!laws.empty()) {
        d.materials.push_back({"law" + id, {}, laws[i]});
        spring.stiffness.setZero();
        spring.law[0] = Reference{"law" + id, {}};
      }
      spring.damping[0] = relaxation * stiffness[i];
      s.springs.push_back(spring);
    }
    d.structures = {s};
    return d;
  }
};

AnalysisOptions up_to(double circular_frequency, const std::string& scheme, double dt, double duration) {
  AnalysisOptions o = by_scheme(scheme, dt, duration);
  o.highest_frequency = circular_frequency / (2 * pi);
  return o;
}

}  // namespace

TEST_CASE("left-out modes: what is kept moves as its modes in closed form, by exact and by exponential") {
  const Chain chain;
  ModelDescription d = chain.model();
  d.structures[0].initial_velocities = {{{"3", {}}, 0, 2.0}};
  for (int kept = 1; kept <= 3; ++kept) {
    const double highest = kept < 3 ? std::sqrt(chain.frequency[kept - 1] * chain.frequency[kept]) : 2 * chain.frequency[2];
    for (const std::string scheme : {"exact", "exponential"}) {
      const Run ours = completed(d, up_to(highest, scheme, 0.01, 2));
      CAPTURE(kept);
      CAPTURE(scheme);
      CHECK(ours.summary.left_out_modes == 3 - kept);
      double error = 0, largest = 0;
      for (const State& state : ours.states) {
        if (state.time == 0) continue;
        for (int i = 0; i < 3; ++i) {
          double x = 0;
          for (int k = 0; k < kept; ++k) {
            const double w = chain.frequency[k];
            x += chain.shape(i, k) * chain.shape(2, k) * chain.masses[2] * 2.0 * std::sin(w * state.time) / w;
          }
          error = std::max(error, std::abs(state.displacement[i] - x));
          largest = std::max(largest, std::abs(x));
        }
      }
      CHECK(error < 1e-12 * largest);
    }
  }
}

TEST_CASE("left-out modes: they follow static loads at once, so that the rest is that of the whole model") {
  const Chain chain;
  ModelDescription d = chain.model({}, 5e-3);
  d.gravity.acceleration = Vector3(9.81, 0, 0);
  const Run ours = completed(d, up_to(1.1 * chain.frequency[0], "exact", 0.05, 40));
  double load = 0, rest = 0;
  for (std::size_t i = chain.masses.size(); i-- > 0;) load += 9.81 * chain.masses[i];
  for (std::size_t i = 0; i < chain.masses.size(); ++i) {
    rest += load / chain.stiffness[i];
    load -= 9.81 * chain.masses[i];
    CHECK(ours.states.back().displacement[static_cast<Eigen::Index>(i)] == doctest::Approx(rest).epsilon(1e-10));
  }
}

TEST_CASE("left-out modes: what yields is followed to the rest of the whole model") {
  // monotonic by damping: the bilinear springs end where equilibrium alone says
  const Chain chain;
  std::vector<UniaxialLaw> laws;
  std::vector<double> yield{2500, 2500, 1200};
  for (std::size_t i = 0; i < 3; ++i) laws.emplace_back(Hardening{chain.stiffness[i], yield[i], 0, 0.25 * chain.stiffness[i]});
  ModelDescription d = chain.model(laws, 0.4);
  d.gravity.acceleration = Vector3(9.81, 0, 0);
  d.gravity.statically_first = false;
  const Run ours = completed(d, up_to(1.1 * chain.frequency[0], "exponential", 0.02, 60));
  CHECK(ours.summary.left_out_modes == 2);
  CHECK(ours.summary.worst_balance_error < 1e-12);
  double load = 9.81 * (100 + 200 + 150), rest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double k = chain.stiffness[i], soft = k * 0.25 / 1.25;
    rest += load > yield[i] ? yield[i] / k + (load - yield[i]) / soft : load / k;
    load -= 9.81 * chain.masses[i];
    CHECK(ours.states.back().displacement[static_cast<Eigen::Index>(i)] == doctest::Approx(rest).epsilon(1e-6));
  }
}

TEST_CASE("left-out modes: a wall is met with the mass of the kept modes") {
  const Chain chain;
  ModelDescription d = chain.model();
  d.structures[0].initial_velocities = {{{"3", {}}, 0, 2.0}};
  d.contacts = {wall("s.3", 0.01, 0.5)};
  const Run ours = completed(d, up_to(std::sqrt(chain.frequency[0] * chain.frequency[1]), "exact", 1e-3, 0.5));
  REQUIRE(!ours.summary.impacts.empty());
  const double shape = chain.shape(2, 0), w = chain.frequency[0], amplitude = shape * chain.masses[2] * 2.0 / w;
  const double at = std::asin(0.01 / (shape * amplitude)) / w, approach = shape * amplitude * w * std::cos(w * at);
  const Impact& first = ours.summary.impacts[0];
  CHECK(first.time == doctest::Approx(at).epsilon(1e-10));
  CHECK(first.approach_velocity == doctest::Approx(approach).epsilon(1e-10));
  CHECK(first.impulse == doctest::Approx(1.5 * approach / (shape * shape)).epsilon(1e-10));
  for (const State& state : ours.states) CHECK(state.displacement[2] < 0.01 + 1e-12);
}

TEST_CASE("left-out modes: the kept part of the shaken mass, and what is refused") {
  const Chain chain;
  ModelDescription d = chain.model();
  MotionDescription motion;
  motion.dt = 0.5;
  motion.acceleration = {0, 1, 0};
  d.motions = {motion};
  const double between = std::sqrt(chain.frequency[0] * chain.frequency[1]);
  const Run ours = completed(d, up_to(between, "exact", 0.01, 1));
  const VectorX m = Eigen::Map<const VectorX>(chain.masses.data(), 3);
  CHECK(ours.summary.kept_mass == doctest::Approx(std::pow(chain.shape.col(0).dot(m), 2) / 450).epsilon(1e-12));
  const auto refusal = [](const ModelDescription& description, const AnalysisOptions& options) -> std::string {
    try {
      run(description, options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  CHECK(refusal(d, up_to(between, "moreau-jean", 0.01, 1)).find("analysis.highest_frequency needs scheme = \"exact\" or \"exponential\"") != std::string::npos);
  d.contacts = {wall("s.3", 0.01, 0.5)};
  const std::string still = refusal(d, up_to(0.5 * chain.frequency[0], "exact", 0.01, 1));
  CHECK_MESSAGE(still.find("can move by modes up to analysis.highest_frequency") != std::string::npos, still);
}
