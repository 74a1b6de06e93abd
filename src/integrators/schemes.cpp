#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>

#include "base/errors.hpp"
#include "integrators/event_split.hpp"
#include "integrators/exact.hpp"
#include "integrators/exponential.hpp"
#include "integrators/moreau_jean.hpp"
#include "integrators/penalty_forces.hpp"
#include "integrators/scheme.hpp"

namespace nsframe {

namespace {

using Factory = std::function<std::unique_ptr<Scheme>(const AnalysisOptions&, const System&)>;

const std::map<std::string, Factory>& factories() {
  static const std::map<std::string, Factory> schemes{
      {"event-split", [](const AnalysisOptions& options, const System& system) { return std::make_unique<EventSplit>(options, system); }},
      {"exact", [](const AnalysisOptions& options, const System& system) { return std::make_unique<Exact>(options, system); }},
      {"exponential", [](const AnalysisOptions& options, const System& system) { return std::make_unique<Exponential>(options, system); }},
      {"moreau-jean", [](const AnalysisOptions& options, const System& system) { return std::make_unique<MoreauJean>(options, system); }},
  };
  return schemes;
}

// Friction, laws of force, and what does not go beside them, where they are not available.
void check_contact_laws(const AnalysisOptions& options, const Contacts& contacts) {
  Diagnostics diagnostics;
  const std::string force = force_law_of(contacts);
  if (!force.empty() && options.scheme != "moreau-jean") {
    diagnostics.error(options.scheme_at, fmt::format("scheme '{}' locates impacts and takes no penalty laws: {}; use scheme = \"moreau-jean\"",
                                                     options.scheme, force));
  }
  if (!force.empty() && contacts.frictional()) {
    diagnostics.error(options.scheme_at, fmt::format("friction acts beside Newton's law of impact alone, and {}", force));
  }
  diagnostics.throw_if_any();
  if (!contacts.frictional()) return;
  if (options.scheme != "moreau-jean") {
    diagnostics.error(options.scheme_at, fmt::format("scheme {} has no friction, which contact asks for: scheme = \"moreau-jean\" has it",
                                                     options.scheme));
  }
  if (options.impact_law == ImpactLaw::poisson) {
    diagnostics.error(options.scheme_at, "impact_law = \"poisson\" is for contact without friction; with friction it is \"newton\"");
  }
  diagnostics.throw_if_any();
}

// Part of the largest damping coefficient, per unit of motion, that is more than rounding where all supports move together.
constexpr double strained_dashpot = 1e-9;

// Supports that move relative to the base, where a scheme cannot take what they do.
void check_moved_supports(const AnalysisOptions& options, const System& system) {
  const Model& model = system.model;
  if (!model.moves_supports()) return;
  Diagnostics diagnostics;
  const auto refuse = [&](const std::string& why) {
    diagnostics.error(options.scheme_at, fmt::format("moved supports: {}", why));
  };
  const bool gaps = std::any_of(model.support_effects.begin(), model.support_effects.end(), [](const SupportEffect& e) { return e.moves_gaps(); });
  double dashpot = 0;
  for (const SupportEffect& effect : model.support_effects) {
    if (effect.damping.size() > 0) dashpot = std::max(dashpot, effect.damping.cwiseAbs().maxCoeff());
  }
  double largest = 0;
  for (int j = 0; j < model.viscous_damping.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator entry(model.viscous_damping, j); entry; ++entry) largest = std::max(largest, std::abs(entry.value()));
  }
  if (dashpot > strained_dashpot * largest) refuse("they strain dashpots, whose energy is not found then; use damping of structures instead");
  if (system.assembler.rate_dependent()) refuse("laws of the rate of strain do not go beside them; use damping of structures instead");
  if (model.contacts.frictional()) refuse("pairs with friction slide where supports move, which is not found; use pairs without friction");
  if (options.scheme != "moreau-jean") {
    const std::string other = fmt::format("scheme '{}' takes them in linear scenes alone, and {{}}; use scheme = \"moreau-jean\"", options.scheme);
    if (!system.linear()) refuse(fmt::format(fmt::runtime(other), "elements here are nonlinear"));
    if (gaps) refuse(fmt::format(fmt::runtime(other), "they open and close contact pairs here"));
  } else if (gaps) {
    if (const std::string force = force_law_of(model.contacts); !force.empty()) refuse("they open and close contact pairs here, and " + force + "; use Newton's law of impact");
  }
  diagnostics.throw_if_any();
}

}  // namespace

std::vector<std::string> scheme_names() {
  std::vector<std::string> names{"auto"};
  for (const auto& entry : factories()) names.push_back(entry.first);
  return names;
}

std::unique_ptr<Scheme> make_scheme(const AnalysisOptions& options, const System& system) {
  const auto found = factories().find(options.scheme);
  if (found == factories().end()) {
    throw InputError(fmt::format("error: scheme '{}' is not known{}", options.scheme, did_you_mean(options.scheme, scheme_names())));
  }
  check_contact_laws(options, system.contacts());
  check_moved_supports(options, system);
  return found->second(options, system);
}

}  // namespace nsframe
