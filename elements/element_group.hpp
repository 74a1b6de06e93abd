// Elements come in groups of one kind, evaluated together. A group holds constants only; histories are in State.
// A new element is one file with a class derived from ElementGroup, one line in models/build_elements.cpp and one test.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "base/types.hpp"
#include "elements/fiber_results.hpp"
#include "elements/sections.hpp"
#include "materials/rate.hpp"

namespace nsframe {

struct MemberLoad;

// End nodes of a two-node element; node -1 is the ground.
using ElementNodes = std::array<int, 2>;

// What an element looks like, for the output.
struct ElementShape {
  bool beam = false;              // drawn with Hermite shape functions, else a straight line
  bool finite = false;            // turns by any amount: its pose says where it is
  Matrix3 axes;                   // rows: local x, y, z in global axes
  double length = 0;              // [m]
  std::array<Vector3, 2> offset{Vector3::Zero(), Vector3::Zero()};  // from the nodes to the ends [m]
  const SectionOutline* outline = nullptr;  // may be null or empty
  Matrix12 ends = Matrix12::Identity();  // of a beam: displacements of its ends by the nodes' (member_ends())
};

// Where an element is at a displacement, for the output.
struct ElementPose {
  Matrix3 axes = Matrix3::Identity();  // rows: local x, y, z in global axes
  std::array<Vector3, 2> arm{Vector3::Zero(), Vector3::Zero()};  // from the nodes to the member's ends [m]
  // Only of beams that turn by any amount (ElementShape::finite):
  double length = 0;              // of the chord [m]
  std::array<Vector3, 2> end{Vector3::Zero(), Vector3::Zero()};       // displacements of the member's ends [m]
  std::array<Vector3, 2> rotation{Vector3::Zero(), Vector3::Zero()};  // of the end sections from `axes`: rotation vectors in `axes`
};

// State of one integration point, for the output.
struct SectionResult {
  double position = 0;            // along the element, in [0, 1]
  Vector3 deformation = Vector3::Zero();  // e0 [-], kz, ky [1/m]
  Vector3 force = Vector3::Zero();        // N [N], Mz, My [N m]
  bool with_shear = false;        // has laws of shear or torsion beside its fibers; else the next two stay 0
  Vector3 shear_deformation = Vector3::Zero();  // along local y, z [-], twist [rad/m]; 0 where the section is rigid in shear
  Vector3 shear_force = Vector3::Zero();        // dMz/dx, dMy/dx [N], T [N m]
  double peak_strain_ratio = 0;   // largest |strain| of a fiber over its yield strain, at present (no envelope)
  double yielded = 0;             // 1 when a fiber carries plastic strain, else 0
};

// How elements that iterate for their own balance find their state.
enum class StateDetermination {
  iterated,  // until what is left is small
  one_pass,  // what is left is carried to the next evaluation of the step (theory.md, 385)
  remaining  // iterated, those alone that the last evaluation of all left with more; at the same displacement
};

// How an element that iterates for its own balance made its last evaluation.
struct StateWork {
  int passes = 0;        // over its sections
  double unsettled = 0;  // what is out of balance over its tolerance; 0 when settled
};

class ElementGroup {
 public:
  virtual ~ElementGroup() = default;

  virtual std::string_view kind() const = 0;
  int size() const { return static_cast<int>(nodes_.size()); }
  const ElementNodes& nodes(int element) const { return nodes_[static_cast<std::size_t>(element)]; }
  const std::string& id(int element) const { return ids_[static_cast<std::size_t>(element)]; }

  // True when force = tangent * displacement (beside constant loads) with a constant tangent: assembled once, never
  // evaluated again.
  virtual bool linear() const = 0;

  // False when the tangent is not symmetric (P-Delta).
  virtual bool symmetric() const { return true; }

  // First history double of an element within its group's block; of size(), the block's size.
  virtual int history_begin(int element) const { (void)element; return 0; }
  virtual void initialize_history(int element, double* history) const { (void)element; (void)history; }
  // Called before the first respond() of every attempted step: brings what respond() keeps in `trial` as its first
  // guess back to the committed state.
  virtual void start_step(int element, const double* committed, double* trial) const {
    (void)element; (void)committed; (void)trial;
  }

  // The load between the member's ends; null or empty for none. Groups that aren't linear carry `load_factor` times it,
  // a number in the element's history (null for elements without a load), zero in a virgin one: static analysis brings it
  // to 1. Linear groups carry all of it: force = tangent * displacement + respond(0).
  virtual const MemberLoad* load(int element) const { (void)element; return nullptr; }
  virtual double* load_factor(int element, double* history) const { (void)element; (void)history; return nullptr; }

  // The part of load() that acts in a state with this history.
  double load_part(int element, const double* history) const {
    if (linear()) return 1;
    const double* const factor = load_factor(element, const_cast<double*>(history));
    return factor ? *factor : 0;
  }

  // Internal force (12) and, if `tangent` is not null, its derivative (12x12), in global axes [N, N m], at the
  // displacement (12) of the element's nodes. `committed` and `trial` are the element's own histories. Throws
  // ConvergenceError when an element's own iterations fail.
  virtual void respond(int element, const Vector12& displacement, const double* committed, double* trial,
                       Vector12& force, Matrix12* tangent) const = 0;

  // True when elements iterate for their own balance, until what is left is small or, in respond_once(), with one pass: the rest then stays
  // in `trial` as state_work().unsettled, and the next evaluation of the step starts from there (theory.md, 385). Not for a state to keep.
  virtual bool iterates() const { return false; }
  virtual void respond_once(int element, const Vector12& displacement, const double* committed, double* trial, Vector12& force,
                            Matrix12* tangent) const {
    respond(element, displacement, committed, trial, force, tangent);
  }
  virtual StateWork state_work(int element, const double* history) const { (void)element; (void)history; return {}; }

  // Asks for what respond() will read of these histories at first, before their turn comes.
  virtual void prefetch(int element, const double* committed, const double* trial) const { (void)element; (void)committed; (void)trial; }

  // True when forces depend on the rate of deformation: respond() is then the element at rest, and this what the motion of
  // a time step adds. To be called after respond(); writes its part of `trial`. Force (12) at the theta point of the step
  // that leads from the committed state to `displacement`, and its derivative (12x12) by that [N, N m].
  virtual bool rate_dependent() const { return false; }
  virtual RateEnergy respond_rate(int element, const Vector12& displacement, const double* committed, double* trial,
                                  const StepSpan& step, Vector12& force, Matrix12& tangent) const {
    (void)element; (void)displacement; (void)committed; (void)trial; (void)step;
    force.setZero();
    tangent.setZero();
    return {};
  }
  // The same force (12) as the last time step left it in `history`, for the output.
  virtual Vector12 rate_force(int element, const Vector12& displacement, const double* history) const {
    (void)element; (void)displacement; (void)history;
    return Vector12::Zero();
  }

  // Half the change of the tangent from `displacement` - `step` to + `step` by geometry and forces alone, the material
  // keeping its tangents at `displacement`: for linear buckling. The acting part of load() grows by `load_step` with the
  // second half. `trial` is overwritten.
  virtual Matrix12 geometric_change(int element, const Vector12& displacement, const Vector12& step, double load_step,
                                    const double* committed, double* trial) const {
    (void)element; (void)displacement; (void)step; (void)load_step; (void)committed; (void)trial;
    return Matrix12::Zero();
  }

  // Constant viscous damping matrix (12x12), global axes [N s/m]; zero for most.
  virtual Matrix12 damping(int element) const { (void)element; return Matrix12::Zero(); }

  virtual ElementShape shape(int element) const = 0;
  // `history` as left by respond() at `displacement`.
  virtual ElementPose pose(int element, const Vector12& displacement, const double* history) const {
    (void)displacement; (void)history;
    ElementPose pose;
    pose.axes = shape(element).axes;
    return pose;
  }
  // Results at the integration points; empty for elements without sections. `history` as left by respond().
  virtual std::vector<SectionResult> sections(int element, const Vector12& displacement, const double* history) const {
    (void)element; (void)displacement; (void)history;
    return {};
  }
  // The fibers at the integration points, point by point, and their states in that order; empty without fibers.
  virtual std::vector<FiberPlace> fiber_places(int element) const { (void)element; return {}; }
  // How many of them stand in quiet sections (screening.hpp).
  virtual int quiet_fibers(int element, const double* history) const { (void)element; (void)history; return 0; }
  // True once the member may have had several states at one deformation of its ends (theory.md, 173).
  virtual bool softened(int element, const double* history) const { (void)element; (void)history; return false; }
  virtual std::vector<FiberState> fiber_states(int element, const Vector12& displacement, const double* history) const {
    (void)element; (void)displacement; (void)history;
    return {};
  }

 protected:
  void add(const ElementNodes& nodes, std::string id) {
    nodes_.push_back(nodes);
    ids_.push_back(std::move(id));
  }

 private:
  std::vector<ElementNodes> nodes_;
  std::vector<std::string> ids_;
};

}  // namespace nsframe
