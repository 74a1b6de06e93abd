// The interface of time-stepping schemes. A new scheme is one file with a class derived from Scheme, one line in
// schemes.cpp and one test.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assembly/system.hpp"
#include "models/analysis.hpp"
#include "models/results.hpp"
#include "models/snapshot.hpp"

namespace nsframe {

// Of a step, what is no list.
struct StepFigures {
  int newton_iterations = 0;
  int evaluations = 0;               // of all elements, where the scheme counts them
  int stiffened_steps = 0;           // made by the implicit form of alpha-OS (alpha_os.cpp)
  int rejected_parts = 0;            // of the step, or over several, made anew and shorter
  int solves = 0;                    // of the linearised step
  bool guess_stood = false;          // no iteration was needed
  bool histories_behind = false;     // those of the trial state are of some earlier time
  int active_pairs = 0;
  double residual = 0;               // relative
  double complementarity_error = 0;
  double least_gap = std::numeric_limits<double>::infinity();  // at the start of the step [m]
  std::optional<double> kinetic;     // energy at the end, where it is not that of all velocities: some follow without inertia [J]
  double created = 0;                // by restitution in simultaneous impacts [J]
  Accumulations accumulations;       // ended in this step
  // increments over the step [J]; kinetic and strain energy are those of Energy
  double strain = 0, damping = 0, contact = 0, friction = 0, numerical = 0, input = 0;
};

// What one accepted step did.
struct StepResult : StepFigures {
  std::vector<Impact> impacts;
  std::vector<VelocityJump> jumps;   // in the order of time
  std::vector<Attempt> attempts;     // of the solution algorithms, also when the step failed
  std::vector<Slip> slips;           // of pairs with friction in contact

  // As new; the lists keep their room.
  void clear() {
    static_cast<StepFigures&>(*this) = {};
    impacts.clear();
    jumps.clear();
    attempts.clear();
    slips.clear();
  }
};

class Scheme {
 public:
  virtual ~Scheme() = default;
  virtual std::string name() const = 0;

  // The next step begins from `committed`, another state than the result of the last one: what a scheme keeps of that is void. What it
  // can prepare for that step it may do now.
  virtual void begin_anew(const System& system, const State& committed) {
    (void)system, (void)committed;
    goes_on_ = false;
  }

  // A scheme may leave the histories of elements behind for some of the next `steps` steps, but not in the last of them; those that do are
  // told again before every step.
  virtual bool leaves_histories_behind() const { return false; }
  virtual void histories_wanted_after(int steps) { (void)steps; }

  // Advances from `committed` by `h` [s] into `trial` (arrays of the right size, contents arbitrary). `committed` is
  // not changed, so a step that throws ConvergenceError has nothing to undo.
  virtual void step(System& system, const State& committed, State& trial, double h, StepResult& result) = 0;

  // Damping ratio and circular frequency with which the scheme moves a free mode of circular frequency `w` [rad/s] and
  // damping ratio `xi` at step `h` (exact, from the amplification matrix).
  struct ModeResponse {
    double damping_ratio, circular_frequency;
  };
  virtual ModeResponse mode_response(double w, double xi, double h) const = 0;

  // Of the complex mode into which damping turns a structure's undamped mode (its number, from the slowest), in closed form;
  // a ratio of 1 where it creeps, no frequency where damping ties it to no other or the scheme does not know.
  virtual ModeResponse complex_mode(int structure, int mode) const {
    (void)structure, (void)mode;
    return {0, 0};
  }

  virtual long factorizations() const = 0;

  // Of the factors that it solves with, where large ones are factored.
  virtual StoredEntries factor_entries() const { return {}; }

  // Whether DOFs without mass are condensed by the scheme itself.
  virtual bool condenses_massless() const { return false; }

  // The highest circular frequency at which a struck point rings by itself, where the scheme steps through that [rad/s]; else 0.
  virtual double struck_frequency() const { return 0; }

  // The circular frequency from which on nonlinear elements see modes where they would rest, at whole steps [rad/s]; 0: they see all.
  virtual double resting_frequency() const { return 0; }

  // Modes above analysis.highest_frequency, and the part of the mass shaken by the motions that the others hold.
  struct LeftOut {
    int modes = 0;
    double kept_mass = 1;
  };
  virtual LeftOut left_out() const { return {}; }

  // Whether a step that threw ConvergenceError is worth trying in halves.
  virtual bool shorter_steps_help() const { return true; }

  // Contacts with laws of force that are under way, as if they ended now.
  virtual std::vector<Impact> open_contacts(const System& system, const State& state) const {
    (void)system, (void)state;
    return {};
  }

  // What `nsframe check` says of it, a line each.
  virtual std::vector<std::string> describe() const { return {}; }

  // What outlives a step and is not in State: with it, a restored scheme goes on with the same bits.
  virtual void save(Snapshot& snapshot) const = 0;
  virtual void restore(System& system, const Snapshot& snapshot) = 0;

 protected:
  // Of schemes that keep the motion in a form of their own: it stands where the last step ended.
  bool goes_on_ = false;
};

// The scheme of that name. Throws InputError for an unknown one.
std::unique_ptr<Scheme> make_scheme(const AnalysisOptions& options, const System& system);
// All of them, and "auto" (scheme_choice.hpp).
std::vector<std::string> scheme_names();

}  // namespace nsframe
