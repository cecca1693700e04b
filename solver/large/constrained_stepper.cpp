#include "solver/large/constrained_stepper.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "solver/linalg/dense_eigen.h"
#include "solver/linalg/eigenpairs.h"
#include "solver/model/numbers.h"

namespace trammel::solver::large_motion {

MotionResiduals::MotionResiduals(const ConstrainedSystem& system)
    : system_(system),
      row_unit_(system.row_units()),
      matrix_(system.coordinate_count(), system.constraint_count(), system.coupled_unknowns()),
      unknowns_(VectorXd::Zero(system.coordinate_count() + system.constraint_count())),
      terms_(unknowns_),
      magnitudes_(unknowns_),
      constraint_residual_(VectorXd::Zero(system.constraint_count())),
      constraint_rate_(constraint_residual_) {}

void MotionResiduals::add_term_magnitudes(const TangentCoefficients& coefficients,
                                          const State& state) {
  matrix_.clear();
  system_.add_tangent(state, coefficients, matrix_);
  matrix_.term_magnitudes(unknowns_, magnitudes_);
  terms_ += magnitudes_;
}

double MotionResiduals::motion_residual(const State& state, const VectorXd& residual) {
  const Index n = system_.coordinate_count();
  terms_.setZero();
  unknowns_.head(n) = state.a;
  unknowns_.tail(state.lambda.size()).setZero();
  // Use a negligible stiffness instead of zero. Otherwise, residuals of massless coordinates would
  // be divided by zero.
  add_term_magnitudes({.mass = 1, .damping = 0, .stiffness = 1e-30, .compliance = 1}, state);
  unknowns_ << state.q, state.lambda;
  add_term_magnitudes({}, state);
  const auto scale = system_.scale().array();
  const double least = n > 0 ? kLeastFraction * (terms_.head(n).array() * scale).maxCoeff() : 0;
  terms_.head(n) = terms_.head(n).array().max(least / scale);
  return row_backward_error(residual, terms_.head(n));
}

ConstraintGaps MotionResiduals::largest_gaps(const State& state) {
  system_.constraint_residual(state, constraint_residual_, constraint_rate_);
  ConstraintGaps gaps;
  for (Index r = 0; r < constraint_residual_.size(); ++r) {
    if (system_.row_compliance()[r] > 0) continue;
    const double position = std::abs(constraint_residual_[r]), rate = std::abs(constraint_rate_[r]);
    gaps.position = nan_max(gaps.position, position);
    gaps.rate = nan_max(gaps.rate, rate);
    gaps.relative_position = nan_max(gaps.relative_position, position / row_unit_[r]);
    gaps.relative_rate = nan_max(gaps.relative_rate, rate / row_unit_[r]);
  }
  return gaps;
}

AssemblyBranch::AssemblyBranch(const ConstrainedSystem& system) : system_(system) {
  constexpr Index kLargest = 64;  // largest size of a matrix whose determinant is computed
  const Index n = system.coordinate_count();
  const Index rigid = (system.row_compliance().array() == 0).count();
  freedom_ = n - rigid;
  const bool is_mechanism = rigid == system.constraint_count() && (freedom_ == 0 || freedom_ == 1);
  if (n > 0 && n <= kLargest && is_mechanism) matrix_.emplace(n, rigid, system.coupled_unknowns());
}

bool AssemblyBranch::changes(const State& from, const State& to) {
  if (!matrix_) return false;
  if (last_time_ != from.t) last_sign_ = branch_sign(from);
  last_time_ = from.t;
  const double sign = branch_sign(to);
  const VectorXd weight = system_.scale().cwiseAbs2().cwiseInverse();
  const bool reverses = freedom_ == 1 && from.v.cwiseProduct(weight).dot(to.v) < 0;
  if (last_sign_ * sign * (reverses ? -1 : 1) < 0) return true;
  last_time_ = to.t;
  last_sign_ = sign;
  return false;
}

double AssemblyBranch::branch_sign(const State& state) {
  const Index n = system_.coordinate_count();
  TangentCoefficients coefficients;
  coefficients.has_penalty = false;
  matrix_->clear();
  system_.add_tangent(state, coefficients, *matrix_);
  Eigen::MatrixXd G(n, n);
  G.topRows(n - freedom_) = matrix_->constraint_gradient(system_.scale(), system_.row_units());
  if (freedom_ == 1) {
    const VectorXd rate = state.v.cwiseQuotient(system_.scale());
    const double speed = rate.norm();
    // If a drive moves the mechanism, the velocity v is not a null vector of the constraint
    // gradient G. The sign of det (G, v) then does not identify the assembly branch.
    if (speed == 0 || (G.topRows(n - 1) * rate).norm() > 1e-6 * speed) return 0;
    G.bottomRows<1>() = rate.normalized().transpose();
  }
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(G);
  return lu.matrixLU().diagonal().array().sign().prod() *
         static_cast<double>(lu.permutationP().determinant());
}

/// Convergence test of the Newton iteration in a time step. The test uses the corrections of the
/// motion and the projections of the positions onto the constraints.
class StepConvergence {
 public:
  void record(double step_correction, double projection) {
    previous_step_correction_ = step_correction_;
    previous_projection_ = projection_;
    step_correction_ = step_correction;
    projection_ = projection;
    ++count_;
  }
  /// Returns true if, according to the rate of convergence, the next corrections would be below
  /// their limits. The result is also true if the corrections stagnate at the level of round-off
  /// errors. All arguments are norms relative to the scale of the coordinates.
  /// @param acceleration  norm of h^2 beta a, the contribution of the accelerations to the step.
  /// @param velocity  norm of h v, the contribution of the velocities to the step.
  /// @param position  norm of the coordinates q.
  /// @param limit  limit of the norm of the next correction of the motion.
  [[nodiscard]] bool converged(double acceleration, double velocity, double position,
                               double limit) const {
    const double next = next_of(step_correction_, previous_step_correction_);
    // Norm at which the corrections stagnate because of round-off. The norm includes a multiple of
    // the round-off error of the positions, because corrections amplify this error near a singular
    // position.
    const double least = 1e-11 * (velocity + acceleration) + 1e-13 * position;
    const bool motion_met = next <= limit || step_correction_ <= 1e-16 * velocity ||
                            (stalled() && step_correction_ <= least);
    const double next_projection = next_of(projection_, previous_projection_);
    const bool constraints_met =
        next_projection <= 1e-15 * position || next_projection <= 1e-13 * velocity ||
        (count_ > 2 && projection_ > 0.3 * previous_projection_ && projection_ < 1e-12);
    return motion_met && constraints_met;
  }
  [[nodiscard]] bool stalled() const {
    return count_ > 2 && step_correction_ > 0.3 * previous_step_correction_;
  }
  [[nodiscard]] bool slow() const { return count_ > 1 && last() > 0.1 * previous(); }
  [[nodiscard]] bool diverging() const { return count_ > 4 && last() > 2 * previous(); }
  [[nodiscard]] double last() const { return step_correction_ + projection_; }

 private:
  /// Predicts the norm of the next correction from the ratio of the last two corrections. If there
  /// is only one correction, or the corrections do not decrease, the last correction is returned.
  [[nodiscard]] double next_of(double correction, double previous) const {
    return count_ > 1 && correction < previous ? correction * (correction / previous) : correction;
  }
  [[nodiscard]] double previous() const { return previous_step_correction_ + previous_projection_; }

  double step_correction_ = 0, projection_ = 0;
  double previous_step_correction_ = 0, previous_projection_ = 0;
  int count_ = 0;
};

ConstrainedStepper::ConstrainedStepper(const ConstrainedSystem& system,
                                       const TransientOptions& options, const State& start,
                                       const Observer& observe)
    : ConstrainedStepper(system, options, start, observe,
                         {.relations = options.scheme,
                          .error_constant = options.scheme.error_constant(),
                          .keeps_rates = true,
                          .acceleration_share = 1,
                          .resolution = 1e-13,
                          .position_resolution = 0}) {}

ConstrainedStepper::ConstrainedStepper(const ConstrainedSystem& system,
                                       const TransientOptions& options, const State& start,
                                       const Observer& observe, const Scheme& scheme)
    : system_(system),
      matrix_(system.coordinate_count(), system.constraint_count(), system.coupled_unknowns()),
      from_(start),
      to_(start),
      constraint_residual_(VectorXd::Zero(system.constraint_count())),
      constraint_rate_(constraint_residual_),
      options_(options),
      observe_(observe),
      scheme_(scheme),
      branch_(system),
      residuals_(system),
      projects_(scheme.keeps_rates && (system.row_compliance().array() == 0).any()),
      A0_(start.a),
      A1_(start.a),
      velocity_correction_(VectorXd::Zero(system.coordinate_count() + system.constraint_count())),
      position_correction_(velocity_correction_),
      force_residual_(VectorXd::Zero(system.coordinate_count())) {}

StepReport ConstrainedStepper::attempt(const Step& step) {
  const double h = step.size;
  const TimeScheme& s = scheme_.relations;
  const double shift = s.alpha_m - s.alpha_f;
  saved_A0_ = A0_;
  if (first_) {
    A0_ = from_.a;
    if (shift != 0) {
      const StepReport trial = iterate(step);
      if (trial.status != Status::solved) return trial;
      A0_ = from_.a + shift * (to_.a - from_.a);
    }
  } else if (h != last_step_) {
    rescale_to_new_step(h / last_step_, from_.a, A0_);
  }
  StepReport report = iterate(step);
  if (report.status == Status::solved) {
    const auto norm = [this](const VectorXd& x) { return scaled_norm(x); };
    relation_residual_ = relation_residual(s, h, from_, A0_, to_, A1_, !projects_, norm, work_);
    // If a system remains at rest under changing forces, its motion consists of the round-off
    // errors of these forces. Compute the residual of the update formulas of the time scheme again,
    // relative to terms that include these round-off errors.
    if (relation_residual_ > 1e-6)
      relation_residual_ = relation_residual(s, h, from_, A0_, to_, A1_, !projects_, norm, work_,
                                             acceleration_slope(h) * correction_roundoff(h));
    work_ = A1_ - A0_;
    if (options_.adaptive)
      report.error =
          scheme_.error_constant * h * h * scaled_norm(work_) / options_.adaptive->relative;
    // A motion through a singular position changes the assembly branch (see `AssemblyBranch`) for
    // steps of any size. A change of the branch is therefore accepted in steps of at most this
    // fraction of the nominal step.
    constexpr double kShortest = 1e-3;
    report.leaves_branch = h > kShortest * options_.step && branch_.changes(from_, to_);
    end_step(h);
  }
  // Restore the algorithmic accelerations A0. Otherwise, A0 would be scaled twice if the step is
  // rejected and repeated. After an accepted step, A0 is not needed.
  A0_ = saved_A0_;
  return report;
}

void ConstrainedStepper::accept(const Step& step, bool check_motion, Evidence& evidence) {
  advance();
  last_step_ = from_.t - to_.t;
  first_ = false;
  const ConstraintGaps gaps = residuals_.largest_gaps(from_);
  evidence.add(Residual::constraints, gaps.relative_position);
  if (scheme_.keeps_rates) evidence.add(Residual::constraints, step.size * gaps.relative_rate);
  if (check_motion) {
    accepted_residual(force_residual_);
    evidence.add(Residual::equation_of_motion, relation_residual_);
    evidence.add(Residual::equation_of_motion, residuals_.motion_residual(from_, force_residual_));
  }
  if (options_.sample_times.empty()) output_state();
}

void ConstrainedStepper::advance() {
  std::swap(from_, to_);
  std::swap(A0_, A1_);
}

std::string ConstrainedStepper::describe(const StepReport& report) const {
  if (report.iterations == 0) return "no correction was computed: the tangent matrix is singular";
  std::ostringstream text;
  text << "the last correction was " << report.residual << " times the model size after "
       << report.iterations << " iterations";
  return text.str();
}

/// Solves a step by Newton's method with the factored tangent of an earlier step. If the iteration
/// does not converge, the iteration is repeated with exact tangents.
StepReport ConstrainedStepper::iterate(const Step& step) {
  StepReport report = newton(step, false);
  if (report.status == Status::solved) return report;
  const int spent = report.iterations;
  report = newton(step, true);
  report.iterations += spent;
  if (report.status != Status::solved || !scheme_.keeps_rates) factored_step_ = 0;
  return report;
}

StepReport ConstrainedStepper::newton(const Step& step, bool exact) {
  // The energy-momentum method may use more iterations than the generalized-alpha method. The
  // energy-momentum method conserves energy only if the iteration converges fully, which may be
  // slow.
  const int max_iterations = scheme_.keeps_rates ? 20 : 30;
  const Index n = system_.coordinate_count();
  const double h = step.size;
  StepReport report;
  to_.t = step.end;
  to_.load = system_.load_factor(to_.t);
  to_.gravity = from_.gravity;
  to_.a = from_.a;
  to_.lambda = from_.lambda;
  begin_step();
  predict(scheme_.relations, h, from_, A0_, to_, A1_);
  StepConvergence convergence;
  bool fresh = false;
  for (int i = 0; i < max_iterations; ++i) {
    if (exact || factored_step_ != h || (!fresh && convergence.slow())) {
      matrix_.clear();
      factored_step_ = h;
      fresh = true;
      if (!matrix_.factor(assemble_tangent(h, exact))) return report;
    }
    correct(h);
    if (!velocity_correction_.allFinite() || !position_correction_.allFinite()) return report;
    report.iterations = i + 1;
    convergence.record(scaled_norm(velocity_correction_.head(n)),
                       scaled_norm(position_correction_.head(n) - velocity_correction_.head(n)));
    report.residual = convergence.last();
    if (has_converged(h, convergence)) {
      report.status = Status::solved;
      // Many iterations indicate an outdated factorization. The next step computes a new
      // factorization.
      if (i > 3) factored_step_ = 0;
      return report;
    }
    if (convergence.diverging()) return report;
  }
  return report;
}

bool ConstrainedStepper::assemble_tangent(double h, bool /*exact*/) {
  TangentCoefficients coefficients;
  coefficients.mass = 1;
  coefficients.damping = scheme_.relations.velocity_gain() * h;
  coefficients.stiffness = scheme_.relations.position_gain() * h * h;
  coefficients.compliance =
      acceleration_slope(h) / (1 + system_.strain_rate_damping() * velocity_slope(h));
  system_.add_tangent(to_, coefficients, matrix_);
  return system_.has_symmetric_tangent();
}

double ConstrainedStepper::elastic_residual(Index r, double h) const {
  const double tau = system_.strain_rate_damping();
  const double sum = constraint_residual_[r] + tau * constraint_rate_[r];
  return -(sum - system_.row_compliance()[r] * to_.lambda[r]) / (1 + tau * velocity_slope(h));
}

/// Computes one Newton correction of a step. Positions are corrected first, with the residuals of
/// the constraints. Then the accelerations are corrected, with the rates of the constraints at the
/// new positions. Both corrections use the same matrix. The second correction uses the result of
/// the first correction, so that both decrease quadratically, even near a singular position. The
/// difference between the two corrections is the position correction p (see `ConstrainedStepper`).
void ConstrainedStepper::correct(double h) {
  const Index n = system_.coordinate_count(), m = system_.constraint_count();
  compute_residual(velocity_correction_.head(n));
  velocity_correction_.head(n) /= -acceleration_slope(h);
  system_.constraint_residual(to_, constraint_residual_, constraint_rate_);
  for (Index r = 0; r < m; ++r)
    velocity_correction_[n + r] =
        system_.row_compliance()[r] > 0 ? elastic_residual(r, h) : -constraint_residual_[r];
  position_correction_ = velocity_correction_;
  matrix_.solve(position_correction_);
  to_.q += position_correction_.head(n);
  if (projects_) {
    system_.constraint_residual(to_, constraint_residual_, constraint_rate_);
    for (Index r = 0; r < m; ++r) {
      if (system_.row_compliance()[r] == 0)
        velocity_correction_[n + r] = -constraint_rate_[r] / velocity_slope(h);
    }
    matrix_.solve(velocity_correction_);
  } else {
    velocity_correction_ = position_correction_;
  }
  solver::correct(scheme_.relations, h, acceleration_slope(h) * velocity_correction_.head(n), to_,
                  A1_);
  to_.lambda += acceleration_slope(h) * velocity_correction_.tail(m);
}

bool ConstrainedStepper::has_converged(double h, const StepConvergence& convergence) const {
  // Limit of the last correction of a stalled iteration, as a multiple of `correction_roundoff`.
  // The multiple exceeds 1, because `correction_roundoff` includes only one rounding error of each
  // force.
  constexpr double kRoundoffErrors = 10;
  const double acceleration =
      scheme_.acceleration_share * scheme_.relations.beta * h * h * scaled_norm(A1_);
  const double position = scaled_norm(to_.q);
  const double limit =
      std::max(scheme_.resolution * acceleration, scheme_.position_resolution * position);
  return convergence.converged(acceleration, h * scaled_norm(to_.v), position, limit) ||
         (scheme_.keeps_rates && convergence.stalled() &&
          convergence.last() <= kRoundoffErrors * correction_roundoff(h));
}

/// Estimates the Newton correction that round-off errors of constraint forces and residuals cause,
/// by random values of these errors. This correction limits the accuracy of motions near a singular
/// position, and of small motions under large forces in mutual equilibrium.
double ConstrainedStepper::correction_roundoff(double h) const {
  const Index n = system_.coordinate_count(), m = system_.constraint_count();
  VectorXd multipliers = VectorXd::Zero(n + m), errors(n + m);
  multipliers.tail(m) = to_.lambda / acceleration_slope(h);
  matrix_.term_magnitudes(multipliers, errors);
  errors.tail(m) =
      (system_.row_compliance().array() == 0).select(scaled_norm(to_.q) * system_.row_units(), 0);
  errors = kEps * errors.cwiseProduct(start_vectors(n + m, 1));
  matrix_.solve(errors);
  return scaled_norm(errors.head(n));
}

namespace {

/// Stepper of the energy-momentum method. During an attempted step, `to_.lambda` is the mean of the
/// multipliers over the step.
class EnergyMomentum final : public ConstrainedStepper {
 public:
  EnergyMomentum(const GeometricallyExactSystem& system, const TransientOptions& options,
                 const State& start, const Observer& observe)
      // The remaining residual of Newton's method changes the energy. The iteration therefore
      // continues to a tenth of the round-off error of the positions.
      : ConstrainedStepper(system, options, start, observe,
                           {.relations = {.beta = 0.5, .gamma = 1},
                            .error_constant = 1.0 / 12,
                            .keeps_rates = false,
                            .acceleration_share = 2e-4,
                            .resolution = 1e-11,
                            .position_resolution = 1e-17}),
        system_(system),
        row_unit_(system.row_units()),
        midpoint_(start),
        mean_lambda_(start.lambda),
        previous_mean_lambda_(start.lambda),
        previous_constraint_residual_(constraint_residual_),
        energy_(system.energy(start)) {}

  void restart() override {}
  void add_energy_residual(Evidence& evidence) const override {
    const double size = largest_energy_ + throughput_;
    evidence.add(Residual::energy, size > 0 ? largest_gap_ / size : 0);
  }

 private:
  void begin_step() override {
    system_.constraint_residual(from_, previous_constraint_residual_, constraint_rate_);
    to_.lambda = previous_mean_lambda_;
  }
  void compute_residual(Eigen::Ref<VectorXd> r) override {
    system_.discrete_gradient_residual(from_, to_, to_.lambda, r);
  }
  void accepted_residual(Eigen::Ref<VectorXd> r) const override {
    system_.discrete_gradient_residual(to_, from_, previous_mean_lambda_, r);
  }
  bool assemble_tangent(double h, bool exact) override;
  [[nodiscard]] double elastic_residual(Index r, double h) const override;
  void end_step(double h) override;
  void advance() override;

  const GeometricallyExactSystem& system_;
  VectorXd row_unit_;
  State midpoint_;
  VectorXd mean_lambda_, previous_mean_lambda_;
  VectorXd previous_constraint_residual_;
  Energy energy_;
  /// Sum of the energy errors of all steps, largest magnitude of this sum, largest energy, and sum
  /// of the magnitudes of the work [J].
  double gap_ = 0, largest_gap_ = 0, largest_energy_ = 0, throughput_ = 0;
};

bool EnergyMomentum::assemble_tangent(double h, bool exact) {
  midpoint_.t = (from_.t + to_.t) / 2;
  midpoint_.load = (from_.load + to_.load) / 2;
  midpoint_.gravity = to_.gravity;
  midpoint_.q = (from_.q + to_.q) / 2;
  midpoint_.lambda = to_.lambda;
  TangentCoefficients coefficients;
  coefficients.mass = 1;
  coefficients.damping = h / 2;
  coefficients.stiffness = h * h / 4;
  coefficients.compliance = 2 / (h * h) / (0.5 + system_.strain_rate_damping() / h);
  if (exact) {  // the exact tangent is required near singular positions
    system_.discrete_gradient_tangent(from_, to_, midpoint_, coefficients, matrix_);
    return false;
  }
  system_.add_tangent(midpoint_, coefficients, matrix_);
  return system_.has_symmetric_tangent();
}

double EnergyMomentum::elastic_residual(Index r, double h) const {
  const double g0 = previous_constraint_residual_[r], g1 = constraint_residual_[r];
  const double rate = system_.strain_rate_damping() / h;
  const double sum = (g0 + g1) / 2 + rate * (g1 - g0);
  return -(sum - system_.row_compliance()[r] * to_.lambda[r]) / (0.5 + rate);
}

/// Computes the multipliers at the end of the step. Multipliers of elastic constraint rows follow
/// from the strain. Multipliers of rigid rows are extrapolated from the mean multipliers of the
/// last two steps.
void EnergyMomentum::end_step(double h) {
  const double tau = system_.strain_rate_damping();
  const double extrapolation = first_ ? 1.0 : h / (h + last_step_);
  mean_lambda_ = to_.lambda;
  system_.constraint_residual(to_, constraint_residual_, constraint_rate_);
  to_.lambda = mean_lambda_ + extrapolation * (mean_lambda_ - previous_mean_lambda_);
  for (Index r = 0; r < system_.constraint_count(); ++r) {
    const double c = system_.row_compliance()[r];
    if (c > 0) to_.lambda[r] = (constraint_residual_[r] + tau * constraint_rate_[r]) / c;
  }
}

/// Advances the state, and adds the energy error of the step to `gap_`: the change of energy minus
/// the work.
void EnergyMomentum::advance() {
  ConstrainedStepper::advance();
  std::swap(previous_mean_lambda_, mean_lambda_);
  const Energy before = energy_;
  energy_ = system_.energy(from_);
  const double work = system_.nonconservative_work(to_, from_, previous_mean_lambda_);
  gap_ += energy_.total() - before.total() - work;
  throughput_ += std::abs(work);
  for (const Energy& e : {before, energy_})
    largest_energy_ = std::max(largest_energy_, e.kinetic + e.strain + std::abs(e.load));
  // Lower limit of the reference energy, for systems at rest: work of the constraint forces on the
  // round-off errors of the positions.
  largest_energy_ = std::max(largest_energy_, kEps * from_.lambda.cwiseAbs().dot(row_unit_));
  largest_gap_ = nan_max(largest_gap_, std::abs(gap_));
}

}  // namespace

std::unique_ptr<ConstrainedStepper> make_energy_momentum(const GeometricallyExactSystem& system,
                                                         const TransientOptions& options,
                                                         const State& start,
                                                         const Observer& observe) {
  return std::make_unique<EnergyMomentum>(system, options, start, observe);
}

}  // namespace trammel::solver::large_motion
