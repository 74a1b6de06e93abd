#include <doctest/doctest.h>

#include <algorithm>

#include "tests/materials/point.hpp"

namespace nsframe::test {

namespace {

const Steel02 steel{fy, E, b};
// Curves x^R with R <= 20 and x <= 41 yield strains: R log x = 74; their outer power 1 + 1/R adds another 1.05 * 74.
constexpr double power = 152;
// Trial stresses of up to 40 fy that are returned to a yield surface.
constexpr double trial = 40;
// Slopes between two points of a branch at up to 20 yield strains, not nearer than a twentieth of one to each other.
constexpr double branch = 400;
// Strains of laws in series are iterated until stresses agree to 1e-12 of E times strain, up to 20 times the peak
// stress; the last step leaves far less, and the powers count once more.
constexpr double series = 2e4;

}  // namespace

const std::vector<Sample>& samples() {
  static const std::vector<Sample> all = {
      {"Elastic", Elastic{E}},
      {"Elastic, two moduli", Elastic{E, 0.3 * E}},
      {"ElasticPP", ElasticPP{E, yield, 0, 0}},
      {"ElasticPP, uneven", ElasticPP{E, yield, -2 * yield, 0.3 * yield}},
      {"ElasticPPGap", ElasticPPGap{E, fy, 3 * yield, 0.02}},
      {"ElasticPPGap, damage, compression", ElasticPPGap{E, -fy, -3 * yield, 0.02, true}},
      {"ENT", ENT{E}},
      {"Hardening", Hardening{E, fy, 0.01 * E, 0.03 * E}, yield, fy, 120, trial},
      {"Hardening, softening", Hardening{E, fy, 0, -0.02 * E}, yield, fy, 22, trial},
      {"Steel01", Steel01{fy, E, b}},
      {"Steel01, softening", Steel01{fy, E, -0.02}},
      {"Steel01, isotropic", Steel01Isotropic{fy, E, b, 0.05, 1, 0.03, 2}, yield, fy, 22, power},
      {"Steel02", Steel02{fy, E, b}, yield, fy, 22, power},
      {"Steel02, isotropic", Steel02{fy, E, b, 18.5, 0.925, 0.15, 0.04, 1, 0.02, 1, 0}, yield, fy, 22, power},
      {"Steel02, initial stress", Steel02{fy, E, b, 20, 0.925, 0.15, 0, 1, 0, 1, 0.2 * fy}, yield, fy, 22, power},
      {"Concrete01", Concrete01{-30e6, -0.002, -6e6, -0.006}, 5e-4, 30e6, 1.1, trial},
      {"Concrete02", Concrete02{-30e6, -0.002, -6e6, -0.006}, 5e-4, 30e6, 1.1, trial},
      {"Concrete02, strong tension", Concrete02{-30e6, -0.002, -6e6, -0.006, 0.4, 5e6, 1e9}, 5e-4, 30e6, 1.1, trial},
      {"Concrete04", Concrete04{-30e6, -0.002, -0.006, 25e9}, 5e-4, 30e6, 1.1, trial},
      {"Concrete04, tension", Concrete04{-30e6, -0.002, -0.006, 25e9, 3e6, 0.002, 0.05}, 5e-4, 30e6, 1.1, trial},
      {"Hysteretic",
       Hysteretic{fy, yield, 1.2 * fy, 4 * yield, 0.4 * fy, 15 * yield, -fy, -yield, -1.2 * fy, -4 * yield, -0.4 * fy,
                  -15 * yield},
       yield, fy, 1.3, branch},
      {"Hysteretic, pinched and damaged",
       Hysteretic{fy,
                  yield,
                  1.2 * fy,
                  8 * yield,
                  0,
                  18 * yield,
                  -0.5 * fy,
                  -yield,
                  -0.45 * fy,
                  -6 * yield,
                  {},
                  {},
                  0.6,
                  0.3,
                  0.02,
                  0.01,
                  0.3},
       yield, fy, 2.5, branch},
      {"BoucWen", BoucWen{0.05, E, 2, 0.4 / (yield * yield), 0.6 / (yield * yield)}, yield, fy, 2.5, power},
      {"BoucWen, degrading",
       BoucWen{0.05, E, 1.5, 0.3 * std::pow(yield, -1.5), 0.7 * std::pow(yield, -1.5), 1, 1e-4 / (fy * yield),
               1e-2 / (fy * yield), 1e-2 / (fy * yield)},
       yield, fy, 2.5, power},
      {"IMKBilin",
       IMKBilin{E, 5 * yield, 12 * yield, 50 * yield, fy, 1.2, 0.2, 5 * yield, 12 * yield, 50 * yield, fy, 1.2, 0.2,
                300 * yield, 300 * yield, 300 * yield},
       yield, fy, 1.3, power},
      {"IMKBilin, uneven",
       IMKBilin{E, 3 * yield, 8 * yield,   18 * yield,  fy, 1.1, 0,   6 * yield, 20 * yield, 40 * yield, 0.7 * fy,
                1, 0.4,       900 * yield, 700 * yield, 0,  1.2, 0.8, 1,         0.6,        1},
       yield, fy, 1.3, power},
      {"Parallel", Parallel{{inner(steel), inner(ENT{0.1 * E}), inner(ElasticPP{E, yield})}, {0.5, 1, 0.7}}, yield, fy, 22, power},
      {"Series", Series{{inner(steel), inner(Elastic{0.5 * E}), inner(Steel01{0.8 * fy, E, 0.05})}}, 3 * yield, 40 * fy, 22, series},
      {"Series, plastic", Series{{inner(ElasticPP{E, yield}), inner(Elastic{0.2 * E})}}, yield, 40 * fy, 22, series},
      {"MinMax", MinMax{inner(steel), -15 * yield, 18 * yield}, yield, fy, 22, power},
      {"InitStrain", InitStrain{inner(steel), 0.2 * yield}, yield, fy, 22, power},
      {"InitStress", InitStress{inner(steel), -0.3 * fy}, yield, fy, 22, power},
      {"Fatigue", Fatigue{inner(steel)}, yield, fy, 22, power},
      {"nested", MinMax{inner(Parallel{{inner(InitStrain{inner(steel), 0.1 * yield}), inner(Series{{inner(Steel01{fy, E, b}), inner(Elastic{E})}})}}), -19 * yield}, yield, 40 * fy, 22, series},
      {"Viscous, at rest", Viscous{1e6, 0.4}},
      {"ViscousDamper, at rest", ViscousDamper{E, 1e6, 0.4}},
  };
  return all;
}

Difference compare_history(const UniaxialLaw& law, const std::string& file) {
  const Table table = read_reference(file);
  REQUIRE(table.size() == 241);
  double peak = 0;
  for (const auto& row : table) peak = std::max(peak, std::abs(row[1]));
  Difference worst;
  Point point(law);
  for (const auto& row : table) {
    const UniaxialPoint at = point.move(row[0]);
    worst.stress = std::max(worst.stress, std::abs(at.stress - row[1]) / peak);
    worst.tangent = std::max(worst.tangent, std::abs(at.tangent - row[2]) / initial_tangent(law));
  }
  return worst;
}

std::string fault_of(const UniaxialLaw& law) {
  try {
    check_parameters(law);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

}  // namespace nsframe::test
