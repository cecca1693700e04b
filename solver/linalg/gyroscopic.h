#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "solver/linalg/eigenpairs.h"
#include "solver/model/effects.h"
#include "solver/model/evidence.h"
#include "solver/model/numbers.h"

namespace trammel::solver {

/// Gyroscopic problem (K + i w C - w^2 M) x = 0. K is symmetric, C is skew-symmetric, and M is
/// symmetric and semidefinite.
struct GyroscopicPencil {
  SparseMatrix K, C, M;
  Operator K_times;  ///< x -> K x, more accurate than the assembled K
  /// Function that returns X^T K X for the columns of X, more accurate than with the assembled K.
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)> K_products;
};

/// Vibration modes of a gyroscopic system, x exp((growth_rate + i omega) t).
struct GyroscopicModes {
  Outcome outcome;
  Eigen::VectorXd omega;        ///< ascending, > 0 [rad/s]
  Eigen::VectorXd growth_rate;  ///< [1/s]
  Eigen::MatrixXcd shape;       ///< coordinate x mode, columns of norm 1
};

/// Computes the lowest modes for a positive definite K. With z = (x, i omega x) the problem is
/// linear:
///
///   \f[ A z = i \omega G z, \quad A = \operatorname{diag}(K, M), \quad
///       G = \begin{bmatrix} -C & -M \\ M & 0 \end{bmatrix}. \f]
///
/// A z = omega^2 G^T A^-1 G z is a real symmetric pencil with double omega^2. The second block
/// of z contains only the coordinates that have mass.
/// Source: Meirovitch (1974).
[[nodiscard]] GyroscopicModes stable_gyroscopic_modes(const GyroscopicPencil& pencil, Index count,
                                                      EigenMethod method, Counters& counters);

/// Computes all modes for any K from the dense companion matrix, whose eigenvalues are 1 / lambda
/// for motions exp(lambda t). Each pair of conjugate eigenvalues is returned once.
[[nodiscard]] GyroscopicModes all_gyroscopic_modes(const GyroscopicPencil& pencil);

/// Returns the number of negative eigenvalues of K + i w C - w^2 M. For a positive definite K this
/// is the number of frequencies below w. Returns an empty value if the factorization fails.
[[nodiscard]] std::optional<Index> gyroscopic_sturm_count(const GyroscopicPencil& pencil,
                                                          double omega);

}  // namespace trammel::solver
