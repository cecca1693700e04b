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

/// A planar model in large motion: Simo-Reissner beams, total-Lagrangian triangles, rigid bodies
/// and joints, in absolute coordinates. One object serves one thread.
class GeometricallyExactSystem final : public ConstrainedSystem {
 public:
  /// @throws ModelError  where the model has no meaning.
  explicit GeometricallyExactSystem(Model model, LargeMotionModel large_motion = {});

  [[nodiscard]] Index coordinates() const override { return layout_.free; }
  [[nodiscard]] Index constraints() const override { return parts_.rows; }
  [[nodiscard]] const VectorXd& compliance() const override { return rows_.compliance; }
  [[nodiscard]] const VectorXd& scale() const override { return scale_; }
  [[nodiscard]] VectorXd row_unit() const override { return rows_.unit; }
  [[nodiscard]] std::vector<std::vector<Index>> blocks() const override { return rows_.blocks; }
  void force_residual(const State& state, Eigen::Ref<VectorXd> r) const override;
  void constraint_residual(const State& state, Eigen::Ref<VectorXd> residual,
                           Eigen::Ref<VectorXd> rate) const override;
  void tangent(const State& state, const TangentCoefficients& coefficients,
               KktMatrix& matrix) const override;
  [[nodiscard]] bool symmetric() const override;
  [[nodiscard]] double strain_rate_damping() const override {
    return large_motion_.strain_rate_damping;
  }
  [[nodiscard]] double load_factor(double t) const override;

  // Discrete gradients: forces between two states that do exactly the work by which the energy
  // changes.

  /// r = M (v1 - v0) / h - f + D^T lambda, with D (q1 - q0) = g(q1) - g(q0) exactly.
  void discrete_gradient_residual(const State& from, const State& to, const VectorXd& lambda,
                                  Eigen::Ref<VectorXd> r) const;
  /// Its derivative with respect to the second state, up to terms of the step's square: not
  /// symmetric.
  void discrete_gradient_tangent(const State& from, const State& to, const State& midpoint,
                                 const TangentCoefficients& coefficients, KktMatrix& matrix) const;
  [[nodiscard]] Energy energy(const State& state) const;
  /// Work that changes the energy in a step [J]: of drives, of loads that change or follow their
  /// nodes, less what damping takes.
  /// @param lambda  means of the step.
  [[nodiscard]] double nonconservative_work(const State& from, const State& to,
                                            const VectorXd& lambda) const;

  /// In statics the inertia of these accelerations of the free coordinates acts beside the loads.
  void set_accelerations(VectorXd accelerations) { accelerations_ = std::move(accelerations); }
  /// Damping by mass resists velocities less these of the free coordinates at a time.
  void set_undamped_velocities(std::function<VectorXd(double)> velocities) {
    undamped_velocities_ = std::move(velocities);
  }
  /// What damping by mass resists.
  [[nodiscard]] VectorXd damped_velocities(const State& state) const;

  /// Loads, gravity, inertia and drives of statics at a load factor.
  void set_load(State& state, double load) const;
  /// d(force residual)/d(load factor), gravity and inertia included.
  void load_derivative(const State& state, Eigen::Ref<VectorXd> r) const;

  /// The model's pose at rest without forces, at time 0.
  [[nodiscard]] State reference_state() const;

  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] const LargeMotionModel& large_motion() const { return large_motion_; }
  [[nodiscard]] const Layout& layout() const { return layout_; }
  [[nodiscard]] const SystemParts& parts() const { return parts_; }
  /// Row of a drive's multiplier.
  [[nodiscard]] Index drive_row(Index drive) const {
    return parts_.group<DrivenCoordinate>().first_row(drive);
  }
  /// Element tangents filled so far: of members and triangles.
  [[nodiscard]] std::int64_t element_evaluations() const { return element_evaluations_; }
  [[nodiscard]] const Eigen::SparseMatrix<double>& mass() const { return mass_; }

 private:
  /// Counts the elements of a tangent. @return the coefficients with damping by mass.
  TangentCoefficients begin_tangent(TangentCoefficients coefficients) const;
  void add_torques(double factor, double t, Eigen::Ref<VectorXd> r) const;

  Model model_;
  LargeMotionModel large_motion_;
  Layout layout_;
  SystemParts parts_;
  SystemRows rows_;
  VectorXd scale_;
  Eigen::SparseMatrix<double> mass_;  ///< total x total
  VectorXd gravity_;                  ///< M times the gravity field, total
  VectorXd accelerations_;            ///< of statics; empty: none
  std::function<VectorXd(double)> undamped_velocities_;
  mutable VectorXd padded_, product_;
  mutable std::int64_t element_evaluations_ = 0;
};

}  // namespace trammel::solver::large_motion
