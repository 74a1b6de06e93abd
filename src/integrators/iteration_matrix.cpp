#include "integrators/iteration_matrix.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/errors.hpp"
#include "base/parallel.hpp"

namespace nsframe {

namespace {

// Solves from which on an inverse, about as dear as sixty of them, or chunks of sparse factors, as dear as thirty, have paid for themselves.
constexpr int solves_before_speed_up = 40;
// Numbers of responses, over the DOFs, that take as long to add up as a solution with sparse factors.
constexpr std::size_t entries_before_solution = 24;

}  // namespace

IterationMatrix::IterationMatrix(const System& system, IterationMatrixOptions options)
    : symmetric_(system.assembler.symmetric()), linear_(system.linear()), threads_(threads_for(system.assembler.threads(), system.mass().rows())) {
  for (const BlockRange& range : system.assembler.blocks()) {
    if (range.size() == 0) continue;
    Block& block = blocks_.emplace_back();
    block.range = range;
    block.dense = range.size() <= options.dense_limit;
    all_dense_ = all_dense_ && block.dense;
  }
}

void IterationMatrix::factor(const System& system, const SparseMatrix& stiffness, double a, double b) {
  ++factorizations_;
  a_ = -1;
  solves_ = 0;
  stiffness_.assign(stiffness.valuePtr(), stiffness.valuePtr() + stiffness.nonZeros());
  damping_.assign(system.damping.tangent.valuePtr(), system.damping.tangent.valuePtr() + system.damping.tangent.nonZeros());
  responses_.assign(static_cast<std::size_t>(system.contacts().size()), {});
  rates_.assign(responses_.size(), VectorX());
  tangent_responses_.assign(static_cast<std::size_t>(system.contacts().tangents.rows()), {});
  std::size_t structure = 0;
  for (Block& block : blocks_) {
    while (system.assembler.blocks()[structure].size() == 0) ++structure;
    block.modal = &system.damping.modal[structure++];
    SparseMatrix J = b * extract_block(stiffness, block.range);
    J += extract_block(system.mass(), block.range);
    if (system.damping.viscous.nonZeros() > 0) J += a * extract_block(system.damping.viscous, block.range);
    if (system.damping.tangent.nonZeros() > 0) J += a * extract_block(system.damping.tangent, block.range);
    try {
      if (block.dense) {
        MatrixX full(J);
        if (block.modal->cols() > 0) full.noalias() += a * (*block.modal) * block.modal->transpose();
        factor_dense(block, std::move(full));
      } else {
        factor_sparse(block, J, a);
      }
    } catch (const ConvergenceError& problem) {
      throw ConvergenceError(fmt::format("structure '{}': {}", system.model.structures[structure - 1].name, problem.what()));
    }
  }
  if (linear_) speed_up();
  a_ = a;
  b_ = b;
}

void IterationMatrix::speed_up() {
  std::vector<MatrixX> inverses;
  std::vector<BlockRange> ranges;
  for (Block& block : blocks_) {
    if (block.dense) {
      const MatrixX identity = MatrixX::Identity(block.range.size(), block.range.size());
      inverses.push_back(block.use_lu ? MatrixX(block.lu.solve(identity)) : MatrixX(block.cholesky.solve(identity)));
      ranges.push_back(block.range);
    } else if (const auto* factor = std::get_if<0>(&block.sparse)) {
      block.chunked = std::make_unique<ChunkedFactor>(**factor);
    }
  }
  inverse_ = BlockOperator(inverses, ranges);
  solves_ = solves_before_speed_up;
}

StoredEntries IterationMatrix::entries() const {
  StoredEntries sum = inverse_.entries();
  for (const Block& block : blocks_) {
    if (block.chunked) sum += block.chunked->entries();
  }
  return sum;
}

void IterationMatrix::save(Snapshot& snapshot, const std::string& name) const {
  snapshot.put(name + ".a", a_);
  snapshot.put(name + ".b", b_);
  snapshot.put(name + ".factorizations", static_cast<double>(factorizations_));
  snapshot.put(name + ".solves", static_cast<double>(solves_));
  snapshot.put(name + ".stiffness", stiffness_);
  snapshot.put(name + ".damping", damping_);
}

void IterationMatrix::restore(System& system, const Snapshot& snapshot, const std::string& name) {
  const double a = snapshot.number(name + ".a");
  if (a > 0) {
    SparseMatrix stiffness = system.assembler.tangent();
    Eigen::Map<VectorX> values(stiffness.valuePtr(), stiffness.nonZeros());
    snapshot.read(name + ".stiffness", values);
    if (system.damping.follows_tangent()) {
      Eigen::Map<VectorX> damping(system.damping.tangent.valuePtr(), system.damping.tangent.nonZeros());
      snapshot.read(name + ".damping", damping);
    }
    factor(system, stiffness, a, snapshot.number(name + ".b"));
    solves_ = static_cast<int>(snapshot.number(name + ".solves"));
    if (solves_ >= solves_before_speed_up) speed_up();
  }
  factorizations_ = static_cast<long>(snapshot.number(name + ".factorizations"));
}

void IterationMatrix::factor_dense(Block& block, MatrixX J) const {
  block.use_lu = !symmetric_;
  if (!block.use_lu) {
    block.cholesky.compute(J);
    block.use_lu = block.cholesky.info() != Eigen::Success;  // softening beyond what the mass outweighs
  }
  if (block.use_lu) {
    block.lu.compute(J);
    if (!(block.lu.rcond() > 1e-15)) throw ConvergenceError("the iteration matrix is singular");
  }
}

void IterationMatrix::factor_sparse(Block& block, const SparseMatrix& J, double a) const {
  bool done = false;
  block.chunked.reset();
  if (symmetric_) {
    using Factor = SparseCholesky;
    if (!block.analyzed) {
      block.sparse = std::make_unique<Factor>();
      std::get<std::unique_ptr<Factor>>(block.sparse)->analyzePattern(J);
      block.analyzed = true;
    }
    auto& factor = *std::get<std::unique_ptr<Factor>>(block.sparse);
    factor.factorize(J);
    done = factor.info() == Eigen::Success;
  }
  if (!done) {
    auto factor = std::make_unique<Eigen::SparseLU<SparseMatrix>>();
    factor->compute(J);
    if (factor->info() != Eigen::Success) throw ConvergenceError("the iteration matrix is singular");
    block.sparse = std::move(factor);
    block.analyzed = false;
  }
  if (block.modal->cols() == 0) return;
  solve_sparse(block, *block.modal, block.woodbury_response);
  MatrixX small = block.modal->transpose() * block.woodbury_response;
  small.diagonal().array() += 1 / a;
  block.woodbury.compute(small);
}

void IterationMatrix::solve_sparse(const Block& block, const MatrixX& rhs, MatrixX& x) {
  std::visit([&](const auto& factor) { x = factor->solve(rhs); }, block.sparse);
}

VectorX IterationMatrix::modal_coefficients(const Block& block) {
  return block.woodbury.solve(block.modal->transpose() * block.solution);
}

bool IterationMatrix::next_solve() {
  if (solves_ < solves_before_speed_up && ++solves_ == solves_before_speed_up) speed_up();
  return solves_ >= solves_before_speed_up;
}

void IterationMatrix::solve(const VectorX& rhs, VectorX& x) {
  const bool fast = next_solve();
  x.resize(rhs.size());
  if (fast) inverse_.multiply(rhs, x);
  if (fast && all_dense_) return;
  parallel_for(static_cast<int>(blocks_.size()), threads_, [&](int i) { solve_block(blocks_[static_cast<std::size_t>(i)], fast, rhs, x); });
}

void IterationMatrix::solve_block(Block& block, bool fast, const VectorX& rhs, VectorX& x) const {
  if (block.dense && fast) return;
  const auto part = rhs.segment(block.range.first, block.range.size());
  auto result = x.segment(block.range.first, block.range.size());
  if (block.dense) {
    if (block.use_lu) {
      result = block.lu.solve(part);
    } else {
      result = block.cholesky.solve(part);
    }
    return;
  }
  solve_undamped(block, rhs);
  if (block.modal->cols() > 0) block.solution.noalias() -= block.woodbury_response * modal_coefficients(block);
  result = block.solution;
}

void IterationMatrix::solve_undamped(Block& block, const VectorX& rhs) {
  const auto part = rhs.segment(block.range.first, block.range.size());
  if (block.chunked) {
    block.solution.resize(part.size());
    block.chunked->solve(part.data(), block.solution.data());
  } else {
    MatrixX solution;
    solve_sparse(block, part, solution);
    block.solution = solution.col(0);
  }
}

ContactResponse IterationMatrix::respond_to(const SparseRows& rows, int row) {
  ContactResponse response(rows.cols());
  unit_ = rows.row(row).transpose();
  if (all_dense_) {
    VectorX x;
    solve(unit_, x);
    response.add(0, x);
    return response;
  }
  const bool fast = next_solve();
  VectorX x(unit_.size());
  if (fast) inverse_.multiply(unit_, x);
  for (Block& block : blocks_) {
    if (unit_.segment(block.range.first, block.range.size()).isZero(0)) continue;
    if (block.dense) {
      solve_block(block, fast, unit_, x);
      response.add(block.range.first, x.segment(block.range.first, block.range.size()));
    } else {
      solve_undamped(block, unit_);
      if (block.modal->cols() > 0) {
        response.add(block.range.first, block.solution, block.woodbury_response, modal_coefficients(block));
      } else {
        response.add(block.range.first, block.solution);
      }
    }
  }
  return response;
}

const ContactResponse& IterationMatrix::response(const Contacts& contacts, int pair) {
  ContactResponse& cached = responses_[static_cast<std::size_t>(pair)];
  if (cached.size() == 0) cached = respond_to(contacts.jacobian, pair);
  return cached;
}

const VectorX& IterationMatrix::rates_by(const Contacts& contacts, int pair) {
  VectorX& cached = rates_[static_cast<std::size_t>(pair)];
  if (cached.size() == 0) cached = contacts.jacobian * response(contacts, pair).vector();
  return cached;
}

const ContactResponse& IterationMatrix::tangent_response(const Contacts& contacts, int row) {
  ContactResponse& cached = tangent_responses_[static_cast<std::size_t>(row)];
  if (cached.size() == 0) cached = respond_to(contacts.tangents, row);
  return cached;
}

std::size_t IterationMatrix::response_entries() const {
  std::size_t sum = 0;
  for (const ContactResponse& response : responses_) sum += response.entries();
  for (const ContactResponse& response : tangent_responses_) sum += response.entries();
  return sum;
}

void IterationMatrix::respond(const Contacts& contacts, const std::vector<int>& pairs, const VectorX& p, VectorX& x) {
  std::size_t entries = 0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (p[static_cast<Eigen::Index>(k)] != 0) entries += response(contacts, pairs[k]).entries();
  }
  const auto dofs = contacts.jacobian.cols();
  if (!all_dense_ && entries > entries_before_solution * static_cast<std::size_t>(dofs)) {
    VectorX load = VectorX::Zero(dofs);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const double force = p[static_cast<Eigen::Index>(k)];
      if (force == 0) continue;
      for (SparseRows::InnerIterator entry(contacts.jacobian, pairs[k]); entry; ++entry) load[entry.col()] += force * entry.value();
    }
    return solve(load, x);
  }
  SummedResponses sum(x, dofs);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const double force = p[static_cast<Eigen::Index>(k)];
    if (force != 0) sum.add(force, response(contacts, pairs[k]));
  }
  sum.finish();
}

}  // namespace nsframe
