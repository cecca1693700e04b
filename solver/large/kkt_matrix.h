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
/// S alone may be singular: it has no axial and no shear stiffness, because stretch and shear are
/// rows of G. The same equation is therefore factored with a penalty rho <= 1 / (2c) on each row:
///
///     [ S + G^T rho G   G^T E ] [ dq ]   [ b ]
///     [ E G             -C E  ] [ y  ] = [ d ],   E = 1 - rho C,   dlambda = y + (rho / E) d.
///
/// The upper left block is positive definite if the structure is stable. Each constraint row is
/// eliminated after its coordinates. LDL^T therefore needs no pivoting, and the number of unstable
/// directions follows from the number of negative pivots. A compliance of at least 1e-11 / rho in
/// each row keeps the matrix regular if constraints are redundant. With rho = 0, the second matrix
/// equals the first matrix, and products with this matrix have no round-off errors of penalties.
/// The constructor sets the sparsity pattern. Assembling, factoring and solving reuse the memory of
/// this pattern.
class KktMatrix {
 public:
  using Blocks = std::vector<std::vector<Index>>;
  using Extended = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

  /// Sets the sparsity pattern. The unknowns are the free coordinates, followed by the multipliers
  /// of the constraint rows. `blocks` contains the unknowns that each element couples. Every row
  /// belongs to exactly one block. Negative unknowns are ignored.
  KktMatrix(Index coordinates, Index constraints, const Blocks& blocks);
  ~KktMatrix();

  void clear();

  /// Adds the matrix S of an element to the assembled matrix. `block` is the index of the element.
  /// The rows of S are the coordinates of the element, or all unknowns that the element couples.
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

  /// Adds the terms of an element with n coordinates and m constraint rows. S (n x n) is added in
  /// the coordinates, G (m x n) in the constraint rows, and D^T (n x m) in the columns of the
  /// multipliers. D equals G if the matrix is symmetric. c and rho are the m compliances and
  /// penalties.
  template <class Matrix, class Gradient, class Rows>
  void add(Index block, const Matrix& S, const Gradient& D, const Gradient& G, const Rows& c,
           const Rows& rho) {
    constexpr int N = Matrix::RowsAtCompileTime, M = Gradient::RowsAtCompileTime;
    constexpr int kSize = N == Eigen::Dynamic ? N : N + M;
    const Index n = S.rows(), m = G.rows();
    const Rows penalty = rho.cwiseMin(c.unaryExpr([](auto x) { return x > 0 ? 0.5 / x : 1e300; }));
    const Rows E = Rows::Ones(c.size()) - penalty.cwiseProduct(c);
    const Rows least = penalty.unaryExpr([](double x) { return x > 0 ? 1e-11 / x : 0; });
    const Rows compliance = c.cwiseProduct(E).cwiseMax(least);
    Eigen::Matrix<double, kSize, kSize> terms(n + m, n + m);
    const Eigen::Matrix<double, N, M> penalized = D.transpose() * penalty.asDiagonal();
    terms.template topLeftCorner<N, N>(n, n) = S + penalized.lazyProduct(G);
    terms.template topRightCorner<N, M>(n, m) = D.transpose() * E.asDiagonal();
    terms.template bottomLeftCorner<M, N>(m, n) = E.asDiagonal() * G;
    terms.template bottomRightCorner<M, M>(m, m) = (-compliance).asDiagonal();
    add(block, terms);
    multiplier_scaling_.segment(first_row_[static_cast<std::size_t>(block)], m) =
        penalty.cwiseQuotient(E);
  }

  /// Adds a value to the diagonal entry of a coordinate.
  void add_diagonal(Index coordinate, double value);

  /// Factors the matrix by LDL^T, or by LU if it is not symmetric or a pivot vanishes. @return
  /// false if the matrix is singular to working precision.
  [[nodiscard]] bool factor(bool symmetric);

  /// Solves the equations in place: the right-hand side (b, d) becomes (dq, dlambda).
  void solve(Eigen::Ref<VectorXd> right_hand_side) const;

  /// Returns the product of the assembled matrix with x = (q, y) in extended precision. The higher
  /// precision is required because the stiffness of a soft joint is a small difference of large
  /// products of stiff members. y is lambda if the matrix was assembled without penalties.
  [[nodiscard]] Extended multiply(const Extended& x) const;

  /// Returns the constraint gradient G scaled by the units of its rows and of the coordinates: G_rk
  /// scale_k / row_unit_r.
  /// @pre The matrix was assembled without penalties.
  [[nodiscard]] Eigen::MatrixXd constraint_gradient(const VectorXd& scale,
                                                    const VectorXd& row_units) const;

  /// Returns the energy of a motion relative to its round-off error, which results from the rounded
  /// entries of the matrix A. Coordinate i contributes |x_i| sum_j |A_ij x_j|, and the round-off
  /// error is 16 epsilon times the root of the sum of the squared contributions. A motion is free
  /// if the returned ratio is at most 1. If the plain sum of the contributions were used as error,
  /// smooth motions of fine meshes would count as free.
  [[nodiscard]] double energy_over_roundoff(const Extended& x) const;

  /// Computes the sum of the magnitudes of the terms of each equation with the unknowns x = (q,
  /// lambda).
  void term_magnitudes(const VectorXd& x, VectorXd& magnitudes) const;

  /// Returns the number of unstable directions: the number of negative pivots minus the number of
  /// constraints. The result is -1 if the matrix was not factored by LDL^T.
  [[nodiscard]] Index unstable_direction_count() const;

  [[nodiscard]] std::int64_t factorizations() const { return factorizations_; }
  [[nodiscard]] std::int64_t solves() const { return solves_; }

 private:
  struct Factors;

  void set_elimination_order(const Blocks& blocks);
  void locate_entries(const Blocks& blocks);

  Index coordinates_ = 0, constraints_ = 0;
  Eigen::PermutationMatrix<Eigen::Dynamic> permutation_;  ///< order of elimination
  Eigen::SparseMatrix<double> matrix_;                    ///< assembled matrix in elimination order
  std::vector<std::size_t> block_start_;
  /// Index of each block entry in the value array; -1: ignored unknown.
  std::vector<int> value_index_;
  std::vector<int> diagonal_;     ///< index of each diagonal entry in the value array
  std::vector<Index> first_row_;  ///< first constraint row of each block (element)
  VectorXd multiplier_scaling_;   ///< factor rho / E in dlambda, for each constraint row
  std::unique_ptr<Factors> factors_;
  mutable VectorXd work_, solution_;
  mutable std::int64_t solves_ = 0;
  std::int64_t factorizations_ = 0;
};

}  // namespace trammel::solver::large_motion
