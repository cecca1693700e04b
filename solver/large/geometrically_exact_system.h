#pragma once

#include <Eigen/SparseCore>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "solver/large/constrained_system.h"
#include "solver/large/large_motion_model.h"
#include "solver/large/system_parts.h"
#include "solver/model/model.h"

namespace trammel::solver::large_motion {

/// Planar model in large motion, in absolute coordinates: Simo-Reissner beams, total-Lagrangian
/// triangles, rigid bodies and joints. An object must not be shared between threads.
class GeometricallyExactSystem final : public ConstrainedSystem {
 public:
  /// Builds the equations of motion of a model.
  /// @throws ModelError  if the model is invalid.
  explicit GeometricallyExactSystem(Model model, LargeMotionModel large_motion = {});

  [[nodiscard]] Index coordinate_count() const override { return layout_.free; }
  [[nodiscard]] Index constraint_count() const override { return parts_.rows; }
  [[nodiscard]] const VectorXd& row_compliance() const override { return rows_.compliance; }
  [[nodiscard]] const VectorXd& scale() const override { return scale_; }
  [[nodiscard]] VectorXd row_units() const override { return rows_.unit; }
  [[nodiscard]] std::vector<std::vector<Index>> coupled_unknowns() const override {
    return rows_.blocks;
  }
  void force_residual(const State& state, Eigen::Ref<VectorXd> r) const override;
  void constraint_residual(const State& state, Eigen::Ref<VectorXd> residual,
                           Eigen::Ref<VectorXd> rate) const override;
  void add_tangent(const State& state, const TangentCoefficients& coefficients,
                   KktMatrix& matrix) const override;
  [[nodiscard]] bool has_symmetric_tangent() const override;
  [[nodiscard]] double strain_rate_damping() const override {
    return large_motion_.strain_rate_damping;
  }
  [[nodiscard]] double load_factor(double t) const override;

  // Discrete gradients are mean forces of a time step. The work of these forces in the step equals
  // the change of the energy exactly.

  /// Computes the residual r = M (v1 - v0) / h - f + D^T lambda of a step of size h. The discrete
  /// gradient D of the constraints g satisfies D (q1 - q0) = g(q1) - g(q0) exactly.
  void discrete_gradient_residual(const State& from, const State& to, const VectorXd& lambda,
                                  Eigen::Ref<VectorXd> r) const;
  /// Adds the derivative of `discrete_gradient_residual` with respect to the state `to` to a
  /// matrix. The error of the derivative is proportional to the square of the step, because element
  /// matrices are evaluated at the state `midpoint`. The matrix is not symmetric.
  void discrete_gradient_tangent(const State& from, const State& to, const State& midpoint,
                                 const TangentCoefficients& coefficients, KktMatrix& matrix) const;
  [[nodiscard]] Energy energy(const State& state) const;
  /// Returns the work that changes the energy in a step [J]. The result is the work of drives,
  /// time-varying loads and follower loads, minus the energy dissipated by damping. `lambda`
  /// contains the mean multipliers of the step.
  [[nodiscard]] double nonconservative_work(const State& from, const State& to,
                                            const VectorXd& lambda) const;

  /// Sets accelerations of the free coordinates. In statics, their inertia forces act in addition
  /// to the loads.
  void set_accelerations(VectorXd accelerations) { accelerations_ = std::move(accelerations); }
  /// Sets reference velocities of the free coordinates as a function of time. Mass-proportional
  /// damping acts on the velocities relative to the reference velocities.
  void set_damping_reference_velocity(std::function<VectorXd(double)> velocities) {
    undamped_velocities_ = std::move(velocities);
  }
  /// Returns the velocities on which mass-proportional damping acts: the velocities of the state
  /// minus the reference velocities.
  [[nodiscard]] VectorXd damped_velocities(const State& state) const;

  /// Sets the factor on loads, gravity and inertia forces of a static state. Drives are evaluated
  /// at the time `load_factor`.
  void set_load_factor(State& state, double load_factor) const;
  /// Computes the derivative of the force residual with respect to the load factor of loads,
  /// gravity and inertia forces.
  void load_factor_derivative(const State& state, Eigen::Ref<VectorXd> r) const;

  /// Returns the state at time 0: the pose of the model at rest, without forces.
  [[nodiscard]] State reference_state() const;

  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] const LargeMotionModel& large_motion() const { return large_motion_; }
  [[nodiscard]] const Layout& layout() const { return layout_; }
  [[nodiscard]] const SystemParts& parts() const { return parts_; }
  /// Returns the index of the constraint row of a drive. The multiplier of the drive has the same
  /// index.
  [[nodiscard]] Index drive_row(Index drive) const {
    return parts_.group<DrivenCoordinate>().first_constraint_row(drive);
  }
  /// Returns the number of computed tangent matrices of member elements and triangles.
  [[nodiscard]] std::int64_t element_evaluations() const { return element_evaluations_; }
  [[nodiscard]] const Eigen::SparseMatrix<double>& mass() const { return mass_; }

 private:
  /// Counts the element evaluations of a tangent matrix.
  /// @return `coefficients`, in which the factor of the mass matrix includes mass-proportional
  ///   damping.
  TangentCoefficients prepare_tangent(TangentCoefficients coefficients) const;
  void add_torques(double factor, double t, Eigen::Ref<VectorXd> r) const;

  Model model_;
  LargeMotionModel large_motion_;
  Layout layout_;
  SystemParts parts_;
  SystemRows rows_;
  VectorXd scale_;
  Eigen::SparseMatrix<double> mass_;  ///< mass matrix of the free and the supported coordinates
  VectorXd gravity_;                  ///< weight: M times the gravity field, for all coordinates
  VectorXd accelerations_;            ///< accelerations for inertia forces in statics; empty: none
  std::function<VectorXd(double)> undamped_velocities_;
  mutable VectorXd padded_, product_;
  mutable std::int64_t element_evaluations_ = 0;
};

}  // namespace trammel::solver::large_motion
