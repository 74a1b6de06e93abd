#include "output/sliding_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "models/snapshot.hpp"

namespace nsframe {
namespace {

constexpr int rows = 7;  // of a pair

// n . (rotation x t) = rotation . (t x n): how the face rises along t.
Vector6 slope_along(const Vector3& tangent, const Vector3& normal) {
  Vector6 w = Vector6::Zero();
  w.tail<3>() = tangent.cross(normal);
  return w;
}

SparseRows measures(const Model& model) {
  std::vector<Eigen::Triplet<double>> entries;
  const int count = model.contacts.size();
  for (int i = 0; i < count; ++i) {
    const ContactPair& pair = model.contacts.pairs[static_cast<std::size_t>(i)];
    add_row(pair, pair.normal, rows * i, entries);
    const auto across = tangents(pair.normal);
    for (int k = 0; k < 2; ++k) {
      const Vector3& t = across[static_cast<std::size_t>(k)];
      add_row(pair, t, rows * i + 1 + k, entries);
      if (pair.a.face) add_row(pair.a, slope_along(t, pair.normal), rows * i + 3 + k, entries);
      if (pair.b.face) add_row(pair.b, slope_along(t, pair.normal), rows * i + 5 + k, entries);
    }
  }
  SparseRows full(rows * count, model.dofs.full);
  full.setFromTriplets(entries.begin(), entries.end());
  return full * model.dofs.transformation;
}

double beyond(const SlidingRoom& room, double sliding) { return std::max({0.0, room.least - sliding, sliding - room.most}); }

const char* const snapshot_name = "sliding_watch.faults";

}  // namespace

void SlidingWatch::start(const Model& model, const State&) {
  model_ = &model;
  measures_ = measures(model);
  faults_.assign(static_cast<std::size_t>(model.contacts.size()), {});
}

void SlidingWatch::step(const State&, const State& after, const StepReport&, const Energy&) {
  if (faults_.empty()) return;
  values_.noalias() = measures_ * after.displacement;
  for (int i = 0; i < model_->contacts.size(); ++i) {
    const auto value = values_.segment<rows>(rows * i);
    const ContactPair& pair = model_->contacts.pairs[static_cast<std::size_t>(i)];
    const double gap = model_->contacts.initial_gap[i] + value[0];
    const double error = std::max(std::abs(value[1] * value[3]) + std::abs(value[2] * value[4]),
                                  std::abs(value[1] * value[5]) + std::abs(value[2] * value[6]));
    SlidingFault& fault = faults_[static_cast<std::size_t>(i)];
    if (error > fault.gap_error && gap < error) {
      fault.gap_error = error;
      fault.error_time = after.time;
    }
    const bool touches = gap <= 0 || (i < after.impulse.size() && after.impulse[i] > 0);
    const double off = std::max(beyond(pair.room[0], value[1]), beyond(pair.room[1], value[2]));
    if (touches && off > fault.slid_off) {
      fault.slid_off = off;
      fault.off_time = after.time;
    }
  }
}

void SlidingWatch::save(Snapshot& snapshot) {
  std::vector<double> numbers;
  for (const SlidingFault& f : faults_) numbers.insert(numbers.end(), {f.gap_error, f.error_time, f.slid_off, f.off_time});
  snapshot.put(snapshot_name, numbers);
}

void SlidingWatch::resume(const Model& model, const State& state, const Snapshot& snapshot) {
  start(model, state);
  const auto& numbers = snapshot.array(snapshot_name);
  for (std::size_t i = 0; i < faults_.size() && 4 * i + 3 < numbers.size(); ++i) {
    faults_[i] = {numbers[4 * i], numbers[4 * i + 1], numbers[4 * i + 2], numbers[4 * i + 3]};
  }
}

std::vector<std::string> SlidingWatch::warnings() const {
  std::vector<std::string> out;
  int wrong = 0, off = 0;
  std::size_t worst_wrong = 0, worst_off = 0;
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    if (faults_[i].gap_error > model_->contacts.pairs[i].sliding_error) {
      if (wrong++ == 0 || faults_[i].gap_error > faults_[worst_wrong].gap_error) worst_wrong = i;
    }
    if (faults_[i].slid_off > 0) {
      if (off++ == 0 || faults_[i].slid_off > faults_[worst_off].slid_off) worst_off = i;
    }
  }
  const auto others = [](int count) { return count > 1 ? fmt::format(", and {} more", count - 1) : std::string(); };
  if (wrong > 0) {
    out.push_back(fmt::format("the directions of contact are those at the start: sliding along turned faces makes the gap of '{}' wrong by "
                              "{:.2g} mm at t = {:.4g} s (sliding_error = {:g} mm){}", model_->contacts.pairs[worst_wrong].name,
                              1e3 * faults_[worst_wrong].gap_error, faults_[worst_wrong].error_time,
                              1e3 * model_->contacts.pairs[worst_wrong].sliding_error, others(wrong)));
  }
  if (off > 0) {
    out.push_back(fmt::format("pair '{}' touches after one side has slid {:.2g} mm beyond the other (t = {:.4g} s): in truth they miss{}",
                              model_->contacts.pairs[worst_off].name, 1e3 * faults_[worst_off].slid_off, faults_[worst_off].off_time,
                              others(off)));
  }
  return out;
}

}  // namespace nsframe
