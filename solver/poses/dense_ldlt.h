#pragma once

#include <Eigen/Core>
#include <cmath>

#include "solver/model/numbers.h"

namespace trammel::solver {

/// L D L^T, without exchanges, of a small symmetric matrix scaled to a unit diagonal; stored dense,
/// its zeros passed over. After the first call nothing allocates.
class DenseLdlt {
 public:
  /// False where a pivot was zero or not finite; then nothing else may be asked.
  /// @param A  its lower triangle is read
  [[nodiscard]] bool compute(const Eigen::MatrixXd& A);

  /// Of the scaled matrix: below 1, and for a positive definite one no less than its smallest
  /// eigenvalue.
  [[nodiscard]] double smallest_pivot() const { return pivots_.minCoeff(); }
  /// Sylvester: the number of negative eigenvalues.
  [[nodiscard]] Index negative_pivots() const { return (pivots_.array() < 0).count(); }
  /// Largest |L|: beyond about 1e8 the signs of the pivots mean nothing.
  [[nodiscard]] double element_growth() const { return growth_; }

  /// Right-hand sides side by side, one a row, so that a step is the same for all of them.
  template <class Block>
  void solve_in_place(Block& X) const {
    const Index n = L_.rows();
    for (Index i = 0; i < n; ++i) X.col(i) *= scale_[i];
    for (Index k = 0; k < n; ++k) {
      for (Index i = k + 1; i < n; ++i) {
        if (L_(i, k) != 0) X.col(i) -= L_(i, k) * X.col(k);
      }
    }
    for (Index k = n - 1; k >= 0; --k) {
      X.col(k) /= pivots_[k];
      for (Index i = k + 1; i < n; ++i) {
        if (L_(i, k) != 0) X.col(k) -= L_(i, k) * X.col(i);
      }
    }
    for (Index i = 0; i < n; ++i) X.col(i) *= scale_[i];
  }

 private:
  Eigen::MatrixXd L_;
  Eigen::VectorXd pivots_, scale_;
  double growth_ = 0;
};

}  // namespace trammel::solver
