// Solution algorithms for one nonlinear step, and the ladder that tries one after the other. A new algorithm is one file
// with a class derived from Algorithm, one line in algorithms.cpp and one test.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "integrators/nonlinear_step.hpp"
#include "models/results.hpp"

namespace nsframe {

class Algorithm {
 public:
  virtual ~Algorithm() = default;
  // Forgets what it knows of an earlier step.
  virtual void start() = 0;
  virtual void iterate(NonlinearStep& step) = 0;
  // How many times the iterations of Newton's method it may take: those with a constant matrix are slower and cheaper.
  virtual int patience() const { return 1; }
  // Whether it asks for R once only at every x, so that elements may carry what they have out of balance (NonlinearStep::carry).
  virtual bool evaluates_once() const { return false; }
};

// Throws InputError for an unknown name.
std::unique_ptr<Algorithm> make_algorithm(const std::string& name);
std::vector<std::string> algorithm_names();
// The names a scene may give: those of the algorithms, and "auto".
std::vector<std::string> algorithm_choices();

// Algorithms that are tried in turn.
class Ladder {
 public:
  // "auto" alone, or nothing, stands for newton, line-search, krylov, initial.
  explicit Ladder(const std::vector<std::string>& choice);
  // From the first guess, until one converges; false when none does. `attempts` tells how each did.
  bool climb(NonlinearStep& step, int max_iterations, std::vector<Attempt>& attempts);

 private:
  struct Rung {
    std::string name;
    std::unique_ptr<Algorithm> algorithm;
  };
  std::vector<Rung> rungs_;
};

// "(relative residual 1.0e-03), largest in element 's.1'", or that the residual is not finite there.
std::string told_residual(double relative, const std::string& worst_element);

// "newton (12 iterations), krylov (90 iterations: the stiffness is singular)".
std::string tried(const std::vector<Attempt>& attempts);

std::unique_ptr<Algorithm> make_newton();
std::unique_ptr<Algorithm> make_modified_newton(Tangent which);
std::unique_ptr<Algorithm> make_line_search();
std::unique_ptr<Algorithm> make_krylov();
std::unique_ptr<Algorithm> make_broyden();
std::unique_ptr<Algorithm> make_bfgs();

}  // namespace nsframe
