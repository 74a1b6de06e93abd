#include "materials/uniaxial.hpp"

#include <algorithm>
#include <type_traits>

namespace nsframe {

namespace {

void append(std::vector<double>& values, double value) { values.push_back(value); }

template <class Law>
using ScalarHistory = typename Law::template History<double>;

// The values of a law's parameters as one comparable list.
template <class Law>
auto parameter_values(const Law& law) {
  std::vector<double> values;
  Law::visit_parameters([&values](const Parameter&, const auto& value) { append(values, value); }, law);
  return values;
}

}  // namespace

int history_size(const UniaxialLaw& law) {
  return std::visit([](const auto& l) { return history_doubles<std::decay_t<decltype(l)>>; }, law);
}

void initialize_history(const UniaxialLaw& law, double* history) {
  std::visit(
      [history](const auto& l) {
        const auto virgin = l.virgin();
        std::copy_n(reinterpret_cast<const double*>(&virgin), history_doubles<std::decay_t<decltype(l)>>, history);
      },
      law);
}

UniaxialPoint respond(const UniaxialLaw& law, double strain, const double* committed, double* trial) {
  return std::visit(
      [=](const auto& l) {
        using Law = std::decay_t<decltype(l)>;
        ScalarHistory<Law> history;
        std::copy_n(committed, history_doubles<Law>, reinterpret_cast<double*>(&history));
        const auto response = HWY_NAMESPACE::respond(l, strain, history);
        std::copy_n(reinterpret_cast<const double*>(&response.history), history_doubles<Law>, trial);
        return UniaxialPoint{response.stress, response.tangent};
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
void check_parameters(const UniaxialLaw& law) {
  std::visit([](const auto& l) { check_parameters_of(l); }, law);
}

bool same_law(const UniaxialLaw& a, const UniaxialLaw& b) {
  if (a.index() != b.index()) return false;
  return std::visit(
      [&b](const auto& law) {
        return parameter_values(law) == parameter_values(std::get<std::decay_t<decltype(law)>>(b));
      },
      a);
}

std::vector<std::string> law_names() {
  std::vector<std::string> names;
  for_each_law([&names](const auto& law) { names.emplace_back(law.name); });
  return names;
}

}  // namespace nsframe
