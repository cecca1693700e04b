#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/linalg/factorization.h"
#include "solver/linear/statics.h"
#include "solver/linear/system.h"
#include "solver/model/effects.h"
#include "solver/model/evidence.h"
#include "solver/motion/equation_of_motion.h"

/// Exact response of a model with constant matrices to a load that is linear between given times.
/// It is the reference for time integration, and an efficient method if few modes are relevant.
namespace trammel::solver {

/// Modes for superposition, with x^T M x = 1 (Varalakshmi & Srinivas 2017, Eq. 33).
struct ModalBasis {
  Outcome outcome;        ///< singular, not_converged: there are no modes
  Eigen::VectorXd omega;  ///< ascending [rad/s]; 0 for rigid modes
  Eigen::MatrixXd shape;  ///< coordinate x mode
};

/// Computes all modes of finite frequency by dense algebra of order n^3, for small models only.
/// Massless coordinates follow the other coordinates statically and have no mode. M is not
/// factored.
/// @throws ModelError  if the model has no mass.
[[nodiscard]] ModalBasis all_modes(const SparseMatrix& M, const SparseMatrix& K);

/// Response at ascending times: one row per coordinate, one column per time.
struct ModalResponse {
  Eigen::MatrixXd q, v, a;  ///< [SI], [SI/s], [SI/s^2]; a is the value after a jump of the load
};

/// Superposes modal responses at ascending times [s]. `decay` is ratio * omega of each mode [1/s]
/// (`decay_rates`); a mode is overdamped above omega. q0 and v0 are the displacements and
/// velocities at times.front(), which are projected on the modes; empty: zero.
[[nodiscard]] ModalResponse superpose(const ModalBasis& basis, const Eigen::VectorXd& decay,
                                      const SparseMatrix& M, const PiecewiseLinearLoad& load,
                                      const std::vector<double>& times, const Eigen::VectorXd& q0,
                                      const Eigen::VectorXd& v0);

/// Solution y of relaxation y' + y = factor for each load. With a relaxation time, y follows the
/// factor with a delay. Without it, y equals the factor.
struct DelayedFactors {
  Eigen::MatrixXd value, rate, acceleration;  ///< load x time [-], [1/s], [1/s^2]
};

/// Solves relaxation y' + y = factor for each load at ascending times [s]. `start` is y at
/// times.front(), used with relaxation > 0 [s]. With relaxation = 0, y equals the factor, with the
/// value after a jump.
[[nodiscard]] DelayedFactors delayed_factors(const PiecewiseLinearLoad& load, double relaxation,
                                             const Eigen::VectorXd& start,
                                             const std::vector<double>& times);

/// Adds the response of massless coordinates that no mode contains, x with M x = 0:
///
///   K (x + relaxation x') = part of the load that excites no mode.
///
/// `relaxation` is the factor of stiffness-proportional damping [s]. Without relaxation, massless
/// coordinates follow this load at once. `basis` contains all modes. q0 are the displacements at
/// times.front(); empty: zero.
void add_massless_response(const ModalBasis& basis, const SparseMatrix& M, const SparseMatrix& K,
                           double relaxation, const PiecewiseLinearLoad& load,
                           const std::vector<double>& times, const Eigen::VectorXd& q0,
                           ModalResponse& response, Counters& counters);

/// Impulse response h of y'' + 2 c y' + w^2 y = p and its integrals over a time t:
///
///   h'' + 2 c h' + w^2 h = 0, h(0) = 0, h'(0) = 1,  h1 = int h,  h2 = int h1.
///
/// A load p0 + p1 t moves the oscillator exactly by
///
///   y(t)  = y0 (1 - w^2 h1) + v0 h  + p0 h1 + p1 h2,
///
///   y'(t) = -y0 w^2 h       + v0 h' + p0 h  + p1 h1.
///
/// All c >= 0 and w >= 0 are supported: rigid motion, underdamping, critical damping and
/// overdamping. Each case has a formula without cancellation.
struct ImpulseResponse {
  double dh = 1;  ///< h' [-]
  double h = 0;   ///< [s]
  double h1 = 0;  ///< [s^2]
  double h2 = 0;  ///< [s^3]
};

/// Computes the impulse response of an oscillator at a time t >= 0 [s], with w = `omega` [rad/s]
/// and c = `decay` = ratio * w [1/s].
[[nodiscard]] ImpulseResponse impulse_response(double omega, double decay, double t);

/// State of an oscillator.
struct OscillatorState {
  double y = 0;  ///< [SI]
  double v = 0;  ///< y' [SI/s]
};

/// Returns the state of an oscillator after the time of `response`, under the load p0 at the start
/// that grows by p1 per second.
[[nodiscard]] OscillatorState advance(const ImpulseResponse& response, double omega,
                                      const OscillatorState& start, double p0, double p1);

/// Solves M a = f on the free coordinates if M may be singular. A small multiple of K is added to
/// M. Iterative refinement removes its effect on coordinates with mass. Massless coordinates get
/// the acceleration with the least strain energy.
class RegularizedMass {
 public:
  /// @pre `system` outlives this object.
  explicit RegularizedMass(const System& system);
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& f) const;

 private:
  const System& system_;
  Factorization regular_;
};

/// Loads and accelerations that balance the elastic forces K q of a motion with
/// stiffness-proportional damping. t is the factor of this damping [s]. Loads and inertia forces
/// balance K (q + t q'), so that q is delayed relative to them. If x is the solution of x + t x' =
/// loads or accelerations, the balance is
///
///   K q = x of the loads - M x of the accelerations.
class LateStrain {
 public:
  /// @pre `system` outlives this object.
  explicit LateStrain(const System& system);
  /// Writes the load factors and accelerations that balance K q into `elastic`. `factors` are the
  /// delayed factors of loads and of weight (`delayed_factors`).
  void set_loads(const Eigen::VectorXd& q, const Eigen::Vector2d& factors,
                 ElasticState& elastic) const;

 private:
  const System& system_;
  RegularizedMass mass_;
  Eigen::VectorXd weight_;  // on the free coordinates
};

}  // namespace trammel::solver
