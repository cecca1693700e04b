#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/model/counters.h"
#include "solver/model/numbers.h"

namespace trammel::solver {

/// Elimination tree of a symmetric matrix given by its upper triangle: each column's parent, the
/// row of its first entry below the diagonal in L; -1 for roots (Liu 1990).
[[nodiscard]] std::vector<Index> elimination_tree(const SparseMatrix& upper);

/// New place of each column in an order in which children precede their parent and a column's
/// descendants stand right before it. Fill-in is the same in this order.
[[nodiscard]] std::vector<Index> postorder(const std::vector<Index>& parent);

/// L D L^T of large symmetric matrices, without row exchanges, by the multifrontal method (Duff and
/// Reid 1983): columns of L with like rows are eliminated together in a dense front, so that the
/// work is done by products of dense matrices. Few zeros are stored so that fronts grow wider.
class SupernodalLdlt {
 public:
  /// @param upper  upper triangle with postordered columns
  void analyze(const SparseMatrix& upper);
  /// False where a pivot was zero or not finite.
  /// @param upper  of the pattern that was analyzed
  [[nodiscard]] bool factorize(const SparseMatrix& upper);

  [[nodiscard]] const Eigen::VectorXd& pivots() const { return D_; }
  [[nodiscard]] SparseMatrix L() const;
  /// Largest |L|, 1 at least.
  [[nodiscard]] double largest_entry() const;
  void solve_lower(Eigen::VectorXd& x) const;             ///< x <- L^-1 x
  void solve_lower_transposed(Eigen::VectorXd& x) const;  ///< x <- L^-T x

 private:
  struct Supernode {
    Index first = 0, width = 0;
    std::vector<Index> rows, children;  // rows of L below the supernode's own columns
    Eigen::MatrixXd L;                  // of its columns and rows: unit lower, then dense
    Eigen::MatrixXd update;             // what its columns subtract from its rows' entries
  };

  void find_supernodes(const SparseMatrix& upper);
  void find_rows(const SparseMatrix& lower);
  [[nodiscard]] bool eliminate(Supernode& node, Eigen::MatrixXd& front);

  std::vector<Supernode> nodes_;
  Eigen::VectorXd D_;
};

}  // namespace trammel::solver
