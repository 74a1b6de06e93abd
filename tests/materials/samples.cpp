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
      {"Parallel", Parallel{{inner(steel), inner(ENT{0.1 * E}), inner(ElasticPP{E, yield})}, {0.5, 1, 0.7}}, yield, fy, 22, power},
      {"Series", Series{{inner(steel), inner(Elastic{0.5 * E}), inner(Steel01{0.8 * fy, E, 0.05})}}, 3 * yield, 40 * fy, 22, series},
      {"Series, plastic", Series{{inner(ElasticPP{E, yield}), inner(Elastic{0.2 * E})}}, yield, 40 * fy, 22, series},
      {"MinMax", MinMax{inner(steel), -15 * yield, 18 * yield}, yield, fy, 22, power},
      {"InitStrain", InitStrain{inner(steel), 0.2 * yield}, yield, fy, 22, power},
      {"InitStress", InitStress{inner(steel), -0.3 * fy}, yield, fy, 22, power},
      {"Fatigue", Fatigue{inner(steel)}, yield, fy, 22, power},
      {"nested", MinMax{inner(Parallel{{inner(InitStrain{inner(steel), 0.1 * yield}), inner(Series{{inner(Steel01{fy, E, b}), inner(Elastic{E})}})}}), -19 * yield}, yield, 40 * fy, 22, series},
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
