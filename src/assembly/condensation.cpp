#include "assembly/condensation.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "assembly/assembler.hpp"

namespace nsframe {

namespace {

constexpr double worthwhile = 0.75;  // part of the entries that may be left: every step also finds all displacements from those that are kept

std::vector<bool> candidates_of(const Model& model) {
  const auto n = static_cast<std::size_t>(model.dofs.size());
  std::vector<bool> may(n, true);
  const auto keep = [&](int dof) { may[static_cast<std::size_t>(dof)] = false; };
  for (int j = 0; j < model.mass.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator entry(model.mass, j); entry; ++entry) {
      if (entry.value() != 0) keep(j);
    }
    for (SparseMatrix::InnerIterator entry(model.viscous_damping, j); entry; ++entry) {
      if (entry.value() != 0) keep(j);
    }
    if (model.initial_displacement[j] != 0 || model.initial_velocity[j] != 0) keep(j);
  }
  for (const StaticStage& stage : model.stages) {
    for (const VectorX* row : {&stage.pattern, &stage.control_row}) {
      for (Eigen::Index i = 0; i < row->size(); ++i) {
        if ((*row)[i] != 0) keep(static_cast<int>(i));
      }
    }
  }
  for (const SparseRows* rows : {&model.contacts.jacobian, &model.contacts.tangents}) {
    for (int c = 0; c < rows->outerSize(); ++c) {
      for (SparseRows::InnerIterator entry(*rows, c); entry; ++entry) keep(static_cast<int>(entry.col()));
    }
  }
  for (const auto& group : model.groups) {
    for (int e = 0; !group->linear() && e < group->size(); ++e) {
      for (const int node : group->nodes(e)) {
        for (int k = 0; node >= 0 && k < 6; ++k) {
          for (SparseRows::InnerIterator entry(model.dofs.transformation, 6 * node + k); entry; ++entry) keep(static_cast<int>(entry.col()));
        }
      }
    }
  }
  for (const Structure& structure : model.structures) {
    const DampingDescription& damping = structure.damping;
    if (damping.kind != DampingKind::rayleigh || (!damping.frequencies && damping.stiffness_factor == 0)) continue;
    for (int i = structure.first_dof; i < structure.last_dof; ++i) keep(i);
  }
  return may;
}

// The pattern of a stiffness matrix as neighbours of its DOFs, in any order, which are taken out one after the other.
class Graph {
 public:
  explicit Graph(const SparseMatrix& matrix) : neighbours_(static_cast<std::size_t>(matrix.rows())), mark_(neighbours_.size(), 0) {
    for (int j = 0; j < matrix.outerSize(); ++j) {
      for (SparseMatrix::InnerIterator entry(matrix, j); entry; ++entry) {
        if (entry.row() != entry.col()) neighbours_[static_cast<std::size_t>(j)].push_back(static_cast<int>(entry.row()));
      }
    }
  }
  // Neighbours of a set of DOFs that are not in it.
  std::vector<int> boundary(const std::vector<int>& dofs) {
    std::vector<int> around;
    mark_all(dofs);
    for (const int i : dofs) {
      for (const int j : neighbours_[static_cast<std::size_t>(i)]) {
        if (mark(j)) around.push_back(j);
      }
    }
    return around;
  }
  // Entries of one triangle that go less those that come; `around` is the boundary.
  long gain(const std::vector<int>& dofs, const std::vector<int>& around) {
    const auto own = static_cast<long>(dofs.size()), other = static_cast<long>(around.size());
    mark_all(dofs);
    const long inside = marked_neighbours(dofs) / 2;
    long links = 0;
    for (const int i : dofs) links += static_cast<long>(neighbours_[static_cast<std::size_t>(i)].size());
    links -= 2 * inside;
    mark_all(around);
    const long fill = other * (other - 1) / 2 - marked_neighbours(around) / 2;
    return own + inside + links - fill;
  }
  void take_out(const std::vector<int>& dofs, const std::vector<int>& around) {
    for (const int i : around) {
      std::vector<int>& own = neighbours_[static_cast<std::size_t>(i)];
      mark_all(dofs);
      mark(i);
      std::vector<int> left;
      for (const std::vector<int>* list : {static_cast<const std::vector<int>*>(&own), &around}) {
        for (const int j : *list) {
          if (mark(j)) left.push_back(j);
        }
      }
      own = std::move(left);
    }
    for (const int i : dofs) neighbours_[static_cast<std::size_t>(i)].clear();
  }
  // A positive definite matrix of the pattern that is left.
  SparseMatrix pattern(const std::vector<bool>& out) const {
    std::vector<int> place(out.size(), -1);
    int count = 0;
    for (std::size_t i = 0; i < out.size(); ++i) place[i] = out[i] ? -1 : count++;
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t i = 0; i < out.size(); ++i) {
      if (out[i]) continue;
      entries.emplace_back(place[i], place[i], 1.0 + static_cast<double>(neighbours_[i].size()));
      for (const int j : neighbours_[i]) entries.emplace_back(place[i], place[static_cast<std::size_t>(j)], -1.0);
    }
    SparseMatrix matrix(count, count);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

 private:
  void mark_all(const std::vector<int>& dofs) {
    ++stamp_;
    for (const int i : dofs) mark(i);
  }
  // False when it was marked since the last mark_all() began.
  bool mark(int dof) {
    int& own = mark_[static_cast<std::size_t>(dof)];
    return own != stamp_ && (own = stamp_);
  }
  long marked_neighbours(const std::vector<int>& dofs) const {
    long count = 0;
    for (const int i : dofs) {
      for (const int j : neighbours_[static_cast<std::size_t>(i)]) count += mark_[static_cast<std::size_t>(j)] == stamp_;
    }
    return count;
  }

  std::vector<std::vector<int>> neighbours_;
  std::vector<int> mark_;
  int stamp_ = 0;
};

// What one solution and one product with the stiffness read.
long entries_read(const SparseMatrix& pattern, int dense_limit) {
  const auto n = static_cast<long>(pattern.rows());
  if (n <= dense_limit) return n * n + pattern.nonZeros();
  const Eigen::SimplicialLDLT<SparseMatrix> factor(pattern);
  return 2 * static_cast<long>(factor.matrixL().nestedExpression().nonZeros()) + pattern.nonZeros();
}

// The candidates of one structure that go; `nodes` gives the node of every DOF.
std::vector<bool> choose_condensed(Graph& graph, const std::vector<bool>& candidates, const std::vector<int>& nodes, bool all) {
  constexpr std::size_t widest = 240;  // neighbours of a node beyond which it stays
  std::vector<bool> out(candidates.size(), false);
  std::map<int, std::vector<int>> groups;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (candidates[i]) groups[nodes[i]].push_back(static_cast<int>(i));
  }
  if (all) {
    for (const auto& [node, dofs] : groups) graph.take_out(dofs, graph.boundary(dofs));
    return candidates;
  }
  std::set<std::pair<long, int>> queue;  // loss, node; losses may be out of date
  const auto put = [&](int node, const std::vector<int>& dofs) {
    const std::vector<int> around = graph.boundary(dofs);
    if (around.size() <= widest) queue.insert({-graph.gain(dofs, around), node});
  };
  for (const auto& [node, dofs] : groups) put(node, dofs);
  while (!queue.empty()) {
    const auto [loss, node] = *queue.begin();
    queue.erase(queue.begin());
    const auto found = groups.find(node);
    if (found == groups.end()) continue;
    const std::vector<int> around = graph.boundary(found->second);
    if (around.size() > widest) continue;
    const long now = -graph.gain(found->second, around);
    if (now > loss) {
      queue.insert({now, node});
      continue;
    }
    if (now > 0) break;
    graph.take_out(found->second, around);
    for (const int i : found->second) out[static_cast<std::size_t>(i)] = true;
    groups.erase(found);
    std::set<int> touched;
    for (const int i : around) touched.insert(nodes[static_cast<std::size_t>(i)]);
    for (const int neighbour : touched) {
      if (const auto other = groups.find(neighbour); other != groups.end()) put(neighbour, other->second);
    }
  }
  return out;
}

// A and q0 for DOFs that are taken out; false when statics does not determine them.
bool fill_reduction(const Model& model, const SparseMatrix& K, const std::vector<bool>& out, Reduction& reduction) {
  const auto n = static_cast<int>(out.size());
  std::vector<int> place(out.size()), taken;
  for (int i = 0; i < n; ++i) {
    auto& list = out[static_cast<std::size_t>(i)] ? taken : reduction.kept;
    place[static_cast<std::size_t>(i)] = static_cast<int>(list.size());
    list.push_back(i);
  }
  const auto c = static_cast<int>(taken.size());
  std::vector<Eigen::Triplet<double>> inner, coupling;
  for (int j = 0; j < n; ++j) {
    for (SparseMatrix::InnerIterator entry(K, j); entry; ++entry) {
      const auto i = static_cast<std::size_t>(entry.row());
      if (!out[i] || entry.value() == 0) continue;
      (out[static_cast<std::size_t>(j)] ? inner : coupling).emplace_back(place[i], place[static_cast<std::size_t>(j)], entry.value());
    }
  }
  SparseMatrix K_cc(c, c), K_cm(c, n - c);
  K_cc.setFromTriplets(inner.begin(), inner.end());
  K_cm.setFromTriplets(coupling.begin(), coupling.end());
  const Eigen::SimplicialLDLT<SparseMatrix> factor(K_cc);
  if (factor.info() != Eigen::Success) return false;
  const VectorX pivots = factor.vectorD(), size = K_cc.diagonal();
  if (!(pivots.minCoeff() > 1e-12 * size.minCoeff())) return false;
  const SparseMatrix follow = factor.solve(K_cm);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t p = 0; p < reduction.kept.size(); ++p) entries.emplace_back(reduction.kept[p], static_cast<int>(p), 1.0);
  for (int j = 0; j < follow.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator entry(follow, j); entry; ++entry) {
      if (entry.value() != 0) entries.emplace_back(taken[static_cast<std::size_t>(entry.row())], j, -entry.value());
    }
  }
  reduction.map.resize(n, n - c);
  reduction.map.setFromTriplets(entries.begin(), entries.end());
  reduction.rest = VectorX::Zero(n);
  const VectorX standing = factor.solve(VectorX(model.gravity_load(taken)));  // solved in place, which rows picked from `rest` cannot hold
  reduction.rest(taken) = standing;
  return true;
}

}  // namespace

Condensation find_condensation(const Model& model, int dense_limit) {
  Condensation result;
  const std::vector<bool> may = candidates_of(model);
  result.candidates = static_cast<int>(std::count(may.begin(), may.end(), true));
  const auto by_arc = [](const StaticStage& stage) { return stage.options.control == "arc-length"; };
  result.kept_for_arcs = std::any_of(model.stages.begin(), model.stages.end(), by_arc);
  if (result.candidates == 0 || result.kept_for_arcs) return result;
  const Assembler assembler(model);  // whose tangent has the linear elements only, until it is evaluated
  std::vector<bool> out(may.size(), false);
  for (const Structure& structure : model.structures) {
    const int first = structure.first_dof, size = structure.last_dof - first;
    if (size == 0) continue;
    const std::vector<bool> candidates(may.begin() + first, may.begin() + first + size);
    const SparseMatrix K = extract_block(assembler.tangent(), {first, first + size});
    std::vector<int> nodes;
    for (int i = first; i < first + size; ++i) nodes.push_back(model.dofs.free[static_cast<std::size_t>(i)].node);
    const long before = entries_read(Graph(K).pattern(std::vector<bool>(candidates.size(), false)), dense_limit);
    result.entries_before += before;
    result.entries_after += before;
    Graph graph(K);
    const std::vector<bool> chosen = choose_condensed(graph, candidates, nodes, size <= dense_limit);
    const auto count = std::count(chosen.begin(), chosen.end(), true);
    if (count == 0 || count == size) continue;
    const long after = entries_read(graph.pattern(chosen), dense_limit);
    if (static_cast<double>(after) > worthwhile * static_cast<double>(before)) continue;
    std::copy(chosen.begin(), chosen.end(), out.begin() + first);
    result.condensed += static_cast<int>(count);
    result.entries_after += after - before;
  }
  if (result.condensed > 0 && !fill_reduction(model, assembler.tangent(), out, result.reduction)) result.condensed = 0;
  return result;
}

}  // namespace nsframe
