#include "models/snapshot.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/errors.hpp"

namespace nsframe {

namespace {

constexpr std::size_t impact_size = 7;  // doubles

}  // namespace

const std::vector<double>& Snapshot::array(const std::string& name) const {
  const auto found = arrays.find(name);
  if (found == arrays.end()) throw IoError(fmt::format("the checkpoint has no '{}'", name));
  return found->second;
}

double Snapshot::number(const std::string& name) const {
  double value = 0;
  copy(name, &value, 1);
  return value;
}

void Snapshot::copy(const std::string& name, double* values, std::size_t size) const {
  const std::vector<double>& stored = array(name);
  if (stored.size() != size) {
    throw IoError(fmt::format("the checkpoint has {} numbers in '{}', the scene needs {}", stored.size(), name, size));
  }
  std::copy(stored.begin(), stored.end(), values);
}

void save(const State& state, Snapshot& snapshot) {
  snapshot.put("state.time", state.time);
  snapshot.put("state.displacement", state.displacement);
  snapshot.put("state.velocity", state.velocity);
  snapshot.put("state.acceleration", state.acceleration);
  snapshot.put("state.internal_force", state.internal_force);
  snapshot.put("state.history", state.history);
  snapshot.put("state.damping_stiffness", state.damping_stiffness);
  snapshot.put("state.impulse", state.impulse);
  snapshot.put("state.contact_episodes", state.contact_episodes);
}

void restore(State& state, const Snapshot& snapshot) {
  state.time = snapshot.number("state.time");
  snapshot.read("state.displacement", state.displacement);
  snapshot.read("state.velocity", state.velocity);
  snapshot.read("state.acceleration", state.acceleration);
  snapshot.read("state.internal_force", state.internal_force);
  snapshot.read("state.history", state.history);
  snapshot.read("state.damping_stiffness", state.damping_stiffness);
  snapshot.read("state.impulse", state.impulse);
  snapshot.read("state.contact_episodes", state.contact_episodes);
}

void save(const std::string& name, const std::vector<Impact>& impacts, Snapshot& snapshot) {
  std::vector<double>& values = snapshot.arrays[name];
  values.clear();
  values.reserve(impact_size * impacts.size());
  for (const Impact& impact : impacts) {
    values.insert(values.end(), {impact.time, double(impact.pair), impact.approach_velocity, impact.impulse,
                                 impact.rate_before, impact.rate_after, impact.duration});
  }
}

std::vector<Impact> restore_impacts(const std::string& name, const Snapshot& snapshot) {
  const std::vector<double>& values = snapshot.array(name);
  std::vector<Impact> impacts;
  for (std::size_t i = 0; i + impact_size <= values.size(); i += impact_size) {
    const double* const v = values.data() + i;
    impacts.push_back({v[0], static_cast<int>(v[1]), v[2], v[3], v[4], v[5], v[6]});
  }
  return impacts;
}

namespace {

// Reads what save() put one after the other; a text is its length and its bytes.
class Tape {
 public:
  explicit Tape(const std::vector<double>& values) : values_(values) {}
  bool done() const { return at_ >= values_.size(); }
  double number() {
    if (done()) throw IoError("the checkpoint's record of the solution algorithms is cut off");
    return values_[at_++];
  }
  int whole() { return static_cast<int>(number()); }
  std::string text() {
    std::string out;
    for (int left = whole(); left > 0; --left) out += static_cast<char>(whole());
    return out;
  }

 private:
  const std::vector<double>& values_;
  std::size_t at_ = 0;
};

void put_text(const std::string& text, std::vector<double>& values) {
  values.push_back(static_cast<double>(text.size()));
  for (const char byte : text) values.push_back(byte);
}

}  // namespace

void save(const std::string& name, const std::vector<LadderRecord>& records, Snapshot& snapshot) {
  std::vector<double>& values = snapshot.arrays[name];
  values.clear();
  for (const LadderRecord& record : records) {
    put_text(record.stage, values);
    values.insert(values.end(), {double(record.step), record.at, double(record.attempts.size())});
    for (const Attempt& attempt : record.attempts) {
      put_text(attempt.algorithm, values);
      values.insert(values.end(), {double(attempt.iterations), double(attempt.converged), attempt.error});
      put_text(attempt.reason, values);
    }
  }
}

std::vector<LadderRecord> restore_ladder(const std::string& name, const Snapshot& snapshot) {
  std::vector<LadderRecord> records;
  for (Tape tape(snapshot.array(name)); !tape.done();) {
    LadderRecord& record = records.emplace_back();
    record.stage = tape.text();
    record.step = tape.whole();
    record.at = tape.number();
    record.attempts.resize(static_cast<std::size_t>(tape.whole()));
    for (Attempt& attempt : record.attempts) {
      attempt.algorithm = tape.text();
      attempt.iterations = tape.whole();
      attempt.converged = tape.number() != 0;
      attempt.error = tape.number();
      attempt.reason = tape.text();
    }
  }
  return records;
}

}  // namespace nsframe
