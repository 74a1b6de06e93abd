#include "integrators/algorithms.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <map>

#include "base/diagnostics.hpp"
#include "base/errors.hpp"

namespace nsframe {

namespace {

const std::map<std::string, std::function<std::unique_ptr<Algorithm>()>>& algorithms() {
  static const std::map<std::string, std::function<std::unique_ptr<Algorithm>()>> algorithms{
      {"newton", make_newton},
      {"modified", [] { return make_modified_newton(Tangent::current); }},
      {"initial", [] { return make_modified_newton(Tangent::initial); }},
      {"line-search", make_line_search},
      {"krylov", make_krylov},
      {"broyden", make_broyden},
      {"bfgs", make_bfgs},
  };
  return algorithms;
}

}  // namespace

std::vector<std::string> algorithm_names() {
  std::vector<std::string> names;
  for (const auto& entry : algorithms()) names.push_back(entry.first);
  return names;
}

std::vector<std::string> algorithm_choices() {
  std::vector<std::string> names = algorithm_names();
  names.insert(names.begin(), "auto");
  return names;
}

std::unique_ptr<Algorithm> make_algorithm(const std::string& name) {
  const auto found = algorithms().find(name);
  if (found == algorithms().end()) {
    throw InputError(fmt::format("error: algorithm '{}' is not known{}", name, did_you_mean(name, algorithm_names())));
  }
  return found->second();
}

Ladder::Ladder(const std::vector<std::string>& choice) {
  const bool automatic = choice.empty() || choice == std::vector<std::string>{"auto"};
  for (const std::string& name : automatic ? std::vector<std::string>{"newton", "line-search", "krylov", "initial"} : choice) {
    rungs_.push_back({name, make_algorithm(name)});
  }
}

namespace {

// Iterations after which elements no longer carry what they have out of balance: a step so difficult goes on without.
constexpr int most_carrying = 10;

// Whether R is small enough, also with all elements in balance.
bool accepted(NonlinearStep& step, Attempt& attempt) {
  attempt.error = step.error();
  if (attempt.error > 1) return false;
  step.settle();
  attempt.error = step.error();
  return attempt.error <= 1;
}

// One algorithm from the first guess; false when it does not converge.
bool run(NonlinearStep& step, Algorithm& algorithm, int most, Attempt& attempt) {
  try {
    step.carry(algorithm.evaluates_once());
    step.restart();
    attempt.error = step.error();
    if (step.guess_may_stand() && accepted(step, attempt)) {
      attempt.converged = true;
      return true;
    }
    algorithm.start();
    do {
      if (attempt.iterations >= most) return false;
      if (attempt.iterations == most_carrying) step.carry(false);
      ++attempt.iterations;
      algorithm.iterate(step);
      attempt.converged = accepted(step, attempt);
      if (!std::isfinite(attempt.error)) return false;
    } while (!attempt.converged);
  } catch (const ConvergenceError& problem) {
    attempt.reason = problem.what();
    return false;
  }
  return true;
}

}  // namespace

bool Ladder::climb(NonlinearStep& step, int max_iterations, std::vector<Attempt>& attempts) {
  attempts.clear();
  for (const Rung& rung : rungs_) {
    Attempt& attempt = attempts.emplace_back();
    attempt.algorithm = rung.name;
    if (run(step, *rung.algorithm, max_iterations * rung.algorithm->patience(), attempt)) return true;
  }
  return false;
}

std::string told_residual(double relative, const std::string& worst_element) {
  if (!std::isfinite(relative)) return fmt::format("(the residual is not finite), first in element '{}'", worst_element);
  return fmt::format("(relative residual {:.1e}), largest in element '{}'", relative, worst_element);
}

std::string tried(const std::vector<Attempt>& attempts) {
  std::string text;
  for (const Attempt& attempt : attempts) {
    text += fmt::format("{}{} ({} iteration{}{})", text.empty() ? "" : ", ", attempt.algorithm, attempt.iterations,
                        attempt.iterations == 1 ? "" : "s", attempt.reason.empty() ? "" : ": " + attempt.reason);
  }
  return text;
}

}  // namespace nsframe
