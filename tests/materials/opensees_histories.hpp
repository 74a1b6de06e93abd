// Random histories by OpenSees (tests/reference/opensees_LAW.csv, made by laws.py there): several a file, each after a
// line "# parameters, ..." with the law's parameters in the order of its visit_parameters(); nan: left out.
#pragma once

#include <algorithm>
#include <cmath>

#include "tests/materials/point.hpp"

namespace nsframe::test {

struct ReferenceHistory {
  std::vector<double> parameters;
  Table rows;  // strain, stress, tangent
};

inline std::vector<ReferenceHistory> read_histories(const std::string& law) {
  const std::string path = std::string(NSFRAME_SOURCE_DIR) + "/tests/reference/opensees_" + law + ".csv";
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  const auto numbers = [](const std::string& line) {
    std::vector<double> values;
    std::stringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) values.push_back(std::stod(cell));
    return values;
  };
  const std::string head = "# parameters,";
  std::vector<ReferenceHistory> histories;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(head))
      histories.push_back({numbers(line.substr(head.size())), {}});
    else if (!line.starts_with("#"))
      histories.back().rows.push_back(numbers(line));
  }
  return histories;
}

template <class Law>
Law law_of(const std::vector<double>& parameters) {
  Law law;
  std::size_t i = 0;
  Law::visit_parameters(
      [&](const Parameter&, auto& value) {
        if (i < parameters.size() && !std::isnan(parameters[i])) value = parameters[i];
        ++i;
      },
      law);
  return law;
}

// Largest differences along one history, of stress to the largest stress and of tangent to the initial one.
inline Difference difference_to(const ReferenceHistory& history, const UniaxialLaw& law) {
  double peak = 0;
  for (const auto& row : history.rows) peak = std::max(peak, std::abs(row[1]));
  Difference worst;
  Point point(law);
  for (const auto& row : history.rows) {
    const UniaxialPoint at = point.move(row[0]);
    worst.stress = std::max(worst.stress, std::abs(at.stress - row[1]) / peak);
    worst.tangent = std::max(worst.tangent, std::abs(at.tangent - row[2]) / initial_tangent(law));
  }
  return worst;
}

}  // namespace nsframe::test
