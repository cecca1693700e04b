#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstdint>
#include <memory>
#include <vector>

namespace trammel::solver::large_motion {

using Eigen::Index;
using Eigen::VectorXd;

/// Matrix of one Newton step of a constrained system with compliant constraints:
///
///     [ S   G^T ] [ dq      ]   [ b ]
///     [ G   -C  ] [ dlambda ] = [ d ],      C = diag(c), c >= 0.
///
/// S alone may be singular: it has no stretch and no shear, which are rows of G. The same equation
/// is therefore factored with a penalty rho <= 1 / (2c) on each row:
///
///     [ S + G^T rho G   G^T E ] [ dq ]   [ b ]
///     [ E G             -C E  ] [ y  ] = [ d ],   E = 1 - rho C,   dlambda = y + (rho / E) d.
///
/// Its upper left block is positive definite if the structure is stable. Each row is eliminated
/// after its coordinates. LDL^T therefore needs no pivoting, and its negative pivots count the
/// unstable directions. At least a relative 1e-11 on the diagonal of the rows keeps redundant
/// constraints regular. With rho = 0 the matrix is the first one, for exact products. The pattern
/// is set once. Assembling, factoring and solving reuse its memory.
class KktMatrix {
 public:
  using Blocks = std::vector<std::vector<Index>>;
  using Extended = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

  /// Sets the pattern.
  /// @param coordinates  number of free coordinates.
  /// @param constraints  number of rows, which are numbered from `coordinates`.
  /// @param blocks  unknowns that each element couples. Every row belongs to exactly one block.
  ///   Negative unknowns are ignored.
  KktMatrix(Index coordinates, Index constraints, const Blocks& blocks);
  ~KktMatrix();

  void clear();

  /// Adds the matrix of an element: of its coordinates, or of all unknowns of its block.
  template <class Matrix>
  void add(Index block, const Matrix& S) {
    const Index n = S.rows();
    const int* slot = value_index_.data() + block_start_[static_cast<std::size_t>(block)];
    double* a = matrix_.valuePtr();
    for (Index j = 0; j < n; ++j) {
      for (Index i = 0; i < n; ++i) {
        const int s = slot[j * n + i];
        if (s >= 0) a[s] += S(i, j);
      }
    }
  }

  /// Adds an element with constraint rows: S (n x n), D^T of the columns, G of the rows (m x n), c
  /// and rho (m). D equals G if the matrix is symmetric.
  template <class Matrix, class Gradient, class Rows>
  void add(Index block, const Matrix& S, const Gradient& D, const Gradient& G, const Rows& c,
           const Rows& rho) {
    constexpr int N = Matrix::RowsAtCompileTime, M = Gradient::RowsAtCompileTime;
    constexpr int kSize = N == Eigen::Dynamic ? N : N + M;
    const Index n = S.rows(), m = G.rows();
    const Rows penalty =
        rho.cwiseMin(c.unaryExpr([](double x) { return x > 0 ? 0.5 / x : 1e300; }));
    const Rows E = Rows::Ones(c.size()) - penalty.cwiseProduct(c);
    const Rows least = penalty.unaryExpr([](double x) { return x > 0 ? 1e-11 / x : 0; });
    const Rows compliance = c.cwiseProduct(E).cwiseMax(least);
    Eigen::Matrix<double, kSize, kSize> all(n + m, n + m);
    const Eigen::Matrix<double, N, M> penalized = D.transpose() * penalty.asDiagonal();
    all.template topLeftCorner<N, N>(n, n) = S + penalized.lazyProduct(G);
    all.template topRightCorner<N, M>(n, m) = D.transpose() * E.asDiagonal();
    all.template bottomLeftCorner<M, N>(m, n) = E.asDiagonal() * G;
    all.template bottomRightCorner<M, M>(m, m) = (-compliance).asDiagonal();
    add(block, all);
    multiplier_scaling_.segment(first_row_[static_cast<std::size_t>(block)], m) =
        penalty.cwiseQuotient(E);
  }

  /// Adds a value to the diagonal of a coordinate.
  void add_diagonal(Index coordinate, double value);

  /// Factors by LDL^T, or by LU if the matrix is not symmetric or a pivot vanishes.
  /// @return false if it is singular to working precision.
  [[nodiscard]] bool factor(bool symmetric);

  /// Solves in place: (b, d) becomes (dq, dlambda).
  void solve(Eigen::Ref<VectorXd> right_hand_side) const;

  /// Returns the product of the assembled matrix with x = (q, y) in extended precision. The
  /// stiffness of a soft joint is a difference of large products of stiff members. y is lambda if
  /// the matrix was assembled without penalties.
  [[nodiscard]] Extended multiply(const Extended& x) const;

  /// Returns G scaled by the units of the rows and of the coordinates: G_rk scale_k / row_unit_r.
  /// @pre The matrix was assembled without penalties.
  [[nodiscard]] Eigen::MatrixXd constraint_gradient(const VectorXd& scale,
                                                    const VectorXd& row_unit) const;

  /// Returns the energy of a motion over its round-off error from the rounded entries. The error is
  /// 16 epsilon times the square root of the sum of the squared terms. The motion is free up to a
  /// value of 1. The sum of the magnitudes would be too large: smooth motions of fine meshes would
  /// count as free.
  [[nodiscard]] double energy_over_roundoff(const Extended& x) const;

  /// Computes the sum of the magnitudes of the terms of each equation with the unknowns x = (q,
  /// lambda).
  void term_magnitudes(const VectorXd& x, VectorXd& magnitudes) const;

  /// Returns the number of unstable directions: negative pivots in addition to those of the
  /// constraints. It is -1 without LDL^T.
  [[nodiscard]] Index negative_pivots() const;

  [[nodiscard]] std::int64_t factorizations() const { return factorizations_; }
  [[nodiscard]] std::int64_t solves() const { return solves_; }

 private:
  struct Factors;

  void order(const Blocks& blocks);
  void locate(const Blocks& blocks);

  Index coordinates_ = 0, constraints_ = 0;
  Eigen::PermutationMatrix<Eigen::Dynamic> permutation_;  ///< order of elimination
  Eigen::SparseMatrix<double> matrix_;                    ///< in elimination order, both triangles
  std::vector<std::size_t> block_start_;
  std::vector<int> value_index_;  ///< per block, column-major: position in the values; -1: not free
  std::vector<int> diagonal_;     ///< position in the values, per coordinate
  std::vector<Index> first_row_;  ///< first row of each block
  VectorXd multiplier_scaling_;   ///< rho / E of each row
  std::unique_ptr<Factors> factors_;
  mutable VectorXd work_, solution_;
  mutable std::int64_t solves_ = 0;
  std::int64_t factorizations_ = 0;
};

}  // namespace trammel::solver::large_motion
