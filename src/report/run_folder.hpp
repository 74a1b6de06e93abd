// What `nsframe run` left in a folder: summary.json, and results.h5 with what stands where.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "output/hdf5_reader.hpp"

namespace nsframe {

// /model of results.h5 (output/model_tables.hpp). Nodes are indices.
struct DrawnModel {
  struct Member {
    std::string id;
    int nodes[2];
    double ends[6];  // [m]
    bool curved;
  };
  struct Level {
    int structure;
    double level;  // z [m]
    std::vector<int> nodes;
  };
  struct Pair {
    double position[3];  // [m]; of the structure's side where the other is a wall
    double normal[3];
    double gap;          // at rest without loads [m]
    int structures[2];   // -1: a wall
  };

  std::vector<std::string> structures, nodes;
  std::vector<double> position;  // 3 a node [m]
  std::vector<int> structure;    // of each node
  std::vector<Member> members;
  std::vector<std::vector<int>> slabs;
  std::vector<Level> floors;  // structure by structure, from the lowest
  std::vector<Pair> pairs;

  std::size_t size() const { return nodes.size(); }
};

struct RunFolder {
  // Throws InputError when it is no folder of a run, IoError when a file of it cannot be read.
  explicit RunFolder(const std::filesystem::path& folder);

  // Leaves the rows from `from` to `to` [s] only. Throws InputError when there are fewer than two.
  void limit(double from, double to);
  // Rows [first, first + count) of those left, of a history.
  void read_rows(const std::string& name, std::size_t first, std::size_t count, std::vector<double>& values) const {
    results.read_rows(name, first_row + first, count, values);
  }

  nlohmann::json summary;
  Hdf5Reader results;
  DrawnModel model;
  std::vector<double> time;   // of the rows of histories [s]
  std::size_t first_row = 0;  // of `time` in results.h5
  std::vector<int> recorded;  // nodes with histories, in the order of results.h5
};

}  // namespace nsframe
