// One element by itself: its forces, and the nodes moved and turned at random.
#pragma once

#include <algorithm>
#include <array>
#include <random>

#include "base/rotation.hpp"
#include "elements/beam_frame.hpp"
#include "elements/element_group.hpp"

namespace nsframe::test {

// A member that leans in all directions, with arms at its ends if wanted.
inline const Vector3 leaning_i(0.2, -0.1, 0.3), leaning_j(1.1, 0.9, 2.4);
inline const std::array<Vector3, 2> leaning_arms{Vector3(0.1, 0.25, -0.05), Vector3(-0.2, 0.1, -0.3)};
inline BeamFrame leaning_frame(bool offsets) {
  const Vector3 i = offsets ? Vector3(leaning_i + leaning_arms[0]) : leaning_i, j = offsets ? Vector3(leaning_j + leaning_arms[1]) : leaning_j;
  const Matrix3 axes = beam_axes(i, j, Vector3(0.3, 1, 0.1));
  return offsets ? BeamFrame(i, j, axes, leaning_arms) : BeamFrame(i, j, axes);
}

// The first element of a group, from its virgin state; `part` of the load between its ends acts.
class ElementProbe {
 public:
  explicit ElementProbe(const ElementGroup& group, double part = 1) : group_(group) {
    committed_ = VectorX::Zero(std::max(1, group.history_begin(1)));
    group.initialize_history(0, committed_.data());
    if (double* const factor = group.load_factor(0, committed_.data())) *factor = part;
    trial_ = committed_;
  }
  Vector12 force(const Vector12& u, Matrix12* tangent = nullptr) {
    Vector12 f;
    group_.start_step(0, committed_.data(), trial_.data());
    group_.respond(0, u, committed_.data(), trial_.data(), f, tangent);
    return f;
  }
  // ElementGroup::geometric_change() under a constant load.
  Matrix12 change(const Vector12& u, const Vector12& step) {
    group_.start_step(0, committed_.data(), trial_.data());
    return group_.geometric_change(0, u, step, 0, committed_.data(), trial_.data());
  }
  void commit() { committed_ = trial_; }
  const VectorX& committed() const { return committed_; }

 private:
  const ElementGroup& group_;
  VectorX committed_, trial_;
};

class RandomMotion {
 public:
  explicit RandomMotion(unsigned seed) : engine_(seed) {}
  double operator()() { return uniform_(engine_); }
  Vector3 vector(double size) { return size * Vector3((*this)(), (*this)(), (*this)()); }
  Vector12 vector12(double size) {
    Vector12 d;
    for (int i = 0; i < 12; ++i) d[i] = size * (*this)();
    return d;
  }
  Quaternion rotation() { return Quaternion(Eigen::Vector4d((*this)(), (*this)(), (*this)(), (*this)())).normalized(); }

 private:
  std::mt19937 engine_;
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

// Displacements that turn the leaning member about the origin by `turn` and move it by `shift` after its nodes have been moved and
// turned by `deformation` (12); rotational DOFs from zero in one increment.
inline Vector12 moved(const Vector12& deformation, const Quaternion& turn, const Vector3& shift) {
  Vector12 u;
  for (int end = 0; end < 2; ++end) {
    const Vector3& x = end == 0 ? leaning_i : leaning_j;
    u.segment<3>(6 * end) = turn * (x + deformation.segment<3>(6 * end)) + shift - x;
    const Quaternion all = turn * rotation_exponential(deformation.segment<3>(6 * end + 3));
    u.segment<3>(6 * end + 3) = rotation_logarithm(all.toRotationMatrix());
  }
  return u;
}

}  // namespace nsframe::test
