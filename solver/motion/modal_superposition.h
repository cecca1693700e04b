#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/linalg/factorization.h"
#include "solver/linear/statics.h"
#include "solver/linear/system.h"
#include "solver/model/effects.h"
#include "solver/model/evidence.h"
#include "solver/motion/equation_of_motion.h"

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

/// Impulse response of y'' + 2 c y' + w^2 y = p and its integrals over a time t:
///   h'' + 2 c h' + w^2 h = 0, h(0) = 0, h'(0) = 1,  h1 = int h,  h2 = int h1.
/// A load p0 + p1 t moves the oscillator exactly by
///   y(t)  = y0 (1 - w^2 h1) + v0 h  + p0 h1 + p1 h2,
///   y'(t) = -y0 w^2 h       + v0 h' + p0 h  + p1 h1.
/// Any c >= 0 and w >= 0: rigid motion, under-, critical and overdamping, each by a formula that
/// keeps its digits.
struct ImpulseResponse {
  double dh = 1;  ///< h' [-]
  double h = 0;   ///< [s]
  double h1 = 0;  ///< [s^2]
  double h2 = 0;  ///< [s^3]
};

/// @param omega  w >= 0 [rad/s];  @param decay  c = ratio * w >= 0 [1/s];  @param t  >= 0 [s]
[[nodiscard]] ImpulseResponse impulse_response(double omega, double decay, double t);

struct OscillatorState {
  double y = 0;  ///< [SI]
  double v = 0;  ///< y' [SI/s]
};

/// The state a time t later, under the load p0 at its beginning and p1 per second after.
[[nodiscard]] OscillatorState advance(const ImpulseResponse& response, double omega,
                                      const OscillatorState& start, double p0, double p1);

/// M a = f on the free coordinates where M may be singular: a small share of K is added, and what
/// it moves masses by is taken back. What has no mass then strains least.
class RegularizedMass {
 public:
  /// @pre `system` outlives this
  explicit RegularizedMass(const System& system);
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& f) const;

 private:
  const System& system_;
  Factorization regular_;
};

/// What balances the strains of a motion that is damped in proportion to stiffness. K (q + t q')
/// makes them follow loads and inertia late: x + t x' = all of these, and K q = x of the loads -
/// M x of the accelerations.
class LateStrain {
 public:
  /// @pre `system` outlives this
  explicit LateStrain(const System& system);
  /// Puts loads and accelerations into `elastic` that balance K q.
  /// @param factors  of loads and of weight, each followed late (followed_factors)
  void put(const Eigen::VectorXd& q, const Eigen::Vector2d& factors, ElasticState& elastic) const;

 private:
  const System& system_;
  RegularizedMass mass_;
  Eigen::VectorXd weight_;  // on the free coordinates
};

}  // namespace trammel::solver
