// The penalty laws of Langlade et al. (2021), Table 1, written down apart from the program, and the models of their tests.
#pragma once

#include <cmath>

#include "tests/integrators/oscillators.hpp"
#include "tests/support/free_masses.hpp"

namespace nsframe::test {

// A law of Table 1 by its own formula, with constants found by nobody else.
struct TableLaw {
  const char* name;
  double stiffness;                                                         // k_s or k_h of the runs below
  std::function<double(double k, double m, double d, double rate, double v)> force;  // e = 0.6
};

inline const std::vector<TableLaw>& table() {
  static const double log_e = std::log(0.6), lve = -log_e / std::sqrt(pi * pi + log_e * log_e);
  static const double jankowski = 9 * std::sqrt(5.0) / 2 * (1 - 0.36) / (0.6 * (0.6 * (9 * pi - 16) + 16));
  // roots of ln 0.6 = -xi arccos(xi) / sqrt(1 - xi^2), found by hand; Khatami's by xi sqrt(5/4)
  static const double mlve = [] {
    double low = 0, high = 0.99;
    for (int i = 0; i < 100; ++i) {
      const double xi = 0.5 * (low + high);
      (xi * std::acos(xi) / std::sqrt(1 - xi * xi) < -log_e ? low : high) = xi;
    }
    return low;
  }();
  const auto nlve = [](double xi) {
    return [xi](double k, double m, double d, double rate, double) {
      return k * std::pow(d, 1.5) + (rate > 0 ? 2 * xi * std::sqrt(k * std::sqrt(d) * m) * rate : 0);
    };
  };
  static const std::vector<TableLaw> laws{
      {"linear-viscoelastic", 5e6,
       [](double k, double m, double d, double rate, double) { return k * d + 2 * lve * std::sqrt(k * m) * rate; }},
      {"modified-linear-viscoelastic", 5e6,
       [](double k, double m, double d, double rate, double) { return k * d + (rate > 0 ? 2 * mlve * std::sqrt(k * m) * rate : 0); }},
      {"hertz", 6e7, [](double k, double, double d, double, double) { return k * std::pow(d, 1.5); }},
      {"hertz-damped", 6e7,
       [](double k, double, double d, double rate, double v) {
         return std::max(0.0, k * std::pow(d, 1.5) * (1 + 8 * 0.4 / (5 * 0.6 * v) * rate));
       }},
      {"jankowski", 6e7, nlve(jankowski)},
      {"khatami", 6e7, nlve(mlve * std::sqrt(1.25))},
  };
  return laws;
}

inline ContactLawChoice choice(const TableLaw& law) {
  ContactLawChoice out;
  out.name = law.name;
  (contact_force_law(law.name)->stiffness == ContactStiffness::hertz ? out.hertz_stiffness : out.stiffness) = law.stiffness;
  return out;
}

// The pull-back of the paper's Table 3, without damping of the structures.
inline ModelDescription pull_back(const ContactLawChoice& law, double e = 0.6) {
  ModelDescription d = linear_oscillator(4600, 2.11e6, 0, -0.024);
  d.structures.push_back(linear_oscillator(3500, 5.31e6, 0).structures[0]);
  d.structures[1].name = "r";
  ContactDescription c = wall("s.1", 0.02, e);
  c.b = Reference{"r.1", {}};
  c.law = law;
  d.contacts = {c};
  return d;
}

inline PenaltyPair pull_back_pair(const TableLaw& law) {
  PenaltyPair pair;
  pair.mass = {4600, 3500};
  pair.stiffness = {2.11e6, 5.31e6};
  pair.open = 0.02;
  pair.start = {-0.024, 0, 0, 0};
  const double m = 4600.0 * 3500 / 8100;
  pair.force = [law, m](double d, double rate, double v) { return law.force(law.stiffness, m, d, rate, v); };
  return pair;
}

// The paper's ball on a wall.
inline ModelDescription ball(const ContactLawChoice& law) {
  ModelDescription d = single_mass(1);
  d.structures[0].may_move_freely = true;
  d.gravity = {Vector3(2, 0, 0), false};
  d.contacts = {wall("s.1", 1, 0.6)};
  d.contacts[0].law = law;
  return d;
}

inline double largest_difference(const Run& run, const PenaltyMotion& exact, int masses, int every = 1) {
  double error = 0;
  for (std::size_t i = 0; i < exact.samples.size(); ++i) {
    const std::size_t step = i * static_cast<std::size_t>(every);
    if (step >= run.states.size()) break;
    for (int m = 0; m < masses; ++m) {
      error = std::max(error, std::abs(run.states[step].displacement[m] - exact.samples[i][static_cast<std::size_t>(m)]));
    }
  }
  return error;
}

}  // namespace nsframe::test
