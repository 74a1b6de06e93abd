#include <doctest/doctest.h>

#include <algorithm>

#include "tests/materials/point.hpp"

namespace nsframe::test {

const std::vector<Sample>& samples() {
  static const std::vector<Sample> all = {
      {"Elastic", Elastic{E}},
      {"ElasticPP", ElasticPP{E, yield, 0, 0}},
      {"ElasticPP, uneven", ElasticPP{E, yield, -2 * yield, 0.3 * yield}},
      {"Steel01", Steel01{fy, E, b}},
      {"Steel01, softening", Steel01{fy, E, -0.02}},
      {"Steel02", Steel02{fy, E, b}},
      {"Steel02, isotropic", Steel02{fy, E, b, 18.5, 0.925, 0.15, 0.04, 1, 0.02, 1, 0}},
      {"Steel02, initial stress", Steel02{fy, E, b, 20, 0.925, 0.15, 0, 1, 0, 1, 0.2 * fy}},
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
