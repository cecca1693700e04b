#include "solver/poses/dense_ldlt.h"

#include <algorithm>

namespace trammel::solver {

bool DenseLdlt::compute(const Eigen::MatrixXd& A) {
  const Index n = A.rows();
  L_.resize(n, n);
  pivots_.resize(n);
  scale_.resize(n);
  for (Index i = 0; i < n; ++i) {
    const double size = std::abs(A(i, i));
    scale_[i] = size > 0 ? 1 / std::sqrt(size) : 1;
  }
  for (Index j = 0; j < n; ++j) {
    for (Index i = j; i < n; ++i) L_(i, j) = scale_[i] * scale_[j] * A(i, j);
  }
  growth_ = 0;
  for (Index k = 0; k < n; ++k) {
    const double pivot = pivots_[k] = L_(k, k);
    if (pivot == 0 || !std::isfinite(pivot)) return false;
    for (Index j = k + 1; j < n; ++j) {
      if (L_(j, k) == 0) continue;
      const double factor = L_(j, k) / pivot;
      const double* const from = &L_(0, k);
      double* const to = &L_(0, j);
      for (Index i = j; i < n; ++i) to[i] -= factor * from[i];
    }
    for (Index i = k + 1; i < n; ++i) {
      L_(i, k) /= pivot;
      growth_ = std::max(growth_, std::abs(L_(i, k)));
    }
  }
  return true;
}

}  // namespace trammel::solver
