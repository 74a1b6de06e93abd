// Everything that a run needs to go on later with the same bits: named arrays of doubles. State, time history, scheme
// and observers each fill their own names ("state.displacement", "peaks.velocity", ...) and read them back.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "models/results.hpp"
#include "models/state.hpp"

namespace nsframe {

struct Snapshot {
  std::map<std::string, std::vector<double>> arrays;

  void put(const std::string& name, double value) { arrays[name] = {value}; }
  void put(const std::string& name, const double* values, std::size_t size) { arrays[name].assign(values, values + size); }
  template <class Array>
  void put(const std::string& name, const Array& values) {
    put(name, values.data(), static_cast<std::size_t>(values.size()));
  }

  // All throw IoError when the name is missing; the second and third also when the size is another one.
  const std::vector<double>& array(const std::string& name) const;
  double number(const std::string& name) const;
  template <class Array>
  void read(const std::string& name, Array& values) const {
    copy(name, values.data(), static_cast<std::size_t>(values.size()));
  }

 private:
  void copy(const std::string& name, double* values, std::size_t size) const;
};

void save(const State& state, Snapshot& snapshot);
// `state` has the right sizes already.
void restore(State& state, const Snapshot& snapshot);

void save(const std::string& name, const std::vector<Impact>& impacts, Snapshot& snapshot);
void save(const std::string& name, const std::vector<LadderRecord>& records, Snapshot& snapshot);
std::vector<LadderRecord> restore_ladder(const std::string& name, const Snapshot& snapshot);
std::vector<Impact> restore_impacts(const std::string& name, const Snapshot& snapshot);

}  // namespace nsframe
