// What a time history reports, step by step and at its end; integrators produce it, output writes it.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "models/model.hpp"
#include "models/state.hpp"

namespace nsframe {

// Work and energy since the start of the time history, relative to the moving base [J].
//   kinetic + strain + damping + contact + friction + numerical - input - (start) = balance error
struct Energy {
  double kinetic = 0;          // 1/2 v' M v
  double strain = 0;           // work of the internal forces (less loads on nonlinear members) since the start, recoverable or not
  double damping = 0;          // dissipated by C
  double contact = 0;          // taken out by impacts
  double friction = 0;         // taken out by slip
  double numerical = 0;        // dissipated by the scheme itself (theta > 1/2)
  double input = 0;            // work of the loads
  double initial = 0;          // kinetic energy at the start
  double balance_error() const { return kinetic + strain + damping + contact + friction + numerical - input - initial; }
};

struct Impact {
  double time = 0;             // end of the step, or of the contact with a law of force [s]
  int pair = 0;
  double approach_velocity = 0;  // -(gap rate before), positive when closing [m/s]
  double impulse = 0;          // [N s]
  double rate_before = 0, rate_after = 0;  // gap rates [m/s]
  double duration = 0;         // before `time`, of a contact with a law of force; 0: an impulse [s]
};

// Slip of a pair with friction while it was in contact.
struct Slip {
  int pair = 0;
  double distance = 0;         // along its path [m]
  double energy = 0;           // taken out [J]
};

// What restitution added where several pairs collided at once; theory.md (270).
struct CreatedEnergy {
  double sum = 0;              // [J]
  double largest = 0;          // in one event [J]
  double largest_time = 0;     // [s]
};

// Impacts of one pair closer than 20 ms, or sustained contact, merged: what a test records as one impact.
struct Pounding {
  double time = 0;             // of its first impact [s]
  double duration = 0;         // [s]
  int pair = 0;
  double approach_velocity = 0;  // of its first impact [m/s]
  double impulse = 0;          // summed [N s]
  double effective_restitution = 0;  // separation rate after the last over approach velocity before the first [-]
  int impacts = 0;
};

// The part of a step's change of velocity that impacts made, J^-1 H' p, and when it acts on the displacements. What is
// left of the change is smooth: accelerations come from that, jumps stay jumps.
struct VelocityJump {
  double time = 0;             // [s]
  VectorX change;              // free DOFs [m/s, rad/s]
};

struct StepReport {
  int step = 0;                // of the user's dt, from 1
  int substeps = 1;            // more than 1 where Newton failed and the step was halved
  int newton_iterations = 0;
  int active_pairs = 0;
  double residual = 0;         // relative, at the end
  double complementarity_error = 0;
  std::vector<VelocityJump> jumps;  // in the order of time
};

struct Snapshot;

// Watches a time history. All calls come from the thread that runs it.
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void start(const Model& model, const State& state) { (void)model; (void)state; }
  // After every accepted step of the user's dt; `before` is the state at its start.
  virtual void step(const State& before, const State& after, const StepReport& report, const Energy& energy) {
    (void)before; (void)after; (void)report; (void)energy;
  }
  // The next time whose nearest step is one of which step() reads State::history [s]; a scheme may leave that behind until then. By default
  // it is read of every step.
  virtual double next_history_time() const { return -std::numeric_limits<double>::infinity(); }
  virtual void impact(const Impact& impact) { (void)impact; }
  // Called also when the run stops early.
  virtual void finish() {}
  // Puts what it needs to go on after the last step into the snapshot; what it writes is then on the disk.
  virtual void save(Snapshot& snapshot) { (void)snapshot; }
  // In place of start() when a run goes on from a snapshot, with the state there.
  virtual void resume(const Model& model, const State& state, const Snapshot& snapshot) { (void)snapshot; start(model, state); }
};

// One that never reads State::history.
class MotionObserver : public Observer {
 public:
  double next_history_time() const final { return std::numeric_limits<double>::infinity(); }
};

// How one solution algorithm did in one step.
struct Attempt {
  std::string algorithm;
  int iterations = 0;
  bool converged = false;
  double error = 0;            // of the residual over its tolerance, at the end
  std::string reason;          // when it stopped before its iterations were used up
};

// A step in which the first algorithm failed, and what was tried.
struct LadderRecord {
  std::string stage;           // static stage; empty: the time history
  int step = 0;                // of the stage, or of the user's dt
  double at = 0;               // load factor or time at its start
  std::vector<Attempt> attempts;
};

// One point of a static stage.
struct StagePoint {
  double load_factor = 0;
  double displacement = 0;     // of the control DOF [m, rad]; 0 when the stage names none
  int iterations = 0;          // of the algorithm that found it
  double residual = 0;         // relative
};

struct StageResult {
  std::string name, control, at;       // at: the control DOF, "left.9 ux"; may be empty
  std::vector<StagePoint> points;      // the first is the start
  std::vector<LadderRecord> ladder;
  long iterations = 0, halved = 0, factorizations = 0;  // iterations of all attempts
  double least_gap = 1e300;            // of the contact pairs at any point [m]; they don't act in static stages
  bool completed = false, interrupted = false;
  std::string stop_reason;
};

// Watches static stages. The points of a stage come between its start and its end.
class StageObserver {
 public:
  virtual ~StageObserver() = default;
  virtual void start(const Model& model, const StaticStage& stage, const State& state) { (void)model; (void)stage; (void)state; }
  // Every point found; the first is the start of the stage.
  virtual void point(const StagePoint& point, const State& state) = 0;
  // Also when the stage stops early.
  virtual void finish(const StageResult& result) { (void)result; }
};

// Effective damping and frequency of one mode under a scheme with a given step.
struct ModeNumerics {
  std::string structure;
  std::string mode;                    // name by direction: L1, T1, R1, V1, ...
  double frequency = 0;                // [Hz]
  double damping_asked = 0;            // [-]
  double damping_effective = 0;        // asked plus numerical [-]
  double frequency_effective = 0;      // [Hz]
  double participation = 0;            // effective mass over mass, the largest of x, y and z [-]
  Vector3 shares = Vector3::Zero();    // the same along x, y and z
  double complex_frequency = 0;        // |lambda| / 2 pi of its complex mode, where damping ties modes together and the scheme knows it; else 0 [Hz]
  double complex_damping = 0;          // -Re lambda / |lambda| of that; 1 where it creeps [-]
};

struct Peak {
  std::string node;
  Vector3 displacement = Vector3::Zero();  // largest absolute values along x, y, z relative to the base [m]
  Vector3 velocity = Vector3::Zero();      // [m/s]
  Vector3 acceleration = Vector3::Zero();  // absolute acceleration, as velocity difference over dt [m/s2]
  double twist = 0;                        // largest |rz| [rad]
  double level = 0;                        // z of the node [m]
};

// Of a story: largest relative displacement of its floors over its height, along x and y [-].
struct StoryDrift {
  std::string structure;
  int story = 0;                // from 1, the lowest
  double bottom = 0, top = 0;   // levels of its floors [m]
  Vector2 drift = Vector2::Zero();
};

// Largest values of a floor spectrum.
struct FloorSpectrumPeak {
  std::string node;
  int direction = 0;                          // 0, 1, 2: x, y, z
  double level = 0;                           // z of the node [m]
  double psa = 0, psa_period = 0;             // pseudo-acceleration [m/s2] and where it is [s]
  double psv = 0, psv_period = 0;             // pseudo-velocity [m/s], [s]
};

// Of elements that iterate for their own balance (force-based members), sums over their evaluations (theory.md, 385-388).
struct StateWorkSums {
  long evaluations = 0;  // of one element each
  long passes = 0;       // over the sections of an element: an evaluation takes one at least
  long iterated = 0;     // evaluations with more passes than one
  long carried = 0;      // evaluations that left the rest to the next one
  long finished = 0;     // of these, whose rest was iterated on because the step ended there
};
// Calls visit(name, number) for each, by the names of summary.json.
template <class Sums, class Visit>
void visit_state_work(Sums& sums, const Visit& visit) {
  visit("evaluations", sums.evaluations);
  visit("passes", sums.passes);
  visit("iterated", sums.iterated);
  visit("carried", sums.carried);
  visit("finished", sums.finished);
}

// What a time history did not have to compute.
struct Savings {
  int elements_assembled_once = 0;     // linear ones, of Summary::elements
  double quiet_fibers = 0;             // share of the fibers that stood in quiet sections, mean of every 16th step
  long guessed_steps = 0;              // steps that their first guess solved, without an iteration
  long factorizations_avoided = 0;     // solutions with factors of an earlier iteration or step
  int massless_dofs = 0;               // that linear elements alone meet, where the scheme does not condense them itself
  int condensed_dofs = 0;              // of these, those that were condensed
  double condensed_entries = 1;        // entries of factors and stiffness that are left, relative to those without
  double stored_entries = 1;           // entries of factors and stiffness in memory, relative to those that a step meets: others equal them
};

// Where the scheme `exact` ended ever faster impacts (theory.md, 171-172).
struct Accumulations {
  long ended = 0;                      // whose further bounces would have been smaller than rounding lets one see
  double largest_bounce = 0;           // of those left out [m]
  long plastic = 0;                    // impacts at one time that did not end: made plastic
};

struct Timing {
  double setup = 0, step_loop = 0, output = 0;  // [s]
};

struct Summary {
  std::string title, scheme, scheme_reason;
  double dt = 0, duration = 0, theta = 0, gamma = 0;
  std::string integrator;              // of event-split; else empty
  double rho_infinity = 0;
  int steps = 0, dofs = 0, nodes = 0, elements = 0, fibers = 0;
  std::vector<std::string> structures;
  std::vector<std::vector<double>> frequencies;   // Hz, a list a structure
  std::vector<ModeNumerics> modes;
  std::vector<std::string> pairs;                 // names, in the order of Impact::pair
  std::vector<StageResult> stages;
  std::vector<LadderRecord> ladder;               // steps in which the first algorithm failed, the first 200
  std::vector<Impact> impacts;
  std::vector<Pounding> poundings;
  std::vector<Peak> peaks;
  std::vector<StoryDrift> drifts;
  std::vector<FloorSpectrumPeak> floor_spectra;
  double floor_spectra_damping = 0;               // [-]
  std::vector<Slip> slips;                        // one a pair with friction
  CreatedEnergy created;
  Energy energy;
  double worst_balance_error = 0;                 // over the run, relative to the largest energy [-]
  double max_penetration = 0;                     // [m]
  double max_complementarity_error = 0;
  long newton_iterations = 0, halved_steps = 0, laddered_steps = 0, factorizations = 0;
  long evaluations = 0;                           // of all elements; 0 where the scheme does not count them
  long stiffened_steps = 0;                       // of alpha-OS, made by its implicit form because members stiffened
  double struck_frequency = 0;                    // at which struck points ring, where the scheme steps through it [Hz]
  double resting_frequency = 0;                   // above it, nonlinear elements see modes where they would rest, at whole steps; 0: they see all [Hz]
  int left_out_modes = 0;                         // above analysis.highest_frequency
  double kept_mass = 1;                           // that the others hold, of what the motions shake; the least of them
  long rejected_parts = 0;                        // of steps, made anew with half the length
  Accumulations accumulations;
  std::vector<std::string> softened_members;      // force-based ones, once more than one state was possible (theory.md, 173)
  Savings savings;
  StateWorkSums state_work;                       // of force-based members, static stages included
  Timing timing;
  std::vector<std::string> warnings;              // plain sentences
  bool completed = true;
  bool interrupted = false;                       // stopped on request
  std::string stop_reason;                        // when not completed
  double end_time = 0;                            // [s]
};

}  // namespace nsframe
