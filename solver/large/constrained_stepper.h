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
  double position = 0, rate = 0;                    ///< [m or rad], [m/s or rad/s]
  double relative_position = 0, relative_rate = 0;  ///< over the model's size or 1 rad [-], [1/s]
};

/// Residuals of the state at the end of a step, evaluated again.
class MotionResiduals {
 public:
  /// @pre the system outlives this
  explicit MotionResiduals(const ConstrainedSystem& system);

  /// Row by row over |M| |a| + |K| |q| + |G^T| |lambda|.
  /// @param residual  of the scheme's equation of motion.
  [[nodiscard]] double equation_of_motion(const State& state, const VectorXd& residual);
  [[nodiscard]] ConstraintGaps constraints(const State& state);

 private:
  void add_terms(const TangentCoefficients& coefficients, const State& state);

  const ConstrainedSystem& system_;
  VectorXd row_unit_;  ///< of each constraint [m or rad]
  KktMatrix matrix_;
  VectorXd unknowns_, terms_, magnitudes_, constraint_residual_, constraint_rate_;
};

/// Orientation of a mechanism's assembly: the sign of det G, or of det (G, v) with one degree of
/// freedom. It differs between the branches that meet at a singular position, and a step that is
/// longer than the gap between two branches takes the wrong one, with residuals of round-off.
class AssemblyBranch {
 public:
  /// @pre the system outlives this
  explicit AssemblyBranch(const ConstrainedSystem& system);
  /// True if the orientation at the end of a step is the opposite of that at its start.
  [[nodiscard]] bool changes(const State& from, const State& to);

 private:
  /// 0 if it is not known, as at a singular position or at rest.
  [[nodiscard]] double orientation(const State& state);

  const ConstrainedSystem& system_;
  Index freedom_ = 0;
  double last_time_ = -std::numeric_limits<double>::infinity();
  double last_sign_ = 0;             ///< at the end of the last step that kept it
  std::optional<KktMatrix> matrix_;  ///< empty: the orientation is not known
};

using Observer = std::function<void(const State&)>;

class StepConvergence;

/// Generalized-alpha (time_scheme.h) for constrained systems (M. Arnold, O. Bruls, MSD 18, 2007),
/// of second order in positions, velocities and multipliers:
///
///     q1 = q0 + h v0 + h^2 ((1/2 - beta) A0 + beta A1) + p,    M a1 + G^T lambda1 = f.
///
/// The index-3 equations are taken in the stabilized form of Gear, Gupta and Leimkuhler: lambda of
/// a rigid row keeps G v + dg/dt = 0 and the small correction p keeps g = 0, so that positions and
/// velocities both stay on the constraints. Multipliers then feel round-off as eps/h, not eps/h^2,
/// and the equations are scaled by h^2, so tiny steps are harmless.
class ConstrainedStepper : public Stepper {
 public:
  /// @param start  consistent.   @pre all but it outlive this.
  ConstrainedStepper(const ConstrainedSystem& system, const TransientOptions& options,
                     const State& start, const Observer& observe);

  [[nodiscard]] StepReport attempt(const Step& step) override;
  void accept(const Step& step, bool inspect, Evidence& evidence) override;
  void restart() override { first_ = true; }
  void show() override {
    if (observe_) observe_(from_);
  }
  [[nodiscard]] std::string describe(const StepReport& report) const override;
  /// Accepted last.
  [[nodiscard]] const State& state() const { return from_; }
  [[nodiscard]] const KktMatrix& matrix() const { return matrix_; }
  /// Adds the balance of energy of all steps, if the method has one.
  virtual void add_energy(Evidence& /*evidence*/) const {}

 protected:
  /// Relations of the scheme, and limits of its iteration over the scale [-].
  struct Scheme {
    TimeScheme relations;
    double error_constant = 0;
    bool keeps_rates = true;         ///< velocities meet the rigid constraints at the ends of steps
    double acceleration_share = 1;   ///< of accelerations that count as motion
    double resolution = 0;           ///< smallest correction over these accelerations, ...
    double position_resolution = 0;  ///< ... and over positions
  };
  ConstrainedStepper(const ConstrainedSystem& system, const TransientOptions& options,
                     const State& start, const Observer& observe, const Scheme& scheme);

  /// Exchanges the ends of the accepted step.
  virtual void advance();

  const ConstrainedSystem& system_;
  KktMatrix matrix_;
  State from_, to_;    ///< the ends of the step
  bool first_ = true;  ///< after the start or a breakpoint
  double last_step_ = 0;
  VectorXd constraint_residual_, constraint_rate_;

 private:
  /// r of the equation of motion in a step that is attempted.
  virtual void residual(Eigen::Ref<VectorXd> r) { system_.force_residual(to_, r); }
  /// r of the step accepted last, from its states alone.
  virtual void accepted_residual(Eigen::Ref<VectorXd> r) const { system_.force_residual(from_, r); }
  /// Fills the tangent. @returns true if it is symmetric
  virtual bool tangent(double h, bool exact);
  /// -(g + tau dg/dt - c lambda) of an elastic row, over its derivative.
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
  /// Changes of a and of v by a unit change of q.
  [[nodiscard]] double per_acceleration(double h) const {
    return 1 / (scheme_.relations.position_gain() * h * h);
  }
  [[nodiscard]] double per_velocity(double h) const {
    return scheme_.relations.gamma / (scheme_.relations.beta * h);
  }

  const TransientOptions& options_;
  const Observer& observe_;
  Scheme scheme_;
  AssemblyBranch branch_;
  MotionResiduals residuals_;
  bool projects_;                       ///< positions and velocities have different corrections
  VectorXd A0_, A1_, saved_A0_, work_;  ///< A: the scheme's own accelerations
  VectorXd velocity_correction_, position_correction_, force_residual_;
  double factored_step_ = 0, relation_residual_ = 0;
};

/// Energy-momentum method (J. C. Simo, N. Tarnow, ZAMP 43, 1992; O. Gonzalez, CMAME 190, 2000):
///
///     q1 - q0 = h (v0 + v1)/2,     M (v1 - v0)/h = f(q0, q1) - D(q0, q1)^T lambda,     g(q1) = 0,
///
/// with discrete gradients f and D, so that the energy is kept to round-off for any step, without
/// numerical damping. Momentum is kept within O(h^2). Order 2. Velocities meet their constraint on
/// the mean of each step. Multipliers are means that alternate about those of the motion;
/// `integrate` shows those that follow from positions and velocities. With a the mean acceleration
/// of the step its relations are those of beta = 1/2 and gamma = 1.
[[nodiscard]] std::unique_ptr<ConstrainedStepper> make_energy_momentum(
    const GeometricallyExactSystem& system, const TransientOptions& options, const State& start,
    const Observer& observe);

}  // namespace trammel::solver::large_motion
