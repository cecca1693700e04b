#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>

#include "solver/large/constrained_system.h"
#include "solver/large/geometrically_exact_system.h"
#include "solver/motion/integrate.h"

namespace trammel::solver::large_motion {

/// Largest residuals of the rigid constraints in a state.
struct ConstraintGaps {
  /// Largest residual [m or rad] and largest rate of a residual [m/s or rad/s].
  double position = 0, rate = 0;
  /// Largest residual of all constraints [-], and largest time derivative of a residual [1/s].
  /// Residuals are relative to the model size for translations and to 1 rad for rotations.
  double relative_position = 0, relative_rate = 0;
};

/// Computes the residuals of the equation of motion and of the constraints at the end of a time
/// step, separately from the integrator.
class MotionResiduals {
 public:
  /// @pre The system outlives this object.
  explicit MotionResiduals(const ConstrainedSystem& system);

  /// Returns the largest residual of a row of the equation of motion. The residual is relative to
  /// the magnitudes of inertia, stiffness and constraint forces in this row, |M| |a| + |K| |q| +
  /// |G^T| |lambda|. `state` is the state at the end of a step, and `residual` is the residual of
  /// the equation of motion in the form of the time scheme.
  [[nodiscard]] double motion_residual(const State& state, const VectorXd& residual);
  [[nodiscard]] ConstraintGaps largest_gaps(const State& state);

 private:
  void add_term_magnitudes(const TangentCoefficients& coefficients, const State& state);

  const ConstrainedSystem& system_;
  VectorXd row_unit_;  ///< unit of each constraint [m or rad]
  KktMatrix matrix_;
  VectorXd unknowns_, terms_, magnitudes_, constraint_residual_, constraint_rate_;
};

/// Assembly branch of a mechanism, identified by the sign of det G. With one degree of freedom, the
/// sign of det (G, v) is used. G is the gradient of the constraints, and v the velocity. The signs
/// of two assembly branches that meet at a singular position are opposite. If the mechanism moves
/// farther in a time step than the distance between the branches, the step may end on the wrong
/// branch. The residuals do not show this error, because all constraints are satisfied.
class AssemblyBranch {
 public:
  /// @pre The system outlives this object.
  explicit AssemblyBranch(const ConstrainedSystem& system);
  /// Returns true if the sign that identifies the assembly branch differs between the start and the
  /// end of a step.
  [[nodiscard]] bool changes(const State& from, const State& to);

 private:
  /// Returns the sign that identifies the assembly branch: the sign of det G, or of det (G, v) with
  /// one degree of freedom. Returns 0 if the sign is undefined, as at a singular position or at
  /// rest.
  [[nodiscard]] double branch_sign(const State& state);

  const ConstrainedSystem& system_;
  Index freedom_ = 0;
  double last_time_ = -std::numeric_limits<double>::infinity();
  /// Value of `branch_sign` after the last step without a branch change.
  double last_sign_ = 0;
  std::optional<KktMatrix> matrix_;  ///< matrix for `branch_sign`; empty: not checked
};

/// Function that receives each output state of a motion.
using Observer = std::function<void(const State&)>;

class StepConvergence;

/// Generalized-alpha method (time_scheme.h) for constrained systems (M. Arnold, O. Bruls, MSD 18,
/// 2007). The method is of second order in positions, velocities and multipliers. In a step of size
/// h with the algorithmic accelerations A:
///
///     q1 = q0 + h v0 + h^2 ((1/2 - beta) A0 + beta A1) + p,    M a1 + G^T lambda1 = f.
///
/// The index-3 equations are used in the stabilized form of Gear, Gupta and Leimkuhler. The
/// multiplier lambda of a rigid constraint enforces G v + dg/dt = 0, and the small position
/// correction p enforces g = 0. Positions and velocities therefore both satisfy the constraints.
/// The round-off error of multipliers is proportional to eps/h instead of eps/h^2. The equations
/// are scaled by h^2, so that tiny steps cause no problems.
class ConstrainedStepper : public Stepper {
 public:
  /// Creates a stepper that starts from the consistent state `start`. `observe` receives the output
  /// states.
  /// @pre All arguments except `start` outlive this object.
  ConstrainedStepper(const ConstrainedSystem& system, const TransientOptions& options,
                     const State& start, const Observer& observe);

  [[nodiscard]] StepReport attempt(const Step& step) override;
  void accept(const Step& step, bool check_motion, Evidence& evidence) override;
  void restart() override { first_ = true; }
  void output_state() override {
    if (observe_) observe_(from_);
  }
  [[nodiscard]] std::string describe(const StepReport& report) const override;
  /// Returns the state at the end of the last accepted step.
  [[nodiscard]] const State& state() const { return from_; }
  [[nodiscard]] const KktMatrix& matrix() const { return matrix_; }
  /// Adds the residual of the energy balance of all steps, if the method conserves energy.
  virtual void add_energy_residual(Evidence& /*evidence*/) const {}

 protected:
  /// Parameters of the time scheme, and limits at which its Newton iteration ends [-].
  struct Scheme {
    TimeScheme relations;
    double error_constant = 0;
    bool keeps_rates = true;  ///< true: velocities satisfy rigid constraints at step ends
    /// Factor of the accelerations to which `resolution` is relative.
    double acceleration_share = 1;
    double resolution = 0;           ///< limit of Newton corrections relative to accelerations
    double position_resolution = 0;  ///< limit of Newton corrections relative to positions
  };
  ConstrainedStepper(const ConstrainedSystem& system, const TransientOptions& options,
                     const State& start, const Observer& observe, const Scheme& scheme);

  /// Makes the end state of an accepted time step the start state of the next step.
  virtual void advance();

  const ConstrainedSystem& system_;
  KktMatrix matrix_;
  State from_, to_;    ///< states at the start and the end of the step
  bool first_ = true;  ///< true in the first step after the start or a breakpoint
  double last_step_ = 0;
  VectorXd constraint_residual_, constraint_rate_;

 private:
  /// Computes the residual r of the equation of motion in an attempted step.
  virtual void compute_residual(Eigen::Ref<VectorXd> r) { system_.force_residual(to_, r); }
  /// Computes the residual r of the equation of motion in the last accepted step from its states.
  virtual void accepted_residual(Eigen::Ref<VectorXd> r) const { system_.force_residual(from_, r); }
  /// Assembles the tangent matrix of a step of size h. @returns true if the matrix is symmetric.
  virtual bool assemble_tangent(double h, bool exact);
  /// Returns the residual of the elastic constraint row r with compliance c and damping tau: -(g +
  /// tau dg/dt - c lambda), divided by d(g + tau dg/dt)/dg.
  [[nodiscard]] virtual double elastic_residual(Index r, double h) const;
  virtual void begin_step() {}
  virtual void end_step(double /*h*/) {}

  [[nodiscard]] StepReport iterate(const Step& step);
  [[nodiscard]] StepReport newton(const Step& step, bool exact);
  void correct(double h);
  [[nodiscard]] bool has_converged(double h, const StepConvergence& convergence) const;
  [[nodiscard]] double correction_roundoff(double h) const;
  [[nodiscard]] double scaled_norm(const Eigen::Ref<const VectorXd>& x) const {
    return weighted_rms_norm(system_, x);
  }
  /// Returns the change of the acceleration a per unit change of the position q in a step.
  [[nodiscard]] double acceleration_slope(double h) const {
    return 1 / (scheme_.relations.position_gain() * h * h);
  }
  /// Returns the change of the velocity v per unit change of the position q in a step.
  [[nodiscard]] double velocity_slope(double h) const {
    return scheme_.relations.gamma / (scheme_.relations.beta * h);
  }

  const TransientOptions& options_;
  const Observer& observe_;
  Scheme scheme_;
  AssemblyBranch branch_;
  MotionResiduals residuals_;
  bool projects_;                       ///< true: positions and velocities are corrected separately
  VectorXd A0_, A1_, saved_A0_, work_;  ///< A0_, A1_: algorithmic accelerations
  VectorXd velocity_correction_, position_correction_, force_residual_;
  double factored_step_ = 0, relation_residual_ = 0;
};

/// Creates a stepper of the energy-momentum method (J. C. Simo, N. Tarnow, ZAMP 43, 1992; O.
/// Gonzalez, CMAME 190, 2000), with a time step h from state 0 to state 1:
///
///     q1 - q0 = h (v0 + v1)/2,     M (v1 - v0)/h = f(q0, q1) - D(q0, q1)^T lambda,     g(q1) = 0.
///
/// The forces f and the gradient D of the constraints g are discrete gradients. The energy is
/// therefore conserved up to round-off for any step, without numerical damping. Momentum is
/// conserved within O(h^2). The method has order 2. Velocities satisfy the constraints in the mean
/// over each step. The multipliers lambda are mean values of a step, which oscillate about the
/// exact multipliers. `integrate` therefore outputs multipliers that follow from positions and
/// velocities. If a is the mean acceleration of the step, the method has the relations of Newmark's
/// method with beta = 1/2 and gamma = 1.
[[nodiscard]] std::unique_ptr<ConstrainedStepper> make_energy_momentum(
    const GeometricallyExactSystem& system, const TransientOptions& options, const State& start,
    const Observer& observe);

}  // namespace trammel::solver::large_motion
