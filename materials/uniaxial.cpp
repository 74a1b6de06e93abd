#include "materials/uniaxial.hpp"

#include <algorithm>
#include <cmath>

namespace nsframe {

namespace {

template <class Law>
using ScalarHistory = typename Law::template History<double>;

template <PlainLaw Law>
UniaxialPoint respond_plain(const Law& law, double strain, const double* committed, double* trial, int stride) {
  ScalarHistory<Law> history;
  auto* const before = reinterpret_cast<double*>(&history);
  for (int k = 0; k < history_doubles<Law>; ++k) before[k] = committed[k * stride];
  const auto response = HWY_NAMESPACE::respond(law, strain, history);
  const auto* const after = reinterpret_cast<const double*>(&response.history);
  for (int k = 0; k < history_doubles<Law>; ++k) trial[k * stride] = after[k];
  return {response.stress, response.tangent};
}

void respond_wrapped(const WrappedLaw& law, const PointArrays& points) { respond_points(law.law, points); }

// The values of a law's parameters as one comparable list, laws inside with theirs.
void append(std::vector<double>& values, double value) { values.push_back(value); }
void append(std::vector<double>& values, const std::optional<double>& value) {
  values.push_back(value ? 1 : 0);
  values.push_back(value.value_or(0));
}
void append(std::vector<double>& values, const InnerLaw& law);
template <class Value>
void append(std::vector<double>& values, const std::vector<Value>& list) {
  values.push_back(static_cast<double>(list.size()));
  for (const Value& value : list) append(values, value);
}
void append_parameters(std::vector<double>& values, const UniaxialLaw& law) {
  values.push_back(static_cast<double>(law.index()));
  std::visit(
      [&values](const auto& l) {
        std::decay_t<decltype(l)>::visit_parameters(
            [&values](const Parameter&, const auto& value) { append(values, value); }, l);
      },
      law);
}
void append(std::vector<double>& values, const InnerLaw& law) {
  if (law.law) append_parameters(values, law.law->law);
}

}  // namespace

InnerLaw inner(UniaxialLaw law) { return {{}, std::make_shared<const WrappedLaw>(WrappedLaw{std::move(law)})}; }

int history_size(const UniaxialLaw& law) {
  return std::visit(
      [](const auto& l) {
        using Law = std::decay_t<decltype(l)>;
        if constexpr (PlainLaw<Law>)
          return history_doubles<Law>;
        else
          return l.history_size();
      },
      law);
}

void initialize_history(const UniaxialLaw& law, double* history) {
  std::visit(
      [history](const auto& l) {
        using Law = std::decay_t<decltype(l)>;
        if constexpr (PlainLaw<Law>) {
          const auto virgin = l.virgin();
          std::copy_n(reinterpret_cast<const double*>(&virgin), history_doubles<Law>, history);
        } else {
          l.initialize_history(history);
        }
      },
      law);
}

UniaxialPoint respond(const UniaxialLaw& law, double strain, const double* committed, double* trial) {
  return std::visit(
      [=](const auto& l) {
        if constexpr (PlainLaw<std::decay_t<decltype(l)>>) {
          return respond_plain(l, strain, committed, trial, 1);
        } else {
          UniaxialPoint point;
          l.respond({1, &strain, committed, trial, 1, &point.stress, &point.tangent}, respond_wrapped);
          return point;
        }
      },
      law);
}

void respond_points(const UniaxialLaw& law, const PointArrays& p) {
  std::visit(
      [&p](const auto& l) {
        for (int i = 0; i < p.count; ++i) {
          if constexpr (PlainLaw<std::decay_t<decltype(l)>>) {
            const UniaxialPoint point = respond_plain(l, p.strain[i], p.committed + i, p.trial + i, p.stride);
            p.stress[i] = point.stress;
            p.tangent[i] = point.tangent;
          } else {
            l.respond(p.point(i), respond_wrapped);
          }
        }
      },
      law);
}

double initial_tangent(const UniaxialLaw& law) {
  return std::visit([](const auto& l) { return l.initial_tangent(); }, law);
}
double yield_strain(const UniaxialLaw& law) {
  return std::visit([](const auto& l) { return l.yield_strain(); }, law);
}
bool is_linear(const UniaxialLaw& law) {
  return std::visit(
      [](const auto& l) {
        if constexpr (requires { l.is_linear(); }) return l.is_linear();
        return false;
      },
      law);
}

bool has_yielded(const UniaxialLaw& law, double strain, double stress) {
  return std::visit(
      [=](const auto& l) {
        if constexpr (requires { l.has_yielded(strain, stress); }) return l.has_yielded(strain, stress);
        const double E = l.initial_tangent();
        return E > 0 && std::abs(strain - stress / E) > 0.1 * l.yield_strain();
      },
      law);
}

bool is_rate_dependent(const UniaxialLaw& law) {
  return std::visit([](const auto& l) { return RateLaw<std::decay_t<decltype(l)>>; }, law);
}

RatePoint respond_rate(const UniaxialLaw& law, double strain, const double* committed, double* trial, const StepSpan& step) {
  return std::visit(
      [&](const auto& l) -> RatePoint {
        if constexpr (RateLaw<std::decay_t<decltype(l)>>) return l.respond_rate(strain, committed, trial, step);
        return {};
      },
      law);
}

double rate_stress(const UniaxialLaw& law, const double* history) { return is_rate_dependent(law) ? history[1] : 0; }

void check_parameters(const UniaxialLaw& law) {
  std::visit([](const auto& l) { check_parameters_of(l); }, law);
}

bool same_law(const UniaxialLaw& a, const UniaxialLaw& b) {
  std::vector<double> first, second;
  append_parameters(first, a);
  append_parameters(second, b);
  return first == second;
}

std::vector<std::string> law_names() {
  std::vector<std::string> names;
  for_each_law([&names](const auto& law) {
    if (std::find(names.begin(), names.end(), law.name) == names.end()) names.emplace_back(law.name);
  });
  return names;
}

}  // namespace nsframe
