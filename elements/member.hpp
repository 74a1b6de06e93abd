// What all two-node members share: a frame, a geometric transformation, and a history that begins with the
// transformation's. A kind of member is a class derived from Members that answers basic deformations with basic forces.
#pragma once

#include "elements/member_geometry.hpp"

namespace nsframe {

class Members : public ElementGroup {
 public:
  bool linear() const override { return geometry_.linear() && linear_basic(); }
  bool symmetric() const override { return geometry_.symmetric(); }
  int history_begin(int element) const override { return history_begin_[static_cast<std::size_t>(element)]; }
  void initialize_history(int element, double* history) const final;
  void start_step(int element, const double* committed, double* trial) const final;
  void respond(int element, const Vector12& displacement, const double* committed, double* trial, Vector12& force,
               Matrix12* tangent) const final;
  ElementPose pose(int element, const Vector12& displacement, const double* history) const final;
  std::vector<SectionResult> sections(int element, const Vector12& displacement, const double* history) const final;

  const BeamFrame& frame(int element) const { return frames_[static_cast<std::size_t>(element)]; }

 protected:
  explicit Members(const MemberGeometry& geometry) : geometry_(geometry) {}
  // `history_size`: doubles of the member itself.
  void add(const ElementNodes& nodes, std::string id, const BeamFrame& frame, int history_size);

  // The counterparts of ElementGroup's functions in the basic system; histories are the member's own part.
  virtual bool linear_basic() const { return false; }
  virtual void initialize_basic(int element, double* history) const { (void)element; (void)history; }
  virtual void start_basic(int element, const double* committed, double* trial) const {
    (void)element; (void)committed; (void)trial;
  }
  // `rounding`: of the deformations [m, rad].
  virtual void respond_basic(int element, const Vector6& deformation, double rounding, const double* committed,
                             double* trial, Vector6& force, Matrix6& tangent) const = 0;
  virtual std::vector<SectionResult> basic_sections(int element, const Vector6& deformation,
                                                    const double* history) const = 0;

  // A beam with an outline, or a straight bar without.
  ElementShape member_shape(int element, const SectionOutline* outline) const;
  const MemberGeometry& geometry() const { return geometry_; }

 private:
  const MemberGeometry& geometry_;
  std::vector<BeamFrame> frames_;
  std::vector<int> history_begin_{0};
};

}  // namespace nsframe
