#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>

#include "solver/large/constrained_system.h"
#include "solver/large/geometrically_exact_system.h"
#include "solver/motion/integrate.h"

namespace trammel::solver::large_motion {

/// Largest residuals of the rigid constraints of a state.
struct ConstraintGaps {
  double position = 0, rate = 0;  ///< [m or rad], [m/s or rad/s]
  /// Relative to the model size or 1 rad [-], [1/s].
  double relative_position = 0, relative_rate = 0;
};

/// Computes residuals of the state at the end of a step by a separate evaluation.
class MotionResiduals {
 public:
  /// @pre The system outlives this object.
  explicit MotionResiduals(const ConstrainedSystem& system);

  /// Returns the largest residual relative to |M| |a| + |K| |q| + |G^T| |lambda|, row by row.
  /// @param state  state at the end of a step.
  /// @param residual  residual of the equation of motion of the scheme.
  [[nodiscard]] double equation_of_motion(const State& state, const VectorXd& residual);
  [[nodiscard]] ConstraintGaps constraints(const State& state);

 private:
  void add_terms(const TangentCoefficients& coefficients, const State& state);

  const ConstrainedSystem& system_;
  VectorXd row_unit_;  ///< unit of each constraint [m or rad]
  KktMatrix matrix_;
  VectorXd unknowns_, terms_, magnitudes_, constraint_residual_, constraint_rate_;
};

/// Orientation of the assembly of a mechanism: the sign of det G, or of det (G, v) with one degree
/// of freedom. G is the gradient of the constraints, and v the velocity. The sign differs between
/// the branches that meet at a singular position. A step that is longer than the gap between two
/// branches may continue on the wrong branch, although its residuals are only round-off errors.
class AssemblyBranch {
 public:
  /// @pre The system outlives this object.
  explicit AssemblyBranch(const ConstrainedSystem& system);
  /// Returns true if the orientation at the end of a step is opposite to that at its start.
  [[nodiscard]] bool changes(const State& from, const State& to);

 private:
  /// Returns the sign, or 0 if it is undefined, as at a singular position or at rest.
  [[nodiscard]] double orientation(const State& state);

  const ConstrainedSystem& system_;
  Index freedom_ = 0;
  double last_time_ = -std::numeric_limits<double>::infinity();
  double last_sign_ = 0;             ///< at the end of the last step without a change
  std::optional<KktMatrix> matrix_;  ///< empty: the orientation is undefined
};

/// Receives a state to output.
using Observer = std::function<void(const State&)>;

class StepConvergence;

/// Generalized-alpha method (time_scheme.h) for constrained systems (M. Arnold, O. Bruls, MSD 18,
/// 2007). It is of second order in positions, velocities and multipliers:
///
///     q1 = q0 + h v0 + h^2 ((1/2 - beta) A0 + beta A1) + p,    M a1 + G^T lambda1 = f.
///
/// The index-3 equations are used in the stabilized form of Gear, Gupta and Leimkuhler. lambda of a
/// rigid row enforces G v + dg/dt = 0, and the small correction p enforces g = 0. Positions and
/// velocities therefore both satisfy the constraints. Round-off affects multipliers as eps/h
/// instead of eps/h^2. The equations are scaled by h^2, so that tiny steps cause no problems.
class ConstrainedStepper : public Stepper {
 public:
  /// Starts from a consistent state.
  /// @param system  equations.
  /// @param options  scheme, error control and sample times.
  /// @param start  consistent state.
  /// @param observe  receives the states to output.
  /// @pre All arguments except `start` outlive this object.
  ConstrainedStepper(const ConstrainedSystem& system, const TransientOptions& options,
                     const State& start, const Observer& observe);

  [[nodiscard]] StepReport attempt(const Step& step) override;
  void accept(const Step& step, bool inspect, Evidence& evidence) override;
  void restart() override { first_ = true; }
  void show() override {
    if (observe_) observe_(from_);
  }
  [[nodiscard]] std::string describe(const StepReport& report) const override;
  /// Returns the last accepted state.
  [[nodiscard]] const State& state() const { return from_; }
  [[nodiscard]] const KktMatrix& matrix() const { return matrix_; }
  /// Adds the energy balance of all steps, if the method has one.
  virtual void add_energy(Evidence& /*evidence*/) const {}

 protected:
  /// Relations of the scheme, and limits of its iteration relative to the scale [-].
  struct Scheme {
    TimeScheme relations;
    double error_constant = 0;
    bool keeps_rates = true;  ///< velocities satisfy the rigid constraints at the ends of steps
    double acceleration_share = 1;   ///< fraction of the accelerations that counts as motion
    double resolution = 0;           ///< limit of corrections relative to these accelerations
    double position_resolution = 0;  ///< limit of corrections relative to positions
  };
  ConstrainedStepper(const ConstrainedSystem& system, const TransientOptions& options,
                     const State& start, const Observer& observe, const Scheme& scheme);

  /// Exchanges the ends of the accepted step.
  virtual void advance();

  const ConstrainedSystem& system_;
  KktMatrix matrix_;
  State from_, to_;    ///< ends of the step
  bool first_ = true;  ///< true after the start or a breakpoint
  double last_step_ = 0;
  VectorXd constraint_residual_, constraint_rate_;

 private:
  /// Computes the residual r of the equation of motion in an attempted step.
  virtual void residual(Eigen::Ref<VectorXd> r) { system_.force_residual(to_, r); }
  /// Computes r of the last accepted step from its states only.
  virtual void accepted_residual(Eigen::Ref<VectorXd> r) const { system_.force_residual(from_, r); }
  /// Fills the tangent. @returns true if it is symmetric.
  virtual bool tangent(double h, bool exact);
  /// Returns -(g + tau dg/dt - c lambda) of an elastic row, over its derivative.
  [[nodiscard]] virtual double elastic_row(Index r, double h) const;
  virtual void begin_step() {}
  virtual void end_step(double /*h*/) {}

  [[nodiscard]] StepReport iterate(const Step& step);
  [[nodiscard]] StepReport newton(const Step& step, bool exact);
  void correct(double h);
  [[nodiscard]] bool has_converged(double h, const StepConvergence& convergence) const;
  [[nodiscard]] double correction_roundoff(double h) const;
  [[nodiscard]] double size(const Eigen::Ref<const VectorXd>& x) const {
    return weighted_rms_norm(system_, x);
  }
  /// Returns the change of a per unit change of q.
  [[nodiscard]] double per_acceleration(double h) const {
    return 1 / (scheme_.relations.position_gain() * h * h);
  }
  /// Returns the change of v per unit change of q.
  [[nodiscard]] double per_velocity(double h) const {
    return scheme_.relations.gamma / (scheme_.relations.beta * h);
  }

  const TransientOptions& options_;
  const Observer& observe_;
  Scheme scheme_;
  AssemblyBranch branch_;
  MotionResiduals residuals_;
  bool projects_;                       ///< positions and velocities have different corrections
  VectorXd A0_, A1_, saved_A0_, work_;  ///< A: accelerations of the scheme
  VectorXd velocity_correction_, position_correction_, force_residual_;
  double factored_step_ = 0, relation_residual_ = 0;
};

/// Creates a stepper of the energy-momentum method (J. C. Simo, N. Tarnow, ZAMP 43, 1992; O.
/// Gonzalez, CMAME 190, 2000):
///
///     q1 - q0 = h (v0 + v1)/2,     M (v1 - v0)/h = f(q0, q1) - D(q0, q1)^T lambda,     g(q1) = 0.
///
/// f and D are discrete gradients. The energy is therefore conserved up to round-off for any step,
/// without numerical damping. Momentum is conserved within O(h^2). The method has order 2.
/// Velocities satisfy the constraints in the mean over each step. Multipliers are means, which
/// alternate about those of the motion. `integrate` outputs multipliers that follow from positions
/// and velocities. With the mean acceleration a of the step, the relations are those of beta = 1/2
/// and gamma = 1.
[[nodiscard]] std::unique_ptr<ConstrainedStepper> make_energy_momentum(
    const GeometricallyExactSystem& system, const TransientOptions& options, const State& start,
    const Observer& observe);

}  // namespace trammel::solver::large_motion
