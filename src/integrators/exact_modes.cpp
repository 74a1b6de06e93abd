#include "integrators/exact_modes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/decompositions.hpp"
#include "base/dense_kernel.hpp"
#include "base/errors.hpp"
#include "integrators/exact_damping.hpp"

namespace nsframe {

namespace {

constexpr int long_double_limit = 200;      // DOFs of a structure up to which its modes are found in long double
constexpr double slow = 1;                  // [rad/s]: below, f / w^2 would lose digits

template <class Real>
BlockModes solve_block(const MatrixX& stiffness, const MatrixX& mass, bool may_move_freely) {
  using Matrix = DenseMatrix<Real>;
  using Vector = DenseVector<Real>;
  const Eigen::Index n = mass.rows();
  Vector scale(n);
  for (Eigen::Index i = 0; i < n; ++i) scale[i] = mass(i, i) > 0 ? 1 / std::sqrt(static_cast<Real>(mass(i, i))) : Real(1);
  // q = basis s, with the mass matrix diagonal in s
  Matrix basis = Matrix::Identity(n, n);
  Vector inertia(n);
  const bool diagonal = (mass - MatrixX(mass.diagonal().asDiagonal())).cwiseAbs().maxCoeff() == 0;
  if (diagonal) {
    for (Eigen::Index i = 0; i < n; ++i) inertia[i] = mass(i, i) > 0 ? Real(1) : Real(0);
  } else {
    const Matrix scaled = scale.asDiagonal() * mass.cast<Real>() * scale.asDiagonal();
    SymmetricEigen<Real> eigen(scaled);
    basis = std::move(eigen.vectors);
    inertia = std::move(eigen.values);
  }
  basis = (scale.asDiagonal() * basis).eval();
  std::vector<Eigen::Index> massive, massless;
  for (Eigen::Index i = 0; i < n; ++i) (inertia[i] > Real(1e-12) ? massive : massless).push_back(i);
  const Matrix heavy = basis(Eigen::all, massive) * inertia(massive).cwiseSqrt().cwiseInverse().asDiagonal();
  const Matrix light = basis(Eigen::all, massless);
  const Matrix K = stiffness.cast<Real>();
  Matrix condensed = heavy.transpose() * K * heavy, follow = heavy, flexibility(n, 0);
  BlockModes modes;
  if (!massless.empty()) {
    const Eigen::LDLT<Matrix> factor(light.transpose() * K * light);
    const Matrix coupling = light.transpose() * K * heavy;
    if (!massive.empty()) {
      const Matrix static_part = factor.solve(coupling);
      condensed -= coupling.transpose() * static_part;
      follow -= light * static_part;
    }
    flexibility = factor.solve(Matrix(light.transpose()));
    modes.flexibility = Matrix(light * flexibility).template cast<double>();
  } else {
    modes.flexibility = MatrixX::Zero(n, n);
  }
  condensed = (Real(0.5) * (condensed + condensed.transpose())).eval();
  const SymmetricEigen<Real> eigen(condensed);
  Vector square = eigen.values;
  if (square.size() > 0) {
    // rounding of K alone; of a structure with supports, no mode is a rigid-body motion
    const Real zero = (may_move_freely ? Real(1e-11) : Real(0)) * square[square.size() - 1];
    for (Real& value : square) value = value <= zero ? Real(0) : value;
  }
  modes.square = square.template cast<double>();
  modes.shape = Matrix(follow * eigen.vectors).template cast<double>();
  modes.massless = light.template cast<double>();
  return modes;
}

void leave_out(double highest, BlockModes& modes) {
  Eigen::Index kept = 0;
  while (kept < modes.square.size() && modes.square[kept] <= highest * highest) ++kept;
  modes.left_out_square = modes.square.tail(modes.square.size() - kept).eval();
  modes.left_out = modes.shape.rightCols(modes.square.size() - kept).eval();
  modes.square = modes.square.head(kept).eval();
  modes.shape = modes.shape.leftCols(kept).eval();
}

// Phi w^-2 Phi' of the modes left out.
MatrixX left_out_flexibility(const BlockModes& modes) {
  return modes.left_out * modes.left_out_square.cwiseInverse().asDiagonal() * modes.left_out.transpose();
}

// Modes of one structure under its stiffness, those above `highest` apart.
BlockModes modes_of_structure(const System& system, const SparseMatrix& stiffness, std::size_t structure, double highest) {
  const BlockRange& range = system.assembler.blocks()[structure];
  if (range.size() == 0) return {VectorX(0), MatrixX(0, 0), MatrixX(0, 0), MatrixX(0, 0)};
  const MatrixX K(extract_block(stiffness, range)), M(extract_block(system.model.mass, range));
  const bool may_move_freely = system.model.structures[structure].may_move_freely;
  BlockModes block = range.size() <= long_double_limit ? solve_block<long double>(K, M, may_move_freely) : solve_block<double>(K, M, may_move_freely);
  leave_out(highest, block);
  return block;
}

// Frequencies and damping of a structure's modes at their places from `first` on, and which of them are no oscillators of their own.
void place_modes(const BlockModes& block, const BlockDamping& damping, int first, ExactModes& modes) {
  const auto count = static_cast<int>(block.square.size()), first_order = static_cast<int>(damping.follow.cols());
  std::vector<bool> coupled(static_cast<std::size_t>(count + first_order), false);
  for (const DampingCoupling& coupling : damping.couplings) {
    modes.undamped = false;
    modes.couplings.push_back(coupling);
    for (int& place : modes.couplings.back().places) {
      coupled[static_cast<std::size_t>(place)] = true;
      place += first;
    }
  }
  modes.flexibility.segment(first + count, first_order).setZero();
  for (int i = 0; i < count; ++i) {
    const int k = first + i;
    const double square = block.square[i], a = 0.5 * damping.decay[i];
    modes.square[k] = square;
    modes.decay[k] = a;
    if (a > 0) modes.undamped = false;
    if (coupled[static_cast<std::size_t>(i)]) {
      modes.flexibility[k] = 0;
    } else if (square < slow * slow || square - a * a < 1e-6 * square) {
      modes.special.push_back(k);
      modes.flexibility[k] = 0;
    } else {
      modes.damped[k] = std::sqrt(square - a * a);
      modes.flexibility[k] = 1 / square;
    }
  }
}

// What contact pairs see of the modes.
void find_contacts(const System& system, const std::vector<BlockModes>& blocks, ExactModes& modes) {
  const Contacts& contacts = system.contacts();
  const int pairs = contacts.size(), n = modes.dofs;
  modes.jacobian = contacts.jacobian;
  modes.gap.setZero(pairs, modes.padded);
  modes.massless_response.setZero(n, pairs);
  modes.velocity_jump.setZero(n, pairs);
  if (pairs == 0) return;
  const MatrixX H(contacts.jacobian);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const BlockRange& range = system.assembler.blocks()[b];
    const auto part = H.middleCols(range.first, range.size());
    const Eigen::Index first = modes.ranges[b].first, count = blocks[b].square.size();
    modes.gap.middleCols(first, count) = part * blocks[b].shape;
    modes.massless_response.middleRows(range.first, range.size()) = blocks[b].flexibility * part.transpose();
    modes.velocity_jump.middleRows(range.first, range.size()) = blocks[b].shape * modes.gap.middleCols(first, count).transpose();
  }
  modes.gap_size = modes.gap.cwiseAbs();
  modes.delassus = modes.gap * modes.gap.transpose();
  modes.compliance = H * modes.massless_response;
  modes.compliant.assign(static_cast<std::size_t>(pairs), false);
  for (int c = 0; c < pairs; ++c) {
    double flexible = 0;
    for (int k = 0; k < modes.padded; ++k) {
      if (modes.square[k] > 0) flexible += modes.gap(c, k) * modes.gap(c, k) / modes.square[k];
    }
    const bool compliant = modes.compliance(c, c) > 1e-12 * flexible;
    modes.compliant[static_cast<std::size_t>(c)] = compliant;
    if (!compliant && modes.delassus(c, c) <= 0) {
      throw InputError(fmt::format("error: neither side of contact pair '{}' can move{}", contacts.pairs[static_cast<std::size_t>(c)].name,
                                   modes.left_out > 0 ? " by modes up to analysis.highest_frequency" : ""));
    }
    if (!compliant) {
      modes.compliance.row(c).setZero();
      modes.compliance.col(c).setZero();
      modes.massless_response.col(c).setZero();
    }
    for (int k = 0; k < modes.padded; ++k) {
      if (modes.gap(c, k) * modes.gap(c, k) > 1e-18 * modes.delassus(c, c)) modes.highest = std::max(modes.highest, std::sqrt(modes.square[k]) + 2 * modes.decay[k]);
    }
  }
  for (const DampingCoupling& coupling : modes.couplings) {
    const auto count = coupling.square.size();
    const MatrixX G = modes.gap(Eigen::all, coupling.modal_places()), from = G * coupling.form.basis.topRows(count), to = coupling.form.inverse.rightCols(count) * G.transpose();
    for (const DiagonalBlock& block : coupling.form.blocks) {
      for (int c = 0; c < pairs; ++c) {  // its share of the pair's 1 / mass
        const double share = block.magnitude * from.row(c).segment(block.first, block.size).norm() * to.col(c).segment(block.first, block.size).norm();
        if (share > 1e-18 * modes.delassus(c, c)) modes.highest = std::max(modes.highest, block.magnitude);
      }
    }
  }
  modes.rest_gap = contacts.jacobian * modes.rest;
  modes.gap_offset = contacts.initial_gap + modes.rest_gap;
}

}  // namespace

std::string nonlinear_element(const System& system) {
  if (system.linear()) return {};
  for (const auto& group : system.model.groups) {
    if (group->linear() || group->size() == 0) continue;
    std::string kind(group->kind());
    std::replace(kind.begin(), kind.end(), '_', ' ');
    return fmt::format("element '{}' ({})", group->id(0), kind);
  }
  return "a load";
}

std::pair<double, double> ExactModes::complex_mode(int structure, int mode) const {
  const int place = ranges[static_cast<std::size_t>(structure)].first + mode;
  for (const DampingCoupling& coupling : couplings) {
    const auto end = coupling.places.begin() + coupling.square.size(), found = std::find(coupling.places.begin(), end, place);
    if (found != end) return {coupling.complex_damping[found - coupling.places.begin()], coupling.complex_frequency[found - coupling.places.begin()]};
  }
  return {0, 0};
}

ExactModes exact_modes(const System& system, const SparseMatrix& stiffness, double highest) {
  const Model& model = system.model;
  const int n = model.dofs.size();
  const std::vector<BlockRange>& ranges = system.assembler.blocks();
  ExactModes modes;
  modes.dofs = n;
  const MatrixX H = MatrixX(model.contacts.jacobian);
  std::vector<BlockModes> blocks;
  std::vector<BlockDamping> dampings;
  for (std::size_t b = 0; b < ranges.size(); ++b) {
    blocks.push_back(modes_of_structure(system, stiffness, b, highest));
    const MatrixX K(extract_block(stiffness, ranges[b])), part = H.middleCols(ranges[b].first, ranges[b].size());
    MatrixX C(extract_block(system.damping.viscous, ranges[b]));
    C += system.damping.modal[b] * system.damping.modal[b].transpose();
    dampings.push_back(block_damping(system, model.structures[b], blocks.back(), K, C, part));
    const auto count = static_cast<int>(blocks.back().square.size() + dampings.back().follow.cols());
    modes.ranges.push_back({modes.padded, modes.padded + (count + dense_row_padding - 1) / dense_row_padding * dense_row_padding});
    modes.padded = modes.ranges.back().last;
  }
  modes.square = modes.damped = modes.flexibility = VectorX::Ones(modes.padded);
  modes.decay = VectorX::Zero(modes.padded);
  modes.static_load = VectorX::Zero(modes.padded);
  modes.motion_load.assign(model.motions.size(), VectorX::Zero(modes.padded));
  modes.rest = VectorX::Zero(n);
  VectorX shaken = VectorX::Zero(static_cast<Eigen::Index>(model.motions.size()));
  modes.kept_mass = shaken;
  std::vector<MatrixX> shapes, projections, transposed, flexibilities;
  for (std::size_t b = 0; b < ranges.size(); ++b) {
    const BlockRange &range = ranges[b], &places = modes.ranges[b];
    const int size = range.size();
    const BlockModes& block = blocks[b];
    const BlockDamping& damping = dampings[b];
    const auto count = static_cast<int>(block.square.size()), first_order = static_cast<int>(damping.follow.cols());
    const auto left_out = static_cast<int>(block.left_out_square.size());
    modes.massless += size - count - left_out;
    modes.moving += count;
    modes.left_out += left_out;
    const MatrixX flexibility = block.flexibility + left_out_flexibility(block);
    MatrixX shape(size, count + first_order), projection(count + first_order, size);
    shape.leftCols(count) = block.shape;
    shape.rightCols(first_order) = damping.follow;
    projection.topRows(count) = block.shape.transpose() * MatrixX(extract_block(model.mass, range));
    projection.bottomRows(first_order) = damping.follow_projection;
    place_modes(block, damping, places.first, modes);
    modes.static_load.segment(places.first, count) = block.shape.transpose() * system.static_load.segment(range.first, size);
    for (std::size_t i = 0; i < model.motions.size(); ++i) {
      modes.motion_load[i].segment(places.first, count) = block.shape.transpose() * model.motion_load[i].segment(range.first, size);
      const double held = modes.motion_load[i].segment(places.first, count).squaredNorm();
      modes.kept_mass[static_cast<Eigen::Index>(i)] += held;
      shaken[static_cast<Eigen::Index>(i)] += held + (block.left_out.transpose() * model.motion_load[i].segment(range.first, size)).squaredNorm();
    }
    modes.rest.segment(range.first, size) = flexibility * system.static_load.segment(range.first, size);
    transposed.push_back(shape.transpose());
    shapes.push_back(std::move(shape));
    projections.push_back(std::move(projection));
    flexibilities.push_back(flexibility);
    const Eigen::Index before = modes.massless_basis.cols();
    const Eigen::Index massless = block.massless.cols();
    modes.massless_basis.conservativeResizeLike(MatrixX::Zero(n, before + massless + left_out));
    modes.massless_basis.block(range.first, before, size, massless) = block.massless;
    modes.massless_basis.block(range.first, before + massless, size, left_out) = block.left_out;
  }
  modes.kept_mass = (shaken.array() > 0).select(modes.kept_mass.cwiseQuotient(shaken), 1.0);
  modes.shape = BlockOperator(shapes, ranges, modes.ranges);
  modes.projection = BlockOperator(projections, modes.ranges, ranges);
  modes.shape_transposed = BlockOperator(transposed, modes.ranges, ranges);
  modes.massless_flexibility = BlockOperator(flexibilities, ranges);
  find_contacts(system, blocks, modes);
  return modes;
}

}  // namespace nsframe
