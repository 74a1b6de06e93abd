#include "elements/corotational.hpp"

#include <algorithm>
#include <limits>

#include "base/errors.hpp"
#include "base/rotation.hpp"
#include "elements/member_load.hpp"

namespace nsframe {

namespace {

using Matrix3x12 = Eigen::Matrix<double, 3, 12>;
using Matrix12x3 = Eigen::Matrix<double, 12, 3>;
using Row12 = Eigen::Matrix<double, 1, 12>;

constexpr int node_history = 7;

// A member's motion. Vectors of the two ends in order i, j.
struct Motion {
  std::array<Vector3, 2> increment;       // of the rotational DOFs since the committed state
  std::array<Quaternion, 2> node;         // rotations of the nodes
  std::array<Vector3, 2> arm;             // present
  std::array<Vector3, 2> end;             // displacements of the member's ends
  double length = 0, elongation = 0;
  Matrix3 axes;                           // rows: present member axes
  std::array<Vector3, 2> side;            // the nodes' y axes, components in `axes`
  std::array<Vector3, 2> local;           // rotation vectors of the end sections from `axes`, components in `axes`
};

struct Chord {
  Vector3 vector;  // from end i to end j at present
  double length, elongation;

  // The elongation from (l^2 - L^2)/(l + L), without the loss of digits of l - L.
  Chord(const BeamFrame& frame, const Vector3& end_i, const Vector3& end_j) {
    const Vector3 start = frame.length * frame.axes.row(0).transpose(), change = end_j - end_i;
    vector = start + change;
    length = vector.norm();
    elongation = change.dot(start + vector) / (length + frame.length);
    if (!(length > 1e-6 * frame.length)) throw ConvergenceError("the ends of a corotational member meet");
  }
};

Motion find_motion(const BeamFrame& frame, const Vector12& displacement, const double* committed) {
  Motion m;
  std::array<Matrix3, 2> section;  // columns: axes of the end sections
  for (std::size_t k = 0; k < 2; ++k) {
    const auto first = static_cast<Eigen::Index>(6 * k);
    const double* const before = committed + node_history * k;
    m.increment[k] = displacement.segment<3>(first + 3) - Eigen::Map<const Vector3>(before);
    m.node[k] = rotation_exponential(m.increment[k]) * Quaternion(before + 3);
    m.node[k].normalize();
    const Matrix3 turned = m.node[k].toRotationMatrix();
    m.arm[k] = turned * frame.offset[k];
    m.end[k] = displacement.segment<3>(first) + m.arm[k] - frame.offset[k];
    section[k] = turned * frame.axes.transpose();
  }
  const Chord chord(frame, m.end[0], m.end[1]);
  m.length = chord.length;
  m.elongation = chord.elongation;
  m.axes.row(0) = chord.vector / chord.length;
  const Vector3 x = m.axes.row(0), y = 0.5 * (section[0].col(1) + section[1].col(1));
  const Vector3 z = x.cross(y);
  if (!(z.norm() > 1e-3)) throw ConvergenceError("the ends of a corotational member turn against each other by half a circle");
  m.axes.row(2) = z.normalized();
  m.axes.row(1) = m.axes.row(2).cross(m.axes.row(0));
  for (std::size_t k = 0; k < 2; ++k) {
    const Matrix3 local = m.axes * section[k];
    m.side[k] = local.col(1);
    m.local[k] = rotation_logarithm(local);
  }
  return m;
}

// Moments that are conjugate to the local rotation vectors, from the basic forces.
std::array<Vector3, 2> vector_moments(const Vector6& q) {
  return {Vector3(-q[5], q[3], q[1]), Vector3(q[5], q[4], q[2])};
}

// Derivatives in member axes: of the axes' spin, of the end sections' spins against the axes, and of the basic
// deformations, by the spins and displacements of the ends (in member axes).
struct Rates {
  Matrix3x12 axes = Matrix3x12::Zero();
  std::array<Matrix3x12, 2> section;
  std::array<Matrix3x12, 2> local;      // of the local rotation vectors
  Matrix6x12 basic = Matrix6x12::Zero();
  Row12 length = Row12::Zero();
  double lean, height;                  // of the mean y axis: y1/y2, y2

  explicit Rates(const Motion& m) {
    height = 0.5 * (m.side[0][1] + m.side[1][1]);
    lean = 0.5 * (m.side[0][0] + m.side[1][0]) / height;
    length[0] = -1;
    length[6] = 1;
    for (const int end : {0, 1}) {
      const auto k = static_cast<std::size_t>(end);
      const int u = 6 * end;
      const double sign = end == 0 ? -1 : 1;
      axes(0, u + 2) = -sign * lean / m.length;
      axes(0, u + 3) = 0.5 * m.side[k][1] / height;
      axes(0, u + 4) = -0.5 * m.side[k][0] / height;
      axes(1, u + 2) = -sign / m.length;
      axes(2, u + 1) = sign / m.length;
    }
    for (const int end : {0, 1}) {
      const auto k = static_cast<std::size_t>(end);
      section[k] = -axes;
      section[k].middleCols<3>(6 * end + 3) += Matrix3::Identity();
      local[k] = vector_by_spin(m.local[k]) * section[k];
      basic.row(1 + end) = local[k].row(2);
      basic.row(3 + end) = local[k].row(1);
    }
    basic.row(0) = length;
    basic.row(5) = local[1].row(0) - local[0].row(0);
  }
};

// d(axes' M)/d(motion) at constant M: how the arms of the moments M (sum of both ends, member axes) change.
Matrix12 moment_arm_derivative(const Motion& m, const Rates& r, const Vector3& M) {
  std::array<Matrix3x12, 2> side;  // rates of the nodes' y axes in member axes
  for (std::size_t k = 0; k < 2; ++k) side[k] = -skew(m.side[k]) * r.section[k];
  const Row12 height = 0.5 * (side[0].row(1) + side[1].row(1));
  const Row12 lean = (0.5 * (side[0].row(0) + side[1].row(0)) - r.lean * height) / r.height;
  const double l = m.length;
  Matrix12 X = Matrix12::Zero();
  X.row(1) = M[2] / (l * l) * r.length;
  X.row(2) = M[0] / l * lean - (r.lean * M[0] + M[1]) / (l * l) * r.length;
  X.row(7) = -X.row(1);
  X.row(8) = -X.row(2);
  for (const int end : {0, 1}) {
    const auto k = static_cast<std::size_t>(end);
    X.row(6 * end + 3) = 0.5 * M[0] / r.height * (side[k].row(1) - m.side[k][1] / r.height * height);
    X.row(6 * end + 4) = -0.5 * M[0] / r.height * (side[k].row(0) - m.side[k][0] / r.height * height);
  }
  return X;
}

Matrix12 rotated(const Matrix12& local, const Matrix3& axes) {
  Matrix12 global;
  for (int row = 0; row < 12; row += 3) {
    for (int column = 0; column < 12; column += 3) {
      global.block<3, 3>(row, column).noalias() = axes.transpose() * (local.block<3, 3>(row, column) * axes).eval();
    }
  }
  return global;
}

// From the member's ends to the nodes, by the arms; then from spins to the rotational DOFs.
void carry_to_nodes(const Motion& m, Vector12& force, Matrix12* tangent) {
  for (const int end : {0, 1}) {
    const auto k = static_cast<std::size_t>(end);
    const int u = 6 * end;
    if (!m.arm[k].isZero(0)) {
      const Matrix3 arm = skew(m.arm[k]);
      const Vector3 at_end = force.segment<3>(u);
      force.segment<3>(u + 3) += arm * at_end;
      if (tangent) {
        tangent->middleRows<3>(u + 3) += (arm * tangent->middleRows<3>(u)).eval();
        tangent->middleCols<3>(u + 3) -= (tangent->middleCols<3>(u) * arm).eval();
        tangent->block<3, 3>(u + 3, u + 3) += skew(at_end) * arm;
      }
    }
    if (tangent) tangent->middleCols<3>(u + 3) = (tangent->middleCols<3>(u + 3) * spin_by_vector(m.increment[k])).eval();
  }
}

}  // namespace

void CorotationalBeam::initialize_history(double* history) const {
  std::fill_n(history, history_size(), 0.0);
  history[6] = history[node_history + 6] = 1;
}

Vector6 CorotationalBeam::deformation(const BeamFrame& frame, const Vector12& displacement, const double* committed,
                                      double* trial) const {
  const Motion m = find_motion(frame, displacement, committed);
  for (std::size_t k = 0; k < 2; ++k) {
    Eigen::Map<Vector3>(trial + node_history * k) = displacement.segment<3>(static_cast<Eigen::Index>(6 * k + 3));
    std::copy_n(m.node[k].coeffs().data(), 4, trial + node_history * k + 3);
  }
  Vector6 v;
  v << m.elongation, m.local[0][2], m.local[1][2], m.local[0][1], m.local[1][1], m.local[1][0] - m.local[0][0];
  return v;
}

double CorotationalBeam::rounding(const Vector12& displacement) const {
  return std::numeric_limits<double>::epsilon() + MemberGeometry::rounding(displacement);
}

void CorotationalBeam::to_global(const BeamFrame& frame, const Vector12& displacement, const double* committed,
                                 const Vector6& basic_force, const Matrix6& basic_tangent, Vector12& force,
                                 Matrix12* tangent) const {
  const Motion m = find_motion(frame, displacement, committed);
  const Rates rates(m);
  const Vector12 local = rates.basic.transpose() * basic_force;  // in member axes
  if (tangent) {
    Matrix12 k = rates.basic.transpose() * (basic_tangent * rates.basic).eval();
    const std::array<Vector3, 2> conjugate = vector_moments(basic_force);
    Vector3 total = Vector3::Zero();
    for (std::size_t end = 0; end < 2; ++end) {
      k += rates.section[end].transpose() * (moment_derivative(m.local[end], conjugate[end]) * rates.local[end]);
      total += vector_by_spin(m.local[end]).transpose() * conjugate[end];
    }
    k -= moment_arm_derivative(m, rates, total);
    for (int block = 0; block < 12; block += 3) k.middleRows<3>(block) -= skew(local.segment<3>(block)) * rates.axes;
    *tangent = rotated(k, m.axes);
  }
  for (int block = 0; block < 12; block += 3) force.segment<3>(block) = m.axes.transpose() * local.segment<3>(block);
  carry_to_nodes(m, force, tangent);
}

void CorotationalBeam::add_load(const BeamFrame& frame, const MemberLoad& load, double part, const Vector12& displacement,
                                const double* committed, Vector12& force, Matrix12* tangent) const {
  if (part == 0 || (load.uniform.isZero(0) && load.points.empty())) return;
  const Motion m = find_motion(frame, displacement, committed);
  const Vector12 local = part * support_forces(load, frame.length);
  Vector12 at_nodes;
  for (int block = 0; block < 12; block += 3) at_nodes.segment<3>(block) = m.axes.transpose() * local.segment<3>(block);
  if (!tangent) {
    carry_to_nodes(m, at_nodes, nullptr);
  } else {
    const Rates rates(m);
    Matrix12 k = Matrix12::Zero();
    for (int block = 0; block < 12; block += 3) k.middleRows<3>(block) = -skew(local.segment<3>(block)) * rates.axes;
    k = rotated(k, m.axes);
    carry_to_nodes(m, at_nodes, &k);
    *tangent += k;
  }
  force += at_nodes;
}

Matrix3 CorotationalBeam::axes(const BeamFrame& frame, const Vector12& displacement, const double* committed) const {
  return find_motion(frame, displacement, committed).axes;
}

void CorotationalBeam::add_dead_load(const BeamFrame& frame, const MemberLoad& load, double part, const DeadMoment& moment,
                                     const Vector12& displacement, const double* committed, Vector12& force,
                                     Matrix12* tangent) const {
  const Motion m = find_motion(frame, displacement, committed);
  const Rates rates(m);
  const auto supports = [&](const Matrix3& axes) {
    return Vector12(part * support_forces(MemberLoad{Vector3::Zero(), {}, load.dead_uniform, load.dead_points}.in(axes), frame.length));
  };
  Vector12 local = supports(m.axes);
  // the moment counts displacements along the chord from where the load is without any, the supports' shares from where the
  // stretched chord has it
  const auto stretched = [](const Vector3& at_j) { return Vector3(0, at_j.z(), -at_j.y()); };
  const Vector3 by_length = stretched(local.segment<3>(6)), total = moment.moment + m.elongation * by_length;
  local += rates.axes.transpose() * total;
  Vector12 at_nodes;
  for (int block = 0; block < 12; block += 3) at_nodes.segment<3>(block) = m.axes.transpose() * local.segment<3>(block);
  if (!tangent) {
    carry_to_nodes(m, at_nodes, nullptr);
  } else {
    const Matrix12 mixed = rates.basic.transpose() * (moment.force_by_spin * rates.axes);
    Matrix12x3 turned;
    for (int i = 0; i < 3; ++i) turned.col(i) = supports(-skew(Vector3::Unit(i)) * m.axes);
    Matrix12 k = mixed + mixed.transpose() + moment_arm_derivative(m, rates, total) + rates.axes.transpose() * (by_length * rates.length);
    Matrix3 by_spin = moment.by_spin;
    for (int i = 0; i < 3; ++i) by_spin.col(i) += m.elongation * stretched(turned.col(i).segment<3>(6));
    k += (turned + rates.axes.transpose() * by_spin) * rates.axes;
    for (int block = 0; block < 12; block += 3) k.middleRows<3>(block) -= skew(local.segment<3>(block)) * rates.axes;
    k = rotated(k, m.axes);
    carry_to_nodes(m, at_nodes, &k);
    *tangent += k;
  }
  force += at_nodes;
}

ElementPose CorotationalBeam::pose(const BeamFrame& frame, const Vector12& displacement, const double* history) const {
  const Motion m = find_motion(frame, displacement, history);
  return {m.axes, m.arm, m.length, m.end, m.local};
}

Vector6 CorotationalBar::deformation(const BeamFrame& frame, const Vector12& displacement, const double*,
                                     double*) const {
  return Chord(frame, displacement.head<3>(), displacement.segment<3>(6)).elongation * Vector6::Unit(0);
}

void CorotationalBar::to_global(const BeamFrame& frame, const Vector12& displacement, const double*,
                                const Vector6& basic_force, const Matrix6& basic_tangent, Vector12& force,
                                Matrix12* tangent) const {
  const Chord chord(frame, displacement.head<3>(), displacement.segment<3>(6));
  const Vector3 direction = chord.vector / chord.length;
  force.setZero();
  force.head<3>() = -basic_force[0] * direction;
  force.segment<3>(6) = basic_force[0] * direction;
  if (!tangent) return;
  const double turning = basic_force[0] / chord.length;
  const Matrix3 k = (basic_tangent(0, 0) - turning) * direction * direction.transpose() + turning * Matrix3::Identity();
  tangent->setZero();
  for (const int row : {0, 6}) {
    for (const int column : {0, 6}) tangent->block<3, 3>(row, column) = row == column ? k : Matrix3(-k);
  }
}

ElementPose CorotationalBar::pose(const BeamFrame& frame, const Vector12& displacement, const double*) const {
  const Chord chord(frame, displacement.head<3>(), displacement.segment<3>(6));
  ElementPose pose;
  pose.axes = frame.axes * shortest_rotation(frame.axes.row(0), chord.vector / chord.length).toRotationMatrix().transpose();
  return pose;
}

}  // namespace nsframe
