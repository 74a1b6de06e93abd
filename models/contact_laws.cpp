#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/diagnostics.hpp"
#include "models/contact_laws/laws.hpp"

namespace nsframe {

namespace {

const std::array<const ContactForceLaw*, 7>& registry() {
  static const std::array<const ContactForceLaw*, 7> laws{&linear_viscoelastic_law, &modified_linear_viscoelastic_law, &anagnostopoulos_law,
                                                          &hertz_law, &hertz_damped_law, &jankowski_law, &khatami_law};
  return laws;
}

using Faults = std::vector<ContactLawFault>;

void unwanted(const char* key, const std::optional<double>& value, std::string_view law, Faults& found) {
  if (value) found.push_back({key, fmt::format("law '{}' has no {}", law, key)});
}

// The keys of stiffness that the law has no use for, or the one that it lacks.
void check_stiffness(const ContactLawChoice& choice, const ContactForceLaw& law, Faults& found) {
  switch (law.stiffness) {
    case ContactStiffness::linear:
      unwanted("hertz_stiffness", choice.hertz_stiffness, law.name, found);
      if (choice.stiffness.has_value() == choice.stiffness_ratio.has_value()) {
        found.push_back({"stiffness", fmt::format("law '{}' needs either stiffness or stiffness_ratio", law.name)});
      }
      break;
    case ContactStiffness::relative:
      unwanted("stiffness", choice.stiffness, law.name, found);
      unwanted("hertz_stiffness", choice.hertz_stiffness, law.name, found);
      if (!choice.stiffness_ratio) found.push_back({"stiffness_ratio", fmt::format("law '{}' needs stiffness_ratio", law.name)});
      break;
    case ContactStiffness::hertz:
      unwanted("stiffness", choice.stiffness, law.name, found);
      unwanted("stiffness_ratio", choice.stiffness_ratio, law.name, found);
      if (!choice.hertz_stiffness) found.push_back({"hertz_stiffness", fmt::format("law '{}' needs hertz_stiffness", law.name)});
      break;
  }
}

void check_damping(const ContactLawChoice& choice, const ContactForceLaw& law, const std::vector<double>& restitutions, Faults& found) {
  if (!law.has_damping_ratio) unwanted("damping_ratio", choice.damping_ratio, law.name, found);
  if (law.coefficient == nullptr) {
    if (!restitutions.empty()) found.push_back({"restitution", fmt::format("law '{}' is elastic: it has no restitution", law.name)});
    unwanted("effective_mass", choice.effective_mass, law.name, found);
    return;
  }
  if (!law.has_damping_ratio) unwanted("effective_mass", choice.effective_mass, law.name, found);
  if (choice.damping_ratio && !restitutions.empty()) {
    found.push_back({"damping_ratio", fmt::format("law '{}' has either restitution or damping_ratio", law.name)});
  }
  if (choice.damping_ratio) return;
  for (const double e : restitutions) {
    if (e >= law.least_restitution) continue;
    found.push_back({"restitution",
                     fmt::format("restitution = {:g}: law '{}' needs at least {:g}, since its damping grows beyond all bounds towards 0", e,
                                 law.name, law.least_restitution)});
  }
}

}  // namespace

const ContactForceLaw* contact_force_law(std::string_view name) {
  for (const ContactForceLaw* law : registry()) {
    if (law->name == name) return law;
  }
  return nullptr;
}

std::vector<std::string> contact_law_names() {
  std::vector<std::string> names{"newton"};
  for (const ContactForceLaw* law : registry()) names.emplace_back(law->name);
  return names;
}

double damping_constant(const ContactForceLaw& law, double stiffness, double effective_mass, double restitution,
                        const std::optional<double>& xi) {
  if (law.coefficient == nullptr) return 0;
  const double coefficient = xi ? *xi : law.coefficient(restitution);
  return law.has_damping_ratio ? 2 * coefficient * std::sqrt(stiffness * effective_mass) : coefficient;
}

double restitution_of(const ContactForceLaw& law, double damping_ratio) {
  if (law.coefficient == nullptr || damping_ratio <= 0) return 1;
  double low = std::max(law.least_restitution, 0.0), high = 1;
  if (damping_ratio >= law.coefficient(low)) return low;
  for (int i = 0; i < 200 && high - low > 1e-16 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (law.coefficient(middle) > damping_ratio ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double stored_energy(const ContactForceLaw& law, double stiffness, double penetration) {
  const double square = penetration * penetration;
  return law.stiffness == ContactStiffness::hertz ? 0.4 * stiffness * square * std::sqrt(penetration) : 0.5 * stiffness * square;
}

Faults faults(const ContactLawChoice& choice, const std::vector<double>& restitutions) {
  Faults found;
  const std::pair<const char*, const std::optional<double>&> numbers[] = {
      {"stiffness", choice.stiffness}, {"stiffness_ratio", choice.stiffness_ratio}, {"hertz_stiffness", choice.hertz_stiffness},
      {"damping_ratio", choice.damping_ratio}, {"effective_mass", choice.effective_mass}};
  if (!choice.is_force()) {
    for (const auto& [key, value] : numbers) unwanted(key, value, choice.name, found);
    return found;
  }
  const ContactForceLaw* law = contact_force_law(choice.name);
  if (law == nullptr) {
    return {{"law", fmt::format("contact law '{}' is not known{}", choice.name, did_you_mean(choice.name, contact_law_names()))}};
  }
  check_stiffness(choice, *law, found);
  check_damping(choice, *law, restitutions, found);
  return found;
}

}  // namespace nsframe
