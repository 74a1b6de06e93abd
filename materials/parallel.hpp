// Laws side by side at one strain, their stresses added with factors (OpenSees' Parallel).
#pragma once

#include "materials/wrapper.hpp"

namespace nsframe {

struct Parallel {
  static constexpr const char* name = "Parallel";
  std::vector<InnerLaw> materials = {};
  std::vector<double> factors = {};  // [-]; empty: all 1

  template <class Visit, class Law>
  static void visit_parameters(Visit&& visit, Law& law) {
    using namespace parameter;
    visit(law_inside("materials", "the laws side by side"), law.materials);
    visit(with_default(number("factors", "by which their stresses are multiplied, one each"), "1"), law.factors);
  }
  void check() const;

  int history_size() const;
  void initialize_history(double* history) const;
  double initial_tangent() const;
  double yield_strain() const;
  void respond(const PointArrays& points, Evaluate evaluate) const;

 private:
  double factor(std::size_t i) const { return factors.empty() ? 1 : factors[i]; }
};

}  // namespace nsframe
