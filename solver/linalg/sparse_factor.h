#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

#include "solver/model/counters.h"
#include "solver/model/numbers.h"

namespace trammel::solver {

/// L D L^T of the symmetric part of matrices that share one pattern: ordering and symbolic work are
/// done once, and neither `factorize` nor `solve` allocates afterwards (the time loop's need;
/// Eigen's own permutation would).
class SparseFactor {
 public:
  /// @param pattern  square, compressed, structurally symmetric; its values do not matter
  explicit SparseFactor(const SparseMatrix& pattern);

  /// (A + A^T) / 2 of a matrix with exactly that pattern; false where a pivot vanishes.
  [[nodiscard]] bool factorize(const SparseMatrix& A);

  /// Smallest |pivot| over its diagonal entry: near zero where the matrix is singular.
  [[nodiscard]] double pivot_ratio() const;

  void solve(const Eigen::VectorXd& b, Eigen::VectorXd& x);

 private:
  std::vector<int> permutation_;      ///< coordinate -> its place in the order of elimination
  SparseMatrix upper_;                ///< upper triangle in that order
  std::vector<Index> from_, mirror_;  ///< entry of upper_ -> the two entries of A it averages
  Eigen::SimplicialLDLT<SparseMatrix, Eigen::Upper, Eigen::NaturalOrdering<int>> ldlt_;
  Eigen::VectorXd ordered_, solved_;
};

}  // namespace trammel::solver
