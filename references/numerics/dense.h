#pragma once

#include <Eigen/Dense>
#include <boost/multiprecision/eigen.hpp>

#include "references/numerics/arguments.h"

/// Dense matrices in extended precision.
namespace trammel::references {

template <class T>
using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
using RealMatrix = Matrix<Real>;
using RealVector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

/// Solves A x = b by Gaussian elimination with partial pivoting.
/// @param message  error message if A is singular
/// @throws DerivationError  if a pivot is at most `min_pivot`.
[[nodiscard]] inline RealVector solve(const RealMatrix& A, const RealVector& b, const char* message,
                                      const Real& min_pivot = Real("1e-40")) {
  const Eigen::PartialPivLU<RealMatrix> lu(A);
  if (!(lu.matrixLU().diagonal().cwiseAbs().minCoeff() > min_pivot)) throw DerivationError(message);
  return lu.solve(b);
}

}  // namespace trammel::references
