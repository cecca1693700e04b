#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/model/counters.h"
#include "solver/model/outcome.h"
#include "solver/time/load_history.h"

/// The exact response of a model with constant matrices to a load that is linear between given
/// times: the reference for the integrators in time, and the cheap way where few modes matter.
namespace trammel::solver {

/// Modes to superpose, with x^T M x = 1 (paper Eq. 33).
struct ModalBasis {
  Outcome outcome;        ///< not_converged: no modes at all
  Eigen::VectorXd omega;  ///< ascending [rad/s]; 0 for rigid motions
  Eigen::MatrixXd shape;  ///< coordinate x mode
};

/// Every mode of finite frequency, by dense algebra of order n^3: small models only. Coordinates
/// without mass follow statically and have no mode. M is not factored.
/// @throws ModelError  where M and K do not have the same size.
[[nodiscard]] ModalBasis all_modes(const SparseMatrix& M, const SparseMatrix& K);

/// Response at ascending times: coordinate x time.
struct ModalResponse {
  Eigen::MatrixXd q, v, a;  ///< [SI], [SI/s], [SI/s^2]; at a jump, a is the value after it
};

/// @param decay  ratio * omega of each mode [1/s] (`decay_rates`); above omega it is overdamped
/// @param q0, v0  state at times.front(), projected on the modes; empty: zero
/// @throws ModelError  where sizes differ or times do not ascend.
[[nodiscard]] ModalResponse superpose(const ModalBasis& basis, const Eigen::VectorXd& decay,
                                      const SparseMatrix& M, const PiecewiseLinearLoad& load,
                                      const std::vector<double>& times, const Eigen::VectorXd& q0,
                                      const Eigen::VectorXd& v0);

/// y of relaxation y' + y = factor, for each load: what follows it late, or at once.
struct FollowedFactors {
  Eigen::MatrixXd value, rate, acceleration;  ///< load x time [-], [1/s], [1/s^2]
};

/// @param relaxation  0: at once; at a jump, the value after it [s]
/// @param start  at times.front(), where it follows late
[[nodiscard]] FollowedFactors followed_factors(const PiecewiseLinearLoad& load, double relaxation,
                                               const Eigen::VectorXd& start,
                                               const std::vector<double>& times);

/// Adds what coordinates without mass do beside all modes, x with M x = 0 and
/// K (x + relaxation x') = what of the load moves no mode: without relaxation they follow it at
/// once.
/// @param relaxation  damping in proportion to stiffness [s]
void add_massless_coordinates(const ModalBasis& basis, const SparseMatrix& M, const SparseMatrix& K,
                              double relaxation, const PiecewiseLinearLoad& load,
                              const std::vector<double>& times, const Eigen::VectorXd& q0,
                              ModalResponse& response, Counters& counters);

}  // namespace trammel::solver
