#include "solver/linalg/eigenvalue_count.h"

#include <cmath>
#include <limits>
#include <utility>

#include "solver/linalg/dense_eigen.h"
#include "solver/linalg/eigenpairs.h"
#include "solver/linalg/factorization.h"

namespace trammel::solver {

namespace {

/// A shift far above all eigenvalues that can matter, in coordinates scaled to a unit diagonal of
/// A: units of length and rotation do not mix.
double shift_above_all(const SparseMatrix& A, const SparseMatrix& B) {
  const Eigen::VectorXd scale =
      A.diagonal().cwiseAbs().unaryExpr([](double d) { return d > 0 ? 1 / std::sqrt(d) : 0.0; });
  const SparseMatrix scaled = scale.asDiagonal() * B * scale.asDiagonal();
  const double size = scaled.norm();
  return size > 0 ? std::sqrt(static_cast<double>(A.rows())) / size : 0;
}

}  // namespace

double miscounted_eigenvalues(const SparseMatrix& A, const SparseMatrix& B,
                              const Eigen::VectorXd& found, Factorization&& spent,
                              double shift_above) {
  constexpr double kClearGap = 1e-6;  // of repeated values rounding leaves much less
  Factorization factorization = std::move(spent);
  if (A.rows() == 0) return static_cast<double>(found.size());
  if (found.size() == 0) {  // none at all, however large the shift
    factorization.compute(shifted(A, B, shift_above_all(A, B)));
    return factorization.is_reliable() ? static_cast<double>(factorization.negative_pivots())
                                       : std::numeric_limits<double>::infinity();
  }
  if (shift_above > found[found.size() - 1]) {
    factorization.compute(shifted(A, B, shift_above));
    if (factorization.is_reliable() && factorization.negative_pivots() == found.size()) return 0;
  }
  for (Index below = found.size() - 1; below >= 0; --below) {
    const double low = below > 0 ? found[below - 1] : 0;
    const double gap = found[below] - low;
    if (!(gap > kClearGap * found[below])) continue;
    for (const double fraction : {0.5, 0.37, 0.61, 0.83}) {
      factorization.compute(shifted(A, B, low + fraction * gap));
      if (!factorization.is_reliable()) continue;
      return static_cast<double>(std::abs(factorization.negative_pivots() - below));
    }
  }
  const bool nothing_swings = found[found.size() - 1] == 0;
  return nothing_swings ? 0 : std::numeric_limits<double>::infinity();
}

Index dependent_vectors(const SparseMatrix& metric, const Eigen::MatrixXd& X) {
  if (X.cols() == 0) return 0;
  constexpr double kDependent = 1e-3;  // eigenvectors leave 1, twice the same rounding
  Eigen::MatrixXd products = X.transpose() * (metric * X);
  const Eigen::VectorXd scale = products.diagonal().cwiseSqrt().cwiseInverse();
  products = scale.asDiagonal() * products * scale.asDiagonal();
  const auto independent = (symmetric_eigenpairs(products).value.array() > kDependent).count();
  return X.cols() - independent;  // all, where they are not numbers
}

}  // namespace trammel::solver
