#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "solver/linalg/eigenpairs.h"
#include "solver/model/effects.h"
#include "solver/model/evidence.h"
#include "solver/model/numbers.h"

namespace trammel::solver {

/// Gyroscopic eigenvalue problem (K + i w C - w^2 M) x = 0 with the angular frequency w. The
/// stiffness matrix K is symmetric, the gyroscopic matrix C is skew-symmetric, and the mass matrix
/// M is symmetric and positive semidefinite.
struct GyroscopicPencil {
  SparseMatrix K, C, M;
  Operator K_times;  ///< x -> K x, more accurate than the assembled K
  /// Function that returns X^T K X for the columns of X, more accurate than with the assembled K.
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)> K_products;
};

/// Vibration modes of a gyroscopic system, x exp((growth_rate + i omega) t).
struct GyroscopicModes {
  Outcome outcome;
  Eigen::VectorXd omega;        ///< angular frequency, ascending; 0 for pure growth [rad/s]
  Eigen::VectorXd growth_rate;  ///< growth rate; 0 for pure vibration [1/s]
  Eigen::MatrixXcd shape;       ///< one mode shape of norm 1 per column
};

/// Computes the `count` lowest vibration modes for a positive definite K. With z = (x, i omega x),
/// the eigenvalue problem is linear:
///
///   \f[ A z = i \omega G z, \quad A = \operatorname{diag}(K, M), \quad
///       G = \begin{bmatrix} -C & -M \\ M & 0 \end{bmatrix}. \f]
///
/// A z = omega^2 G^T A^-1 G z is a real symmetric pencil, in which each eigenvalue omega^2 occurs
/// twice. The second block of z contains only velocities of coordinates that have mass.
/// Source: Meirovitch (1974).
[[nodiscard]] GyroscopicModes stable_gyroscopic_modes(const GyroscopicPencil& pencil, Index count,
                                                      EigenMethod method, Counters& counters);

/// Computes the modes x exp(lambda t) for any K from a dense companion matrix, whose eigenvalues
/// are 1 / lambda. One mode is returned for each pair of conjugate eigenvalues. For real
/// eigenvalues, only growing modes (lambda > 0) are returned.
[[nodiscard]] GyroscopicModes all_gyroscopic_modes(const GyroscopicPencil& pencil);

/// Returns the number of negative eigenvalues of K + i w C - w^2 M, where w is `omega`. For a
/// positive definite K, the result is the number of angular frequencies below w. Returns an empty
/// value if the factorization fails.
[[nodiscard]] std::optional<Index> gyroscopic_sturm_count(const GyroscopicPencil& pencil,
                                                          double omega);

}  // namespace trammel::solver
