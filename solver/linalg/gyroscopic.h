#pragma once

#include <Eigen/Core>
#include <functional>

#include "solver/linalg/eigenpairs.h"
#include "solver/linalg/factorization.h"
#include "solver/model/counters.h"
#include "solver/model/numbers.h"
#include "solver/model/outcome.h"

namespace trammel::solver {

/// (K + i w C - w^2 M) x = 0 with K symmetric, C skew, M symmetric and semi-definite.
struct GyroscopicPencil {
  SparseMatrix K, C, M;
  std::function<double(const Eigen::VectorXd&)> K_energy;  ///< x^T K x, more exact than K
};

struct GyroscopicModes {
  Outcome outcome;
  Eigen::VectorXd omega;        ///< ascending, > 0 [rad/s]
  Eigen::VectorXd growth_rate;  ///< [1/s]
  Eigen::MatrixXcd shape;       ///< column norm 1
  Index inertia_count = 0;
};

/// The lowest of a positive definite K, factored. With F F^T = K and R^T R = M the problem is
///   z = w (i W) z,  W = F^-1 [-C R^T; -R 0] F^-T  (the second block without F),
/// W real and skew: the eigenvectors of the symmetric W^T W (dense, or by Lanczos) span those of
/// i W. Source: Meirovitch (1974), in the inverse form, which lets M be singular.
[[nodiscard]] GyroscopicModes stable_gyroscopic_modes(const GyroscopicPencil& pencil,
                                                      const Factorization& K, Index count,
                                                      EigenMethod method, Counters& counters);

/// All of them for any K, by the dense companion matrix in 1 / lambda; each pair once.
[[nodiscard]] GyroscopicModes all_gyroscopic_modes(const GyroscopicPencil& pencil);

/// Negative eigenvalues of K + i w C - w^2 M: for a positive definite K, the number of
/// frequencies below w. -1 where the factorization fails.
[[nodiscard]] Index gyroscopic_sturm_count(const GyroscopicPencil& pencil, double omega);

}  // namespace trammel::solver
