#include "models/build_constants.hpp"

#include "elements/member_load.hpp"

namespace nsframe {

namespace {

// Matrices of elements (12x12, global axes) to one of all full DOFs.
class ElementSum {
 public:
  void add(const ElementNodes& nodes, const Matrix12& matrix) {
    for (int i = 0; i < 12; ++i) {
      for (int j = 0; j < 12; ++j) {
        const int ni = nodes[static_cast<std::size_t>(i / 6)], nj = nodes[static_cast<std::size_t>(j / 6)];
        if (ni >= 0 && nj >= 0 && matrix(i, j) != 0)
          entries_.emplace_back(6 * ni + i % 6, 6 * nj + j % 6, matrix(i, j));
      }
    }
  }
  void add(const VectorX& diagonal) {
    for (int i = 0; i < diagonal.size(); ++i) {
      if (diagonal[i] != 0) entries_.emplace_back(i, i, diagonal[i]);
    }
  }
  SparseRows matrix(int size) const {
    SparseRows sum(size, size);
    sum.setFromTriplets(entries_.begin(), entries_.end());
    return sum;
  }

 private:
  std::vector<Eigen::Triplet<double>> entries_;
};

// Of members that are assembled once: against the forces that hold their nodes in place under the load. Full DOFs.
VectorX linear_member_loads(const Model& model) {
  VectorX loads = VectorX::Zero(model.dofs.full);
  for (const auto& group : model.groups) {
    for (int e = 0; group->linear() && e < group->size(); ++e) {
      if (!group->load(e) || group->load(e)->empty()) continue;
      Vector12 holding;
      group->respond(e, Vector12::Zero(), nullptr, nullptr, holding, nullptr);
      const ElementNodes& nodes = group->nodes(e);
      loads.segment<6>(6 * nodes[0]) -= holding.head<6>();
      loads.segment<6>(6 * nodes[1]) -= holding.tail<6>();
    }
  }
  return loads;
}

}  // namespace

void share_member_masses(Model& model, const std::vector<ElementMass>& members) {
  Vector12 along_x = Vector12::Zero();
  along_x[0] = along_x[6] = 1;
  for (const ElementMass& member : members) {
    const double half = along_x.dot(member.mass * along_x) / 2;
    for (const int at : member.nodes) model.nodal_mass.segment<3>(6 * at).array() += half;
  }
}

void assemble_constants(Model& model, const VectorX& concentrated_mass, const std::vector<ElementMass>& members,
                        const GravityDescription& gravity) {
  const SparseRows& T = model.dofs.transformation;
  const SparseRows& Tt = model.dofs.transformation_transposed;
  ElementSum mass, damping;
  mass.add(concentrated_mass);
  for (const ElementMass& member : members) mass.add(member.nodes, member.mass);
  for (const auto& group : model.groups) {
    for (int e = 0; e < group->size(); ++e) damping.add(group->nodes(e), group->damping(e));
  }
  const SparseRows M = mass.matrix(model.dofs.full);
  model.mass = SparseMatrix(Tt * SparseRows(M * T)).pruned();
  model.viscous_damping = SparseMatrix(Tt * SparseRows(damping.matrix(model.dofs.full) * T));
  for (int k = 0; k < 3; ++k) {
    VectorX translation = VectorX::Zero(model.dofs.full);
    for (int i = 0; i < model.nodes.size(); ++i) translation[6 * i + k] = 1;
    model.inertia[static_cast<std::size_t>(k)] = Tt * VectorX(M * translation);
  }
  VectorX weights = concentrated_mass;
  for (int i = 0; i < model.nodes.size(); ++i) {
    weights.segment<3>(6 * i).array() *= gravity.acceleration.array();
    weights.segment<3>(6 * i + 3).setZero();
  }
  model.gravity_load = Tt * VectorX(weights + linear_member_loads(model));
  model.gravity_statically_first = gravity.statically_first;
}

double Model::total_mass() const {
  double sum = 0;
  for (int i = 0; i < nodes.size(); ++i) sum += nodal_mass[6 * i];
  return sum;
}

bool Model::loaded() const {
  if (gravity_load.size() > 0 && gravity_load.cwiseAbs().maxCoeff() > 0) return true;
  for (const auto& group : groups) {
    for (int e = 0; e < group->size(); ++e) {
      if (group->load(e) && !group->load(e)->empty()) return true;
    }
  }
  return false;
}

}  // namespace nsframe
