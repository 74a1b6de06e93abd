#include "materials/uniaxial.hpp"

#include <bit>
#include <type_traits>

namespace nsframe {

namespace {

template <class Law>
using ScalarHistory = typename Law::template History<double>;

template <class Law>
constexpr int history_doubles = static_cast<int>(sizeof(ScalarHistory<Law>) / sizeof(double));

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
bool is_linear(const UniaxialLaw& law) { return std::holds_alternative<Elastic>(law); }
void check_parameters(const UniaxialLaw& law) {
  std::visit([](const auto& l) { l.check(); }, law);
}

}  // namespace nsframe
