#include "integrators/scheme_choice.hpp"

#include <fmt/format.h>

#include "base/errors.hpp"
#include "integrators/exact_modes.hpp"
#include "integrators/penalty_forces.hpp"

namespace nsframe {

namespace {

// Free DOFs of one structure: its dense eigen-solve takes one or two seconds then, and grows as n^3; so does, as n^2, the product
// of its modes in a thousand kept results.
constexpr int most_dofs = 1000;
// The same where dashpots may tie its modes together: the matrix has twice the rows and is not symmetric.
constexpr int most_tied_dofs = 250;

// Why natural modes are not for this scene; empty when they may be.
std::string reason_against_modes(const System& system, const State& start) {
  for (const Structure& structure : system.model.structures) {
    const int dofs = structure.last_dof - structure.first_dof;
    if (dofs > most_tied_dofs && system.model.viscous_damping.middleCols(structure.first_dof, dofs).nonZeros() > 0) {
      return fmt::format("structure '{}' has dashpots and {} free DOFs, and complex modes are worth finding up to {}", structure.name, dofs, most_tied_dofs);
    }
    if (dofs > most_dofs) return fmt::format("structure '{}' has {} free DOFs, and all its modes are worth finding up to {}", structure.name, dofs, most_dofs);
  }
  const Contacts& contacts = system.contacts();
  if (contacts.size() == 0) return {};
  if (contacts.frictional()) return "contact has friction, which acts in moreau-jean alone";
  if (const std::string force = force_law_of(contacts); !force.empty()) return force + ", which moreau-jean alone can take";
  if (!system.model.stages.empty()) return "contact pairs may overlap after static stages, in which they do not act";
  const VectorX gap = contacts.jacobian * start.displacement + contacts.initial_gap;
  Eigen::Index least = 0;
  gap.minCoeff(&least);
  const double size = start.displacement.cwiseAbs().maxCoeff() + contacts.initial_gap.cwiseAbs().maxCoeff() + 1e-6;
  if (gap[least] < -1e-12 * size) {
    return fmt::format("contact pair '{}' overlaps by {:.3g} m at the start", contacts.pairs[static_cast<std::size_t>(least)].name, -gap[least]);
  }
  return {};
}

SchemeChoice choose(const AnalysisOptions& options, const System& system, const State& start) {
  if (options.scheme != "auto") {
    return {make_scheme(options, system), options.scheme_reason.empty() ? "asked for" : options.scheme_reason};
  }
  AnalysisOptions chosen = options;
  const std::string nonlinear = nonlinear_element(system);
  std::string against = reason_against_modes(system, start);
  chosen.scheme = nonlinear.empty() ? "exact" : "exponential";
  if (against.empty()) {
    try {
      return {make_scheme(chosen, system), nonlinear.empty() ? "the scene is linear: every mode moves in closed form"
                                                             : nonlinear + " is nonlinear: its departure from the stiffness at rest is a load"};
    } catch (const InputError& refusal) {
      against = refusal.what();
    }
  }
  against = fmt::format("not {}: {}", chosen.scheme, against);
  chosen.scheme = "moreau-jean";
  return {make_scheme(chosen, system), against};
}

}  // namespace

SchemeChoice choose_scheme(const AnalysisOptions& options, const System& system, const State& start) {
  SchemeChoice choice = choose(options, system, start);
  const std::string scheme = choice.scheme->name();
  Diagnostics diagnostics;
  const auto refuse = [&](const char* option, const char* schemes) {
    diagnostics.error(options.scheme_at, fmt::format("analysis.{} needs scheme = {}, and this run takes {} ({})", option, schemes, scheme, choice.reason));
    diagnostics.throw_if_any();
  };
  if (options.accuracy > 0 && scheme == "moreau-jean") refuse("accuracy", "\"exponential\"");  // exact has any accuracy
  if (options.highest_frequency > 0 && scheme != "exact" && scheme != "exponential") refuse("highest_frequency", "\"exact\" or \"exponential\"");
  return choice;
}

}  // namespace nsframe
