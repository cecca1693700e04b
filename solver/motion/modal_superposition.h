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
/// This response is the reference for time integration, and is computed efficiently if few modes
/// are relevant.
namespace trammel::solver {

/// Modes for superposition, with x^T M x = 1 (Varalakshmi & Srinivas 2017, Eq. 33).
struct ModalBasis {
  /// singular or not_converged: no modes were computed.
  Outcome outcome;
  /// Angular frequencies, ascending [rad/s]; 0 for rigid modes.
  Eigen::VectorXd omega;
  /// Mode shapes: one row per coordinate, one column per mode.
  Eigen::MatrixXd shape;
};

/// Computes all modes of finite frequency by dense algebra, in a time of order n^3. The method is
/// for small models only. Massless coordinates follow the other coordinates statically and have no
/// mode. M is not factored, because it may be singular.
/// @throws ModelError  if the model has no mass.
[[nodiscard]] ModalBasis all_modes(const SparseMatrix& M, const SparseMatrix& K);

/// Displacements, velocities and accelerations of a modal superposition: one row per coordinate,
/// one column per time.
struct ModalResponse {
  /// Displacements [SI], velocities [SI/s], accelerations after jumps of the load [SI/s^2].
  Eigen::MatrixXd q, v, a;
};

/// Superposes modal responses at ascending times [s]. `decay` contains damping ratio * omega of
/// each mode [1/s] (`decay_rates`). A mode is overdamped if its decay rate exceeds omega. q0 and v0
/// are the displacements and velocities at times.front(), which are projected on the modes; empty:
/// zero.
[[nodiscard]] ModalResponse superpose(const ModalBasis& basis, const Eigen::VectorXd& decay,
                                      const SparseMatrix& M, const PiecewiseLinearLoad& load,
                                      const std::vector<double>& times, const Eigen::VectorXd& q0,
                                      const Eigen::VectorXd& v0);

/// Solutions y of relaxation * y' + y = factor, one for each load. If relaxation > 0, y follows the
/// factor with a delay. If relaxation = 0, y equals the factor.
struct DelayedFactors {
  /// Values y [-] and time derivatives y' [1/s] and y'' [1/s^2]: one row per load, one column per
  /// time.
  Eigen::MatrixXd value, rate, acceleration;
};

/// Solves relaxation * y' + y = factor for each load at ascending times [s]. If relaxation > 0 [s],
/// `start` contains the values y at times.front(). If relaxation = 0, y equals the factor and, at a
/// jump, the factor after the jump.
[[nodiscard]] DelayedFactors delayed_factors(const PiecewiseLinearLoad& load, double relaxation,
                                             const Eigen::VectorXd& start,
                                             const std::vector<double>& times);

/// Adds the response x of massless coordinates, which no mode includes. It satisfies M x = 0 and
///
///   K (x + relaxation x') = part of the load that excites no mode.
///
/// `relaxation` is the coefficient of K in the damping matrix [s]. Without relaxation, massless
/// coordinates follow the load without delay. `basis` contains all modes. q0 contains the
/// displacements at times.front(); empty: zero.
void add_massless_response(const ModalBasis& basis, const SparseMatrix& M, const SparseMatrix& K,
                           double relaxation, const PiecewiseLinearLoad& load,
                           const std::vector<double>& times, const Eigen::VectorXd& q0,
                           ModalResponse& response, Counters& counters);

/// Impulse response h of y'' + 2 c y' + w^2 y = p and its integrals over a time t:
///
///   h'' + 2 c h' + w^2 h = 0, h(0) = 0, h'(0) = 1,  h1 = int h,  h2 = int h1.
///
/// A load p0 + p1 t per unit mass moves an oscillator with the initial state y0, v0 exactly by
///
///   y(t)  = y0 (1 - w^2 h1) + v0 h  + p0 h1 + p1 h2,
///
///   y'(t) = -y0 w^2 h       + v0 h' + p0 h  + p1 h1.
///
/// All c >= 0 and w >= 0 are supported: rigid motion, underdamping, critical damping and
/// overdamping. The formula for each of these four cases is free of cancellation.
struct ImpulseResponse {
  double dh = 1;  ///< time derivative h' of the impulse response h [-]
  /// Impulse response h [s].
  double h = 0;
  /// Integral h1 of h [s^2].
  double h1 = 0;
  /// Integral h2 of h1 [s^3].
  double h2 = 0;
};

/// Computes the impulse response of an oscillator at a time t >= 0 [s], with w = `omega` [rad/s]
/// and c = `decay` = damping ratio * w [1/s].
[[nodiscard]] ImpulseResponse impulse_response(double omega, double decay, double t);

/// Displacement and velocity of an oscillator with one degree of freedom.
struct OscillatorState {
  /// Displacement y [SI].
  double y = 0;
  /// Velocity y' [SI/s].
  double v = 0;
};

/// Returns the state of an oscillator after the time t for which `response` was computed. The load
/// per unit mass is p0 at the start and increases by p1 per second.
[[nodiscard]] OscillatorState advance(const ImpulseResponse& response, double omega,
                                      const OscillatorState& start, double p0, double p1);

/// Solves M a = f on the free coordinates for a mass matrix M that may be singular. A small
/// multiple of K is added to M. Iterative refinement removes the effect of K on coordinates with
/// mass. The acceleration of massless coordinates is the solution with the least strain energy.
class RegularizedMass {
 public:
  /// @pre `system` must outlive this object.
  explicit RegularizedMass(const System& system);
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& f) const;

 private:
  const System& system_;
  Factorization regular_;
};

/// Loads and accelerations that balance the elastic forces K q of a motion with
/// stiffness-proportional damping. The coefficient of K in the damping matrix is t [s]. Loads and
/// inertia forces balance K (q + t q'), so that q is delayed relative to the loads. For loads or
/// accelerations z(t), let x(z) be the solution of x + t x' = z. The balance is then
///
///   K q = x(loads) - M x(accelerations).
class LateStrain {
 public:
  /// @pre `system` must outlive this object.
  explicit LateStrain(const System& system);
  /// Writes the load factors and accelerations that balance K q into `elastic`. `factors` contains
  /// the delayed factors of the loads and of the weight (`delayed_factors`).
  void set_loads(const Eigen::VectorXd& q, const Eigen::Vector2d& factors,
                 ElasticState& elastic) const;

 private:
  const System& system_;
  RegularizedMass mass_;
  // Weight forces on the free coordinates.
  Eigen::VectorXd weight_;
};

}  // namespace trammel::solver
