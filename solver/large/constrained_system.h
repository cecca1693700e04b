#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "solver/large/kkt_matrix.h"

/// Equations of statics and of all time integrators of geometrically exact models:
///
///     \f[ M(q) a = f(t, q, v) - G(t, q)^T \lambda, \quad g(t, q) + \tau \dot g = C \lambda, \f]
///
/// with constraint rows g, their gradient G, multipliers lambda and compliances C = diag(c). A row
/// with c = 0 is a rigid constraint (joint, drive, Euler-Bernoulli shear). A row with c > 0 is
/// elastic (stretch, a spring), and tau is the coefficient of its strain-rate damping.
namespace trammel::solver::large_motion {

/// State of a constrained system at one time: displacements, velocities, accelerations and
/// multipliers.
struct State {
  double t = 0;        ///< time [s]; the load factor in statics
  double load = 1;     ///< factor on the loads [-]
  double gravity = 1;  ///< factor on gravity [-]
  VectorXd q;          ///< displacements [m] and rotations [rad] relative to the pose of the model
  VectorXd v;          ///< velocities [m/s, rad/s]
  VectorXd a;          ///< accelerations [m/s^2, rad/s^2]
  VectorXd lambda;     ///< multipliers: forces [N] or moments [N m] of the constraints
};

/// Factors of the matrices in a tangent matrix S = mass M + damping D + stiffness K. M is the mass
/// matrix, D = -df/dv, and K = d(M a - f + G^T lambda)/dq. `compliance` is the factor of the
/// compliance matrix C.
struct TangentCoefficients {
  double mass = 0;
  double damping = 0;
  double stiffness = 1;
  double compliance = 1;
  bool has_penalty = true;  ///< false: omit the penalties of `KktMatrix`
};

/// Matrix sizes of an element with given numbers of coordinates and constraint rows.
template <int Coords, int Count>
struct ElementSizes {
  static constexpr int N = Coords, R = Count;
  using Coordinates = Eigen::Matrix<double, N, 1>;
  using Rows = Eigen::Matrix<double, R, 1>;
  using Gradient = Eigen::Matrix<double, R, N>;
  using Square = Eigen::Matrix<double, N, N>;
};

/// Interface of the equations of a mechanical system with constraints.
class ConstrainedSystem {
 public:
  ConstrainedSystem() = default;
  virtual ~ConstrainedSystem() = default;

  [[nodiscard]] virtual Index coordinate_count() const = 0;
  [[nodiscard]] virtual Index constraint_count() const = 0;
  /// Returns the compliance c >= 0 of each constraint row.
  [[nodiscard]] virtual const VectorXd& row_compliance() const = 0;
  /// Returns the reference value of each coordinate, by which its changes are divided: the model
  /// size [m] for translations, 1 rad for rotations.
  [[nodiscard]] virtual const VectorXd& scale() const = 0;
  /// Returns the reference value of each constraint row, by which its residual is divided: the
  /// model size [m] or 1 rad.
  [[nodiscard]] virtual VectorXd row_units() const;
  /// Returns, for each element, the indices of the unknowns that the element couples. These indices
  /// define the sparsity pattern of `KktMatrix`.
  [[nodiscard]] virtual std::vector<std::vector<Index>> coupled_unknowns() const = 0;

  /// Computes the residual of the equation of motion, r = M a - f + G^T lambda.
  virtual void force_residual(const State& state, Eigen::Ref<VectorXd> r) const = 0;
  /// Computes the residuals g of the constraints and their time derivatives dg/dt = G v + partial g
  /// / partial t.
  virtual void constraint_residual(const State& state, Eigen::Ref<VectorXd> residual,
                                   Eigen::Ref<VectorXd> rate) const = 0;
  /// Adds the tangent matrix of a state to `matrix`, which the caller has cleared.
  virtual void add_tangent(const State& state, const TangentCoefficients& coefficients,
                           KktMatrix& matrix) const = 0;
  /// Returns false if the tangent matrix is not symmetric, for example because of follower loads.
  [[nodiscard]] virtual bool has_symmetric_tangent() const { return true; }
  /// Returns the coefficient tau of strain-rate damping [s].
  [[nodiscard]] virtual double strain_rate_damping() const { return 0; }
  /// Returns the factor on the loads at a time.
  [[nodiscard]] virtual double load_factor(double) const { return 1; }

 protected:
  ConstrainedSystem(const ConstrainedSystem&) = default;
  ConstrainedSystem& operator=(const ConstrainedSystem&) = default;
  ConstrainedSystem(ConstrainedSystem&&) = default;
  ConstrainedSystem& operator=(ConstrainedSystem&&) = default;
};

/// Returns the model size [m], which scales translations.
[[nodiscard]] inline double length_scale(const ConstrainedSystem& system) {
  if (system.coordinate_count() == 0) return 1;
  const double least = system.scale().minCoeff();
  return least < 1 ? least : system.scale().maxCoeff();
}

inline VectorXd ConstrainedSystem::row_units() const {
  return VectorXd::Constant(constraint_count(), length_scale(*this));
}

/// Returns the root mean square of a change of the coordinates. Each change is divided by the
/// reference value of its coordinate (`scale`) [-].
[[nodiscard]] inline double weighted_rms_norm(const ConstrainedSystem& system,
                                              const Eigen::Ref<const VectorXd>& change) {
  if (change.size() == 0) return 0;
  return change.cwiseQuotient(system.scale()).norm() /
         std::sqrt(static_cast<double>(change.size()));
}

/// Energies of a geometrically exact model in one state.
struct Energy {
  double kinetic = 0;  ///< kinetic energy [J]
  double strain = 0;   ///< strain energy of members, plates and springs [J]
  double load = 0;  ///< potential of gravity and dead loads relative to the pose of the model [J]
  [[nodiscard]] double total() const { return kinetic + strain + load; }
};

}  // namespace trammel::solver::large_motion
