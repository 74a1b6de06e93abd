// J = M + a C + b K (theory.md: a = theta h, b = a^2 in (9); (302)), factored block by block, one block a connected structure.
// Small structures: dense, with an explicit inverse once the factors have served so often that it pays. Large
// ones: sparse, with the low-rank modal damping added by the Woodbury identity so that J keeps the pattern of K; their factors, too, are put
// in a faster form once they have served often.
#pragma once

#include <memory>
#include <variant>

#include "assembly/system.hpp"
#include "base/chunked_rows.hpp"
#include "base/decompositions.hpp"
#include "integrators/contact_response.hpp"
#include "models/snapshot.hpp"

namespace nsframe {

struct IterationMatrixOptions {
  int dense_limit = 160;  // rows of a structure up to which its block is dense
};

class IterationMatrix {
 public:
  explicit IterationMatrix(const System& system, IterationMatrixOptions options = {});

  // Factors J; throws ConvergenceError when a block is singular, naming the structure.
  void factor(const System& system, const SparseMatrix& stiffness, double a, double b);
  void factor(const System& system, const SparseMatrix& stiffness, double a) { factor(system, stiffness, a, a * a); }
  bool ready(double a, double b) const { return a_ == a && b_ == b; }
  bool ready(double a) const { return ready(a, a * a); }
  long factorizations() const { return factorizations_; }
  // Of the inverses and factors, as far as they are in the form that solves fastest.
  StoredEntries entries() const;

  // The factors stay in use for many steps: a snapshot holds the stiffness that they were made from.
  void save(Snapshot& snapshot, const std::string& name = "iteration_matrix") const;
  void restore(System& system, const Snapshot& snapshot, const std::string& name = "iteration_matrix");

  // x = J^-1 rhs; x and rhs may not be the same.
  void solve(const VectorX& rhs, VectorX& x);
  // J^-1 H' of one contact pair (computed once a factorization).
  const ContactResponse& response(const Contacts& contacts, int pair);
  // H J^-1 H' of it: the rates of all pairs by its unit impulse.
  const VectorX& rates_by(const Contacts& contacts, int pair);
  // J^-1 T' of a row of Contacts::tangents.
  const ContactResponse& tangent_response(const Contacts& contacts, int row);
  // x = J^-1 H' p, p on some pairs: from their responses, or by one solution where that costs less.
  void respond(const Contacts& contacts, const std::vector<int>& pairs, const VectorX& p, VectorX& x);
  // Numbers stored of the responses so far.
  std::size_t response_entries() const;

 private:
  using SparseFactor = std::variant<std::unique_ptr<SparseCholesky>, std::unique_ptr<Eigen::SparseLU<SparseMatrix>>>;
  struct Block {
    BlockRange range;
    bool dense = true;
    Eigen::LLT<MatrixX> cholesky;
    Eigen::PartialPivLU<MatrixX> lu;
    bool use_lu = false;
    SparseFactor sparse;
    std::unique_ptr<ChunkedFactor> chunked;  // the same, once it has served often
    bool analyzed = false;
    MatrixX woodbury_response;              // J0^-1 U
    Eigen::PartialPivLU<MatrixX> woodbury;  // I/a + U' J0^-1 U
    const MatrixX* modal = nullptr;
    VectorX solution;
  };
  // Brings the factors in the form that solves fastest.
  void speed_up();
  // Counts a solution; true when it goes by the fast form.
  bool next_solve();
  void solve_block(Block& block, bool fast, const VectorX& rhs, VectorX& x) const;
  // Of a sparse block, without modal damping; to block.solution.
  static void solve_undamped(Block& block, const VectorX& rhs);
  ContactResponse respond_to(const SparseRows& rows, int row);
  void factor_dense(Block& block, MatrixX J) const;
  void factor_sparse(Block& block, const SparseMatrix& J, double a) const;
  static void solve_sparse(const Block& block, const MatrixX& rhs, MatrixX& x);
  static VectorX modal_coefficients(const Block& block);

  bool symmetric_, linear_;
  double a_ = -1, b_ = -1;
  long factorizations_ = 0;
  std::vector<double> stiffness_;         // entries of the factored one, in the order of Assembler::tangent()
  std::vector<double> damping_;           // entries of Damping::tangent in the factored one
  std::vector<Block> blocks_;
  BlockOperator inverse_;                 // of the dense blocks
  bool all_dense_ = true;
  int threads_;
  int solves_ = 0;                        // since the last factorization
  std::vector<ContactResponse> responses_, tangent_responses_;
  std::vector<VectorX> rates_;
  VectorX unit_;
};

}  // namespace nsframe
