#include "models/mode_names.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

namespace nsframe {

namespace {

VectorX full_shape(const Model& model, const Structure& structure, const VectorX& shape) {
  VectorX q = VectorX::Zero(model.dofs.size());
  q.segment(structure.first_dof, structure.last_dof - structure.first_dof) = shape;
  return model.dofs.expand(q);
}

// Nodes of a structure by level, heights rounded to a millimetre.
std::map<long, std::vector<int>> levels(const Model& model, const Structure& structure) {
  std::map<long, std::vector<int>> by_height;
  for (const int node : structure.nodes) {
    by_height[std::lround(1e3 * model.nodes.position[static_cast<std::size_t>(node)].z())].push_back(node);
  }
  return by_height;
}

}  // namespace

Eigen::Vector4d directional_energy(const Model& model, const Structure& structure, const VectorX& shape) {
  const VectorX u = full_shape(model, structure, shape);
  Eigen::Vector4d energy = Eigen::Vector4d::Zero();
  for (const auto& [height, nodes] : levels(model, structure)) {
    Vector3 mass = Vector3::Zero(), momentum = Vector3::Zero();
    Vector2 moment = Vector2::Zero();  // for the centre of mass
    for (const int node : nodes) {
      const Vector3 m = model.nodal_mass.segment<3>(6 * node);
      mass += m;
      momentum += m.cwiseProduct(u.segment<3>(6 * node));
      moment += m.head<2>().cwiseProduct(model.nodes.position[static_cast<std::size_t>(node)].head<2>());
    }
    const Vector2 center = (moment.array() / mass.head<2>().array().max(1e-300)).matrix();
    double angular = 0, inertia = 0;
    for (const int node : nodes) {
      const Vector3 m = model.nodal_mass.segment<3>(6 * node);
      const Vector2 arm = model.nodes.position[static_cast<std::size_t>(node)].head<2>() - center;
      const double rotary = model.nodal_mass[6 * node + 5];
      inertia += rotary + m.x() * arm.y() * arm.y() + m.y() * arm.x() * arm.x();
      angular += rotary * u[6 * node + 5] + m.y() * arm.x() * u[6 * node + 1] - m.x() * arm.y() * u[6 * node];
    }
    for (int k = 0; k < 3; ++k) {
      if (mass[k] > 0) energy[k == 2 ? 3 : k] += 0.5 * momentum[k] * momentum[k] / mass[k];
    }
    if (inertia > 0) energy[2] += 0.5 * angular * angular / inertia;
  }
  return energy;
}

std::vector<std::string> name_modes(const Model& model, const Structure& structure, const MatrixX& shapes) {
  constexpr std::array<char, 4> letters{'L', 'T', 'R', 'V'};
  std::array<int, 4> count{};
  std::vector<std::string> names;
  for (Eigen::Index i = 0; i < shapes.cols(); ++i) {
    Eigen::Index direction = 0;
    directional_energy(model, structure, shapes.col(i)).maxCoeff(&direction);
    const auto at = static_cast<std::size_t>(direction);
    names.push_back(fmt::format("{}{}", letters[at], ++count[at]));
  }
  return names;
}

Vector3 participation(const Model& model, const Structure& structure, const VectorX& shape) {
  Vector3 momentum, mass = Vector3::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    momentum[static_cast<Eigen::Index>(k)] =
        shape.dot(model.inertia[k].segment(structure.first_dof, structure.last_dof - structure.first_dof));
  }
  for (const int node : structure.nodes) mass += model.nodal_mass.segment<3>(6 * node);
  return (momentum.array().square() / mass.array().max(1e-300)).matrix();
}

}  // namespace nsframe
