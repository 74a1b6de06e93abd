// The geometric transformation of two-node members: from the displacements of the end nodes (12) to the basic
// deformations (6) and from basic forces and their tangent to global ones. Constant: what a transformation must
// remember (the triads of finite rotations) is in the history, at the head of the element's block.
// A new one is a file with a class derived from MemberGeometry, a name in Geometry and a line in member_geometry.cpp.
#pragma once

#include "elements/beam_frame.hpp"
#include "elements/dead_load.hpp"
#include "elements/element_group.hpp"

namespace nsframe {

enum class Geometry { linear, p_delta, corotational };

class MemberGeometry {
 public:
  virtual ~MemberGeometry() = default;

  virtual std::string_view suffix() const = 0;  // of the names of element kinds
  virtual bool linear() const { return false; }
  virtual bool symmetric() const { return false; }
  virtual bool finite() const { return false; }  // displacements and rotations of any size

  virtual int history_size() const { return 0; }
  virtual void initialize_history(double* history) const { (void)history; }

  // Basic deformations at `displacement`; writes the trial history.
  virtual Vector6 deformation(const BeamFrame& frame, const Vector12& displacement, const double* committed,
                              double* trial) const = 0;
  // Of deformation() [m, rad].
  virtual double rounding(const Vector12& displacement) const;

  // Internal force and, if `tangent` is not null, its derivative by the displacement, in global axes, from basic forces
  // and their derivative by the basic deformations.
  virtual void to_global(const BeamFrame& frame, const Vector12& displacement, const double* committed,
                         const Vector6& basic_force, const Matrix6& basic_tangent, Vector12& force,
                         Matrix12* tangent) const = 0;

  // Adds what `part` of a load between the ends does beyond the basic forces.
  virtual void add_load(const BeamFrame& frame, const MemberLoad& load, double part, const Vector12& displacement,
                        const double* committed, Vector12& force, Matrix12* tangent) const;

  // Rows: the present local axes.
  virtual Matrix3 axes(const BeamFrame& frame, const Vector12& displacement, const double* committed) const {
    (void)displacement; (void)committed;
    return frame.axes;
  }
  // The same for the dead loads of a finite geometry, whose moment the member has found.
  virtual void add_dead_load(const BeamFrame& frame, const MemberLoad& load, double part, const DeadMoment& moment,
                             const Vector12& displacement, const double* committed, Vector12& force, Matrix12* tangent) const {
    (void)frame; (void)load; (void)part; (void)moment; (void)displacement; (void)committed; (void)force; (void)tangent;
  }

  // Where the member is, for the output; `history` as left by deformation().
  virtual ElementPose pose(const BeamFrame& frame, const Vector12& displacement, const double* history) const;
};

// Of beam-columns, and of members that carry axial force only.
const MemberGeometry& beam_geometry(Geometry kind);
const MemberGeometry& bar_geometry(Geometry kind);

}  // namespace nsframe
