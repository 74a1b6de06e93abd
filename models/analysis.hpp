// What to compute and what to keep: options of the time history and of the output, with their defaults.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.hpp"

namespace nsframe {

enum class ContactSolverKind { active_set, gauss_seidel };
enum class ImpactLaw { newton, poisson };

struct AnalysisOptions {
  std::string scheme = "auto";         // name in the registry of schemes (integrators/schemes.cpp), or "auto" (scheme_choice.hpp)
  Location scheme_at;                  // where the scene names it
  std::string scheme_reason;           // when the scene names none, but gives options of one
  double dt = 1e-3;                    // [s]
  double accuracy = 0;                 // of scheme exponential: parts of dt by an error estimate, relative to the peak; 0: dt as it is
  double highest_frequency = 0;        // [Hz] of exact and exponential: modes above follow their forces at once; 0: none does
  double duration = 0;                 // [s]; 0: the length of the longest motion
  double theta = 1.0;                  // [1/2, 1]; the paper uses 1
  std::string integrator = "theta";    // of event-split between impacts: name in its registry (integrators/flight_methods.cpp)
  double rho_infinity = 0.8;           // of generalized-alpha [0, 1] and alpha-os [1/2, 1]: what a step leaves of unresolved waves
  double gamma = 1.5;                  // activation: a pair takes part where g + gamma dt g' < 0; the paper uses 3/2
  double newton_tolerance = 1e-8;      // residual relative to the largest force of the step
  int max_newton = 30;
  double screening = 1e-10;            // ModelDescription::screening, as scenes give it
  std::vector<std::string> algorithm{"auto"};  // names in the registry (integrators/algorithms.hpp), tried in turn
  int max_halvings = 10;               // of a step whose Newton iterations fail
  ImpactLaw impact_law = ImpactLaw::newton;  // how e acts where several pairs collide at once (contact/impact_law.hpp)
  ContactSolverKind contact_solver = ContactSolverKind::active_set;
  bool projection = false;             // of penetrations to gap 0 after each step (moreau-jean)
  double contact_tolerance = 1e-12;    // complementarity error relative to the approach velocity
  int max_contact_sweeps = 100000;     // Gauss-Seidel only
  int threads = 1;
};

// Oscillators on floors, or other nodes, and what they show.
struct FloorSpectraOptions {
  std::vector<std::string> nodes{"floors"};  // "structure.node", or "floors": centres of the slabs
  std::vector<double> periods;               // [s]; empty: 60 from 0.02 to 4 s, evenly spaced in logarithm
  double damping = 0.05;                     // ratio
};

// Histories that can be kept.
inline constexpr std::array<const char*, 7> history_names{"nodes", "contacts", "elements", "sections", "fibers", "energy", "ground"};

struct OutputOptions {
  double frames = 0;                   // [Hz] of ParaView frames; 0: none
  double history_rate = 0;             // [Hz] of histories; 0: every step
  std::vector<std::string> history;    // of history_names
  std::vector<std::string> nodes;      // "structure.node" to keep; empty: all
  std::vector<std::string> fibers;     // "structure.element", or "structure.element:point"; empty: all
  std::optional<FloorSpectraOptions> floor_spectra;
  double amplification = 1;            // of the displacements stored in the frames (Warp By Vector scales further)
  double checkpoint = 60;              // [s] of wall-clock time between checkpoints; 0: only when the run ends
};

}  // namespace nsframe
