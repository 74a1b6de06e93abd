// What all two-node members share: a frame, a geometric transformation, and a history that begins with the
// transformation's. A kind of member is a class derived from Members that answers basic deformations with basic forces.
#pragma once

#include "elements/dead_load.hpp"
#include "elements/member_geometry.hpp"
#include "elements/member_load.hpp"
#include "elements/releases.hpp"

namespace nsframe {

class Members : public ElementGroup {
 public:
  bool linear() const override { return geometry_.linear() && linear_basic(); }
  bool symmetric() const override { return geometry_.symmetric(); }
  int history_begin(int element) const override { return places_[static_cast<std::size_t>(element)].begin; }
  double* load_factor(int element, double* history) const final {
    return has_factor(element) ? history + geometry_.history_size() : nullptr;
  }
  void initialize_history(int element, double* history) const final;
  void start_step(int element, const double* committed, double* trial) const final;
  void respond(int element, const Vector12& displacement, const double* committed, double* trial, Vector12& force,
               Matrix12* tangent) const final;
  void respond_once(int element, const Vector12& displacement, const double* committed, double* trial, Vector12& force,
                    Matrix12* tangent) const final;
  Matrix12 geometric_change(int element, const Vector12& displacement, const Vector12& step, double load_step,
                            const double* committed, double* trial) const final;
  ElementPose pose(int element, const Vector12& displacement, const double* history) const final;
  std::vector<SectionResult> sections(int element, const Vector12& displacement, const double* history) const final;

  const BeamFrame& frame(int element) const { return frames_[static_cast<std::size_t>(element)]; }

 protected:
  explicit Members(const MemberGeometry& geometry) : geometry_(geometry) {}
  // `history_size`: doubles of the member itself; `loaded`: load() is not empty.
  void add(const ElementNodes& nodes, std::string id, const BeamFrame& frame, int history_size, bool loaded = false);

  // The counterparts of ElementGroup's functions in the basic system; histories are the member's own part.
  virtual bool linear_basic() const { return false; }
  virtual void initialize_basic(int element, double* history) const { (void)element; (void)history; }
  virtual void start_basic(int element, const double* committed, double* trial) const {
    (void)element; (void)committed; (void)trial;
  }
  // Force, and its derivative if `tangent` is not null. `rounding`: of the deformations [m, rad].
  virtual void respond_basic(int element, const Vector6& deformation, const ActingLoad& acting, double rounding,
                             const double* committed, double* trial, Vector6& force, Matrix6* tangent) const = 0;
  // The same for respond_once().
  virtual void pass_basic(int element, const Vector6& deformation, const ActingLoad& acting, double rounding, const double* committed,
                          double* trial, Vector6& force, Matrix6* tangent) const {
    respond_basic(element, deformation, acting, rounding, committed, trial, force, tangent);
  }
  virtual std::vector<SectionResult> basic_sections(int element, const Vector6& deformation, const ActingLoad& acting,
                                                    const double* history) const = 0;
  // Of members with dead loads, whose present local axes are the rows of `axes`; to be called after respond_basic(), which left
  // `force` and `trial`.
  virtual DeadResponse dead_response(int element, const Vector6& deformation, const Vector6& force, double part, const Matrix3& axes,
                                     const double* committed, double* trial) const {
    (void)element; (void)deformation; (void)force; (void)part; (void)axes; (void)committed; (void)trial;
    return {};
  }

  // A member's load as it keeps it: without large rotations all of it is in local axes.
  MemberLoad kept_load(const MemberLoad& load, const BeamFrame& frame) const { return geometry_.finite() ? load : load.in(frame.axes); }

  template <class Double>
  Double* basic_history(int element, Double* history) const {
    return history + own_begin(element);
  }

  // Where the member's own part begins in the history of an element.
  int own_offset(bool loaded) const { return geometry_.history_size() + (loaded && !linear() ? 1 : 0); }

  // load() is not empty.
  bool loaded(int element) const { return places_[static_cast<std::size_t>(element)].loaded; }

  // A beam with an outline, or a straight bar without.
  ElementShape member_shape(int element, const SectionOutline* outline, const Releases& releases = {}) const;
  const MemberGeometry& geometry() const { return geometry_; }

 private:
  // The acting load, and whether some of it is dead, of which `turned` is then all in the present `axes`.
  struct Acting : ActingLoad {
    bool dead = false;
    Matrix3 axes;
    MemberLoad turned;
  };
  template <class Basic>
  void respond_by(const Basic& basic, int element, const Vector12& displacement, const double* committed, double* trial, Vector12& force,
                  Matrix12* tangent) const;
  void find_acting(int element, double part, const Vector12& displacement, const double* committed, Acting& acting) const;

  // Of a member in its group's history, and the end of the last one.
  struct Place {
    int begin = 0, own = 0;  // `own`: the member's own part, from `begin`
    bool loaded = false, factor = false;  // a linear member carries its whole load always
  };
  bool has_factor(int element) const { return places_[static_cast<std::size_t>(element)].factor; }
  int own_begin(int element) const { return places_[static_cast<std::size_t>(element)].own; }

  const MemberGeometry& geometry_;
  std::vector<BeamFrame> frames_;
  std::vector<Place> places_{Place{}};
};

}  // namespace nsframe
