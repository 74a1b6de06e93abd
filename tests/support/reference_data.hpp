// Reads the tables of tests/reference: lines of comma-separated numbers after comment lines that start with '#'.
#pragma once

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace nsframe::test {

using Table = std::vector<std::vector<double>>;  // rows

inline Table read_reference(const std::string& name) {
  const std::string path = std::string(NSFRAME_SOURCE_DIR) + "/tests/reference/" + name + ".csv";
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  Table table;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::stringstream cells(line);
    std::vector<double> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
    table.push_back(std::move(row));
  }
  return table;
}

}  // namespace nsframe::test
