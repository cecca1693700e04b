#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "solver/linalg/eigenpairs.h"
#include "solver/model/effects.h"
#include "solver/model/evidence.h"
#include "solver/model/numbers.h"

namespace trammel::solver {

/// (K + i w C - w^2 M) x = 0 with K symmetric, C skew, M symmetric and semi-definite.
struct GyroscopicPencil {
  SparseMatrix K, C, M;
  Operator K_times;  ///< x -> K x, more exact than the assembled K
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)> K_products;  ///< X -> X^T K X, the same
};

struct GyroscopicModes {
  Outcome outcome;
  Eigen::VectorXd omega;        ///< ascending, > 0 [rad/s]
  Eigen::VectorXd growth_rate;  ///< [1/s]
  Eigen::MatrixXcd shape;       ///< column norm 1
};

/// The lowest modes of a positive definite K. With z = (x, i w x) the problem is linear,
///   A z = i w G z,  A = diag(K, M),  G = [-C, -M; M, 0] real and skew,
/// and A z = w^2 G^T A^-1 G z is a real symmetric pencil in which each w^2 is double. The second
/// block holds only the coordinates that have mass. Source: Meirovitch (1974).
[[nodiscard]] GyroscopicModes stable_gyroscopic_modes(const GyroscopicPencil& pencil, Index count,
                                                      EigenMethod method, Counters& counters);

/// All of them for any K, by the dense companion matrix in 1 / lambda; each pair once.
[[nodiscard]] GyroscopicModes all_gyroscopic_modes(const GyroscopicPencil& pencil);

/// Number of negative eigenvalues of K + i w C - w^2 M: for a positive definite K, the number of
/// frequencies below w. Nothing if the factorization fails.
[[nodiscard]] std::optional<Index> gyroscopic_sturm_count(const GyroscopicPencil& pencil,
                                                          double omega);

}  // namespace trammel::solver
