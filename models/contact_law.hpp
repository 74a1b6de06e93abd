// How the two sides of a contact pair act on each other: by an impulse that Newton's restitution rules (law "newton"), or by
// a force of the penetration and its rate, a penalty law of Langlade et al. (2021), Table 1 (theory.md, 250-258).
// A new law of force is one file in models/contact_laws/, one line in contact_laws.cpp and one test.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nsframe {

// As a scene gives it.
struct ContactLawChoice {
  std::string name = "newton";
  std::optional<double> stiffness{};        // k_s of the linear laws [N/m]
  std::optional<double> stiffness_ratio{};  // in its place: over the static stiffness of the stiffer body [-]
  std::optional<double> hertz_stiffness{};  // k_h of the others [N/m^1.5]
  std::optional<double> damping_ratio{};    // xi, in place of a restitution [-]
  std::optional<double> effective_mass{};   // m* [kg]; without: 1 / (H M^-1 H')

  bool is_force() const { return name != "newton"; }
};

// Compression, positive, with its derivatives.
struct ContactForce {
  double value = 0;           // [N]
  double by_penetration = 0;  // [N/m]
  double by_rate = 0;         // [N s/m]
};

enum class ContactStiffness {
  linear,    // k d: by `stiffness`, or by `stiffness_ratio`
  relative,  // k d: by `stiffness_ratio` only
  hertz      // k d^1.5
};

// A law of force. The constant c that `force` uses is 2 xi sqrt(k m*) with xi = `coefficient`(e), or that coefficient itself
// where the law has no damping ratio. `force` is asked at penetrations d >= 0 (derivatives: d > 0); rates d' are positive
// when closing; `approach` is the rate at which the contact began.
struct ContactForceLaw {
  std::string_view name;
  ContactStiffness stiffness;
  bool has_damping_ratio;
  double least_restitution;                    // below which `coefficient` is not defined; 0 itself only where it is negative
  double (*coefficient)(double restitution);   // falls with e, 0 at e = 1; nullptr: the law is elastic
  ContactForce (*force)(double stiffness, double damping, double penetration, double rate, double approach);
};

// The law of force of that name; nullptr for "newton" and for names that are not known.
const ContactForceLaw* contact_force_law(std::string_view name);
std::vector<std::string> contact_law_names();  // "newton" first

// c of the law for a stiffness k, an effective mass m* [kg], and a restitution or, with `xi`, a damping ratio.
double damping_constant(const ContactForceLaw& law, double stiffness, double effective_mass, double restitution, const std::optional<double>& xi);
// The restitution that the damping ratio stands for, by the law's own formula; 1 for elastic laws.
double restitution_of(const ContactForceLaw& law, double damping_ratio);
// k d^(n+1) / (n+1) [J]
double stored_energy(const ContactForceLaw& law, double stiffness, double penetration);

// What is wrong with a choice: keys and messages; empty when nothing is. `restitutions`: those that the user gave.
struct ContactLawFault {
  std::string key, message;
};
std::vector<ContactLawFault> faults(const ContactLawChoice& choice, const std::vector<double>& restitutions);

}  // namespace nsframe
