#include "study/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/errors.hpp"

namespace nsframe {

HistoryRecorder::HistoryRecorder(std::vector<int> nodes, double interval, double dt)
    : nodes_(std::move(nodes)), every_(std::max(1L, std::lround(interval / dt))) {}

void HistoryRecorder::keep(const State& state) {
  const VectorX full = model_->dofs.expand(state.displacement);
  VectorX row(3 * static_cast<Eigen::Index>(nodes_.size()));
  for (std::size_t i = 0; i < nodes_.size(); ++i) row.segment<3>(3 * static_cast<Eigen::Index>(i)) = full.segment<3>(6 * nodes_[i]);
  rows_.push_back(std::move(row));
}

void HistoryRecorder::start(const Model& model, const State& state) {
  model_ = &model;
  rows_.clear();
  keep(state);
}

void HistoryRecorder::step(const State&, const State& after, const StepReport& report, const Energy&) {
  if (report.step % every_ == 0) keep(after);
}

double common_interval(const std::vector<double>& steps, double duration) {
  constexpr double tick = 1e-12;  // [s]
  long long ticks = 1;
  for (const double step : steps) {
    ticks = std::lcm(ticks, std::max(1LL, std::llround(step / tick)));
    if (static_cast<double>(ticks) * tick > duration / 10) {
      throw InputError(fmt::format("error: --vary: the steps dt share no times to compare at, or fewer than ten over {:g} s: take "
                                   "steps that divide each other", duration));
    }
  }
  return static_cast<double>(ticks) * tick;
}

double largest(const std::vector<VectorX>& rows) {
  double most = 0;
  for (const VectorX& row : rows) most = std::max(most, row.lpNorm<Eigen::Infinity>());
  return most;
}

double largest_difference(const std::vector<VectorX>& a, const std::vector<VectorX>& b) {
  double most = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) most = std::max(most, (a[i] - b[i]).lpNorm<Eigen::Infinity>());
  return most;
}

Matches match(const std::vector<Pounding>& reference, const std::vector<Pounding>& run, double window) {
  std::vector<bool> used(run.size());
  Matches out;
  for (const Pounding& wanted : reference) {
    std::size_t best = run.size();
    for (std::size_t i = 0; i < run.size(); ++i) {
      const double away = std::abs(run[i].time - wanted.time);
      if (used[i] || run[i].pair != wanted.pair || away >= window) continue;
      if (best == run.size() || away < std::abs(run[best].time - wanted.time)) best = i;
    }
    if (best == run.size()) {
      ++out.missed;
    } else {
      used[best] = true;
      ++out.matched;
    }
  }
  out.extra = static_cast<int>(run.size()) - out.matched;
  return out;
}

}  // namespace nsframe
