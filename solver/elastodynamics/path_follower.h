#pragma once

#include <Eigen/Core>

#include "solver/elastodynamics/elastodynamics.h"
#include "solver/elastodynamics/moving_system.h"
#include "solver/linalg/sparse_ldlt.h"

namespace trammel::solver {

/// The manipulator on its way along the path: the rigid motion at a time, and the elastic system
/// about it.
class PathFollower {
 public:
  /// @param built_at  the time at whose pose the model is built and its coordinates are numbered
  /// [s]
  /// @pre `options` outlive the follower
  PathFollower(const ElastodynamicsOptions& options, double built_at);

  /// A time is evaluated once, and only one for a platform that stands still under a load that
  /// stays.
  /// @returns false: `outcome` names the time and the reason.
  bool update_to(double time);
  /// The same at any time under any gravity [m/s^2], each time anew.
  [[nodiscard]] Outcome move_to(double time, const Vector2d& gravity);

  [[nodiscard]] const MovingSystem& system() const { return moving_; }
  /// Forces and energies of an elastic motion at the present pose.
  [[nodiscard]] MovingSystem::Forces forces(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                            const Eigen::VectorXd& a) const {
    return moving_.forces(q, v, a, options_.damping, options_.nominal_inertia);
  }
  [[nodiscard]] const TrajectoryPoint& point() const { return point_; }
  [[nodiscard]] const Outcome& outcome() const { return outcome_; }
  [[nodiscard]] bool stands_still() const { return stands_still_; }
  [[nodiscard]] bool damped() const;

  // At the present pose, in free coordinates.

  /// F and, where it is on, f [N, N m].
  [[nodiscard]] Eigen::VectorXd load() const;
  /// M, C + G and K + S, with what damping takes of T. q; C stays as it is where nothing goes with
  /// velocities.
  void matrices(SparseMatrix& M, SparseMatrix& C, SparseMatrix& K);
  /// K q = f; false where K is singular.
  [[nodiscard]] bool solve_statically(const Eigen::VectorXd& f, Eigen::VectorXd& q);
  /// (f^T K^-1 f)^(1/2), twice the energy that the load f alone would store [J^(1/2)]; NaN where K
  /// is singular.
  [[nodiscard]] double energy_norm(const Eigen::VectorXd& f);
  /// Torques of rigid links under the same loads and, where it is on, the same inertia [N m].
  [[nodiscard]] Vector3d rigid_torque() const;

  /// Elements, what was solved with K, and the effects: what the parts have, once; what only the
  /// motion has, each time.
  [[nodiscard]] Counters counters() const;

 private:
  [[nodiscard]] Vector3d wrench(double time) const;

  const ElastodynamicsOptions& options_;
  bool stands_still_;
  RigidManipulator rigid_;
  MovingSystem moving_;
  SparseLdlt stiffness_{SparseLdlt::Triangle::mean};
  bool factored_ = false, regular_ = false;
  Counters counters_;
  Vector9d start_;
  double time_ = kNaN;
  TrajectoryPoint point_;
  InverseDynamics dynamics_;
  Outcome outcome_;
};

}  // namespace trammel::solver
