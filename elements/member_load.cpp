#include "elements/member_load.hpp"

namespace nsframe {

MemberLoad MemberLoad::in(const Matrix3& axes) const {
  MemberLoad local{uniform + axes * dead_uniform, points, Vector3::Zero(), {}};
  for (const Point& point : dead_points) local.points.push_back({point.position, axes * point.force});
  return local;
}

LoadedSection section_forces(const MemberLoad& load, double x, double L) {
  const Vector3& w = load.uniform;
  LoadedSection s;
  s.force = Vector3((1 - x) * L * w.x(), (0.5 - x) * L * w.y(), (0.5 - x) * L * w.z());
  s.moment = Vector3(0, 0.5 * w.z() * L * L * x * (1 - x), -0.5 * w.y() * L * L * x * (1 - x));
  for (const auto& [a, P] : load.points) {
    const bool before = x <= a;
    const double shear = before ? 1 - a : -a, moment = before ? x * (1 - a) * L : a * (1 - x) * L;
    s.force += Vector3(before ? P.x() : 0, shear * P.y(), shear * P.z());
    s.moment += Vector3(0, moment * P.z(), -moment * P.y());
  }
  return s;
}

Vector3 section_force(const MemberLoad& load, double x, double L) {
  const LoadedSection s = section_forces(load, x, L);
  return {s.force.x(), s.moment.z(), s.moment.y()};
}

Vector12 support_forces(const MemberLoad& load, double L) {
  Vector12 p = Vector12::Zero();
  p.head<3>() = -load.uniform * L * 0.5;
  p.segment<3>(6) = p.head<3>();
  for (const auto& [a, P] : load.points) {
    p.head<3>() -= (1 - a) * P;
    p.segment<3>(6) -= a * P;
  }
  p[0] += p[6];  // along x the first end holds all
  p[6] = 0;
  return p;
}

Vector6 clamped_forces(const MemberLoad& load, double L) {
  const Vector3 W = load.uniform * L;
  Vector6 q;
  q << -W.x() / 2, -W.y() * L / 12, W.y() * L / 12, W.z() * L / 12, -W.z() * L / 12, 0;
  for (const auto& [a, P] : load.points) {
    const double at_i = a * (1 - a) * (1 - a) * L, at_j = a * a * (1 - a) * L, axial = a * P.x();
    q -= (Vector6() << axial, at_i * P.y(), -at_j * P.y(), -at_i * P.z(), at_j * P.z(), 0).finished();
  }
  return q;
}

Vector6 free_deformations(const MemberLoad& load, double L, double EA, double EIz, double EIy) {
  const Vector3 W = load.uniform * L;
  const double uniform = L * L / 24;
  Vector6 v;
  v << W.x() * L / 2, uniform * W.y(), -uniform * W.y(), -uniform * W.z(), uniform * W.z(), 0;
  for (const auto& [a, P] : load.points) {
    const double b = 1 - a, at_i = a * b * (1 + b) / 6 * L * L, at_j = a * b * (1 + a) / 6 * L * L;
    v += (Vector6() << a * L * P.x(), at_i * P.y(), -at_j * P.y(), -at_i * P.z(), at_j * P.z(), 0).finished();
  }
  v[0] /= EA;
  v.segment<2>(1) /= EIz;
  v.segment<2>(3) /= EIy;
  return v;
}

void add_load(const MemberLoad& load, double factor, const BeamFrame& frame, bool p_delta, const Vector12& displacement,
              Vector12& force, Matrix12* tangent) {
  if (factor == 0 || load.empty()) return;
  const Vector12 local = support_forces(load, frame.length);
  for (const int end : {0, 6}) {
    const Vector3 at_end = factor * (frame.axes.transpose() * local.segment<3>(end));
    force.segment<3>(end) += at_end;
    force.segment<3>(end + 3) += frame.offset[end == 0 ? 0 : 1].cross(at_end);
  }
  if (!p_delta) return;
  double mean = load.uniform.x() * frame.length / 2;  // of the axial force that the load adds to the basic one
  for (const auto& [a, P] : load.points) mean += a * P.x();
  const Matrix12 shift = frame.chord_shift.transpose() * frame.chord_shift * (factor * mean / frame.length);
  force += shift * displacement;
  if (tangent) *tangent += shift;
}

}  // namespace nsframe
