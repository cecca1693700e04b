#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstdint>
#include <memory>
#include <vector>

namespace trammel::solver::large_motion {

using Eigen::Index;
using Eigen::VectorXd;

/// The matrix of one Newton step of a constrained system with compliant constraints,
///
///     [ S   G^T ] [ dq      ]   [ b ]
///     [ G   -C  ] [ dlambda ] = [ d ],      C = diag(c), c >= 0.
///
/// S alone may be singular (it has no stretch and no shear: those are rows of G), so what is
/// factored is the same equation with a penalty rho <= 1 / (2c) on each row,
///
///     [ S + G^T rho G   G^T E ] [ dq ]   [ b ]
///     [ E G             -C E  ] [ y  ] = [ d ],   E = 1 - rho C,   dlambda = y + (rho / E) d,
///
/// whose upper left block is positive definite where the structure is stable. Each row is
/// eliminated after its coordinates, so LDL^T needs no pivoting, and its negative pivots count the
/// unstable directions. At least a relative 1e-11 on the rows' diagonal keeps redundant constraints
/// regular. With rho = 0 the matrix is the first one, for exact products.
/// The pattern is set once; assembling, factoring and solving reuse its memory.
class KktMatrix {
 public:
  using Blocks = std::vector<std::vector<Index>>;
  using Extended = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

  /// @param blocks  each lists the unknowns that an element couples; rows are numbered from.
  ///                `coordinates` on; every row belongs to one block only; unknowns below 0 or not
  ///                listed as free take no part.
  KktMatrix(Index coordinates, Index constraints, const Blocks& blocks);
  ~KktMatrix();

  void clear();

  /// Adds an element's matrix: of its coordinates, or of all unknowns of its block.
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

  /// Adds an element with constraint rows: S (n x n), D^T of the columns, which is that of the
  /// rows' G (m x n) where the matrix is symmetric, c and rho (m).
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

  /// Adds to the diagonal of one coordinate.
  void add_diagonal(Index coordinate, double value);

  /// Factors by LDL^T, or by LU where the matrix is not symmetric or a pivot vanishes.
  /// @return false: singular to working precision.
  [[nodiscard]] bool factor(bool symmetric);

  /// Solves in place: (b, d) becomes (dq, dlambda).
  void solve(Eigen::Ref<VectorXd> right_hand_side) const;

  /// Product of the matrix as it was assembled with x = (q, y), in extended precision: the
  /// stiffness of a soft joint is what remains of the products of stiff members. y is lambda if the
  /// matrix was assembled without penalties.
  [[nodiscard]] Extended multiply(const Extended& x) const;

  /// G of the rows in units of their own and of the coordinates: G_rk scale_k / row_unit_r.
  /// @pre assembled without penalties
  [[nodiscard]] Eigen::MatrixXd constraint_gradient(const VectorXd& scale,
                                                    const VectorXd& row_unit) const;

  /// Energy of a motion over the round-off error that the rounded entries leave in it: the square
  /// root of the sum of the squared terms, times 16 epsilon. Up to 1 the motion is free. The sum of
  /// the terms itself would take smooth motions of fine meshes for free.
  [[nodiscard]] double energy_over_roundoff(const Extended& x) const;

  /// Of each equation, the sum of the magnitudes of its terms with the unknowns x = (q, lambda).
  void term_magnitudes(const VectorXd& x, VectorXd& magnitudes) const;

  /// Unstable directions: negative pivots beyond those of the constraints; -1 without LDL^T.
  [[nodiscard]] Index negative_pivots() const;

  [[nodiscard]] std::int64_t factorizations() const { return factorizations_; }
  [[nodiscard]] std::int64_t solves() const { return solves_; }

 private:
  struct Factors;

  void order(const Blocks& blocks);
  void locate(const Blocks& blocks);

  Index coordinates_ = 0, constraints_ = 0;
  Eigen::PermutationMatrix<Eigen::Dynamic> permutation_;  ///< of elimination
  Eigen::SparseMatrix<double> matrix_;                    ///< in elimination order, both triangles
  std::vector<std::size_t> block_start_;
  std::vector<int> value_index_;  ///< per block, column-major: position in the values, -1: not free
  std::vector<int> diagonal_;     ///< per coordinate
  std::vector<Index> first_row_;  ///< of each block
  VectorXd multiplier_scaling_;   ///< rho / E of each row
  std::unique_ptr<Factors> factors_;
  mutable VectorXd work_, solution_;
  mutable std::int64_t solves_ = 0;
  std::int64_t factorizations_ = 0;
};

}  // namespace trammel::solver::large_motion
