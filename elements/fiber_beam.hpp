// What displacement- and force-based fiber beam-columns share: sections at integration points, their histories, loads
// and releases.
#pragma once

#include <memory>

#include "elements/fiber_section.hpp"
#include "elements/member.hpp"
#include "elements/member_load.hpp"
#include "elements/quadrature.hpp"
#include "elements/releases.hpp"

namespace nsframe {

using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

struct FiberMember {
  BeamFrame frame;
  Quadrature rule;
  std::vector<std::shared_ptr<const FiberSection>> sections;  // one a point
  SectionOutline outline = {};
  MemberLoad load = {};
  Releases releases = {};
  bool inner_iterations = false;  // of force-based members: never leave unbalanced sections to the next evaluation
};

// A member's own history is: head_size() doubles of the kind, then those of the sections, each beginning at a line of cache.
class FiberBeams : public Members {
 public:
  struct Element : FiberMember {
    double torsion = 0;              // GJ/L over the member [N m]
    std::array<MemberLoad, 3> patterns = {};  // of the dead load
    bool twists = false;             // some section has a law of torsion, and torsion is not released
    std::vector<int> section_begin = {};  // in the member's own history, one a point
    int points() const { return rule.size(); }
    const FiberSection& section(int point) const { return *sections[static_cast<std::size_t>(point)]; }
    double position(int point) const { return rule.position[static_cast<std::size_t>(point)]; }
    double weight(int point) const { return rule.weight[static_cast<std::size_t>(point)] * frame.length; }  // [m]
    template <class Double>
    Double* section_history(Double* history, int point) const {
      return history + section_begin[static_cast<std::size_t>(point)];
    }
  };

  explicit FiberBeams(Geometry geometry) : Members(beam_geometry(geometry)) {}
  void add(const ElementNodes& nodes, std::string id, FiberMember member);

  const MemberLoad* load(int element) const override { return &element_at(element).load; }
  ElementShape shape(int element) const override;
  std::vector<FiberPlace> fiber_places(int element) const override;
  std::vector<FiberState> fiber_states(int element, const Vector12& displacement, const double* history) const override;
  int fibers(int element) const;
  int quiet_fibers(int element, const double* history) const override;
  void prefetch(int element, const double* committed, const double* trial) const override;

 protected:
  void initialize_basic(int element, double* history) const override;
  void start_basic(int element, const double* committed, double* trial) const override;
  // Called for every element added.
  virtual void prepare(const Element& element) { (void)element; }
  // The own history of an element with its sections' histories, from one that may keep less; `scratch` may hold it.
  virtual const double* with_sections(int element, const double* history, std::vector<double>& scratch) const {
    (void)element; (void)scratch;
    return history;
  }
  // Doubles of its own that an element keeps before the histories of its sections.
  virtual int head_size(const FiberMember& member) const = 0;
  virtual double torsion_stiffness(const FiberMember& member) const = 0;
  const Element& element_at(int element) const { return elements_[static_cast<std::size_t>(element)]; }
  // Beside axial force and bending, torsion.
  static void with_torsion(double torsion, const Vector5& basic_force, const Matrix5& basic_tangent, double twist,
                           Vector6& force, Matrix6* tangent);
  // Section result at a point from its deformation; `history`, with_sections(), as committed.
  SectionResult section_result(const Element& element, int point, const Vector3& deformation, const double* history) const;

 private:
  std::vector<Element> elements_;
};

}  // namespace nsframe
