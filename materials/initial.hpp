// A law that starts from an initial strain or stress (OpenSees' InitStrainMaterial, InitStressMaterial): its strain is
// counted from there, stress(e) = inner(e + e0), and e0 is committed before anything happens.
#pragma once

#include "materials/wrapper.hpp"

namespace nsframe {

struct InitStrain {
  static constexpr const char* name = "InitStrain";
  InnerLaw material = {};
  double epsInit = 0;  // [-]

  template <class Visit, class Law>
  static void visit_parameters(Visit&& visit, Law& law) {
    using namespace parameter;
    visit(law_inside("material", "the law that starts strained"), law.material);
    visit(required(strain("epsInit", "its strain where the element has none")), law.epsInit);
  }
  int history_size() const;
  void initialize_history(double* history) const;
  double initial_tangent() const;
  double yield_strain() const;
  bool has_yielded(double strain, double stress) const;
  void respond(const PointArrays& points, Evaluate evaluate) const;
};

struct InitStress {
  static constexpr const char* name = "InitStress";
  InnerLaw material = {};
  double sigInit = 0;  // [Pa]

  template <class Visit, class Law>
  static void visit_parameters(Visit&& visit, Law& law) {
    using namespace parameter;
    visit(law_inside("material", "the law that starts stressed"), law.material);
    visit(required(stress("sigInit", "its stress where the element has no strain")), law.sigInit);
  }
  void check() const;
  // The strain of the law inside at which its first loading reaches sigInit; nothing when it doesn't.
  std::optional<double> initial_strain() const;

  int history_size() const;
  void initialize_history(double* history) const;
  double initial_tangent() const;
  double yield_strain() const;
  bool has_yielded(double strain, double stress) const;
  void respond(const PointArrays& points, Evaluate evaluate) const;
};

}  // namespace nsframe
