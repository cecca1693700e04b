#include "solver/large/consistent_initialization.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "solver/model/numbers.h"

namespace trammel::solver::large_motion {

namespace {

class ConsistentInitialization {
 public:
  ConsistentInitialization(const ConstrainedSystem& system, State& state, double step)
      : system_(system),
        state_(state),
        step_(step),
        n_(system.coordinate_count()),
        m_(system.constraint_count()),
        rigid_((system.row_compliance().array() == 0).cast<double>()),
        matrix_(n_, m_, system.coupled_unknowns()),
        constraint_residual_(VectorXd::Zero(m_)),
        constraint_rate_(VectorXd::Zero(m_)),
        force_residual_(VectorXd::Zero(n_)),
        solution_(VectorXd::Zero(n_ + m_)) {}

  Outcome run(const PrescribedVelocities& given) {
    state_.v.setZero(n_);
    state_.a.setZero(n_);
    if (state_.lambda.size() != m_) state_.lambda.setZero(m_);
    state_.load = system_.load_factor(state_.t);
    if (!project_positions()) return failed("positions");
    if (!solve_velocities(given)) return failed("velocities");
    if (!solve_accelerations()) return failed("accelerations");
    return {};
  }

  /// Computes the velocities v that satisfy the time derivatives of the constraints g as well as
  /// possible. Returns the remaining residuals G v + dg/dt with the gradient G of g. They are not
  /// zero if drives contradict the constraints.
  VectorXd rate_defect() {
    state_.v.setZero(n_);
    if (!solve_velocities({})) return VectorXd::Zero(m_);
    system_.constraint_residual(state_, constraint_residual_, constraint_rate_);
    return constraint_rate_;
  }

  Outcome run_accelerations() {
    state_.a.setZero(n_);
    if (!solve_accelerations()) return failed("accelerations");
    if (resolved_) refine_accelerations();
    return {};
  }

 private:
  Outcome failed(const std::string& what) const {
    std::ostringstream message;
    message << "no consistent initial " << what << " were found at time " << state_.t
            << " s: the largest residual of rigid constraints is " << rigid_constraint_residual()
            << " (lengths relative to the model size, angles in rad)";
    return {Status::not_converged, message.str()};
  }

  /// Returns the largest residual of the rigid constraints relative to the model size or 1 rad.
  double rigid_constraint_residual() const {
    if (m_ == 0) return 0;
    return rigid_.cwiseProduct(constraint_residual_.cwiseQuotient(system_.row_units()))
        .lpNorm<Eigen::Infinity>();
  }

  /// Solves S x + G^T y = force, G x - C y = -row for x and y, which are stored in `solution_`. S
  /// is the matrix of `assemble`, G the gradient of the constraints, and C the matrix of their
  /// compliances. In elastic rows, the right-hand side is 0 instead of -row.
  /// @return false if the matrix is singular.
  bool solve(const VectorXd& force, const VectorXd& row) {
    solution_ << force, -rigid_.cwiseProduct(row);
    matrix_.solve(solution_);
    return solution_.allFinite();
  }

  /// Assembles S = M + (fraction * step)^2 K from the mass matrix M and the tangent stiffness K.
  void assemble(double fraction) {
    const double stiffness = fraction * fraction * step_ * step_;
    matrix_.clear();
    system_.add_tangent(state_, {1, 0, stiffness, 1 / stiffness}, matrix_);
  }

  bool project_positions() {
    double last = 1e300;
    for (int i = 0; i < 30; ++i) {
      system_.constraint_residual(state_, constraint_residual_, constraint_rate_);
      const double now = rigid_constraint_residual();
      if (!std::isfinite(now)) return false;
      if (now == 0 || (now < 1e-12 && now > 0.5 * last)) return true;
      last = now;
      assemble(0.5);
      if (!matrix_.factor(system_.has_symmetric_tangent())) return false;
      if (!solve(VectorXd::Zero(n_), constraint_residual_)) return false;
      state_.q += solution_.head(n_);
    }
    return last < 1e-9;
  }

  bool solve_velocities(const PrescribedVelocities& given) {
    assemble(1e-3);
    // Penalties enforce the prescribed velocities. For coordinates divided by their units, each
    // penalty is 1e6 times the larger of two values. The two values are the sum of all inertia
    // terms, and the largest row sum of the magnitudes in the assembled matrix.
    const VectorXd& scale = system_.scale();
    VectorXd units = VectorXd::Zero(n_ + m_), rows = units;
    units.head(n_) = scale;
    matrix_.term_magnitudes(units, rows);
    const double stiffness = n_ > 0 ? rows.head(n_).cwiseProduct(scale).maxCoeff() : 0.0;
    const double energy = 1e6 * std::max(mass_scale(), stiffness);
    const auto penalty = [&](Index k) { return energy / (scale[k] * scale[k]); };
    for (const auto& [k, value] : given) matrix_.add_diagonal(k, penalty(k));
    if (!matrix_.factor(system_.has_symmetric_tangent())) return false;
    VectorXd penalty_force = VectorXd::Zero(n_);
    for (int i = 0; i < 8; ++i) {
      // Each pass increases the penalty forces by the penalties times the remaining errors of the
      // prescribed velocities.
      for (const auto& [k, value] : given) penalty_force[k] += penalty(k) * (value - state_.v[k]);
      State at_rest = state_;
      at_rest.v.setZero();
      system_.constraint_residual(at_rest, constraint_residual_, constraint_rate_);
      if (!solve(penalty_force, constraint_rate_)) return false;
      const double change = weighted_rms_norm(system_, solution_.head(n_) - state_.v);
      state_.v = solution_.head(n_);
      if (change <= 1e-15 * weighted_rms_norm(system_, state_.v)) break;
    }
    // Project the velocities v twice onto G v + dg/dt = 0, with the gradient G of the constraints
    // g. The projection removes the error that the regularization of the constraints causes.
    for (int i = 0; i < 2; ++i) {
      system_.constraint_residual(state_, constraint_residual_, constraint_rate_);
      if (!solve(VectorXd::Zero(n_), constraint_rate_)) return false;
      state_.v += solution_.head(n_);
    }
    return true;
  }

  /// Returns the sum of the inertia forces for unit accelerations of all coordinates, scaled by the
  /// units of the coordinates.
  double mass_scale() {
    State probe = state_;
    VectorXd forces(n_);
    system_.force_residual(probe, force_residual_);
    probe.a = system_.scale();
    system_.force_residual(probe, forces);
    const double sum = (forces - force_residual_).cwiseProduct(system_.scale()).cwiseAbs().sum();
    return sum > 0 ? sum : 1.0;
  }

  bool solve_accelerations() {
    system_.constraint_residual(state_, constraint_residual_, constraint_rate_);
    const double tau = system_.strain_rate_damping();
    for (Index r = 0; r < m_; ++r) {
      const double c = system_.row_compliance()[r];
      state_.lambda[r] = c > 0 ? (constraint_residual_[r] + tau * constraint_rate_[r]) / c : 0.0;
    }
    const VectorXd bias = acceleration_bias();
    system_.force_residual(state_, force_residual_);
    if (!solve_with_mass_scaling(0.5, bias)) return false;
    const VectorXd resolved = solution_;
    // With the fraction 1e-4, the stiffness term in S = M + (fraction * step)^2 K is negligible,
    // and the solution is nearly the exact acceleration. If the exact acceleration is more than
    // four times `resolved`, the acceleration `resolved` of an implicit step is used instead. In
    // this case, the step does not resolve a vibration, or a coordinate is massless.
    if (!solve_with_mass_scaling(1e-4, bias) ||
        weighted_rms_norm(system_, solution_.head(n_)) >
            4 * weighted_rms_norm(system_, resolved.head(n_))) {
      solution_ = resolved;
      resolved_ = false;
    }
    state_.a = solution_.head(n_);
    state_.lambda += rigid_.cwiseProduct(solution_.tail(m_));
    return state_.a.allFinite() && state_.lambda.allFinite();
  }

  /// Refines the accelerations while the residual of the equation of motion decreases. The residual
  /// results from the small stiffness term in the matrix S (see `assemble`).
  void refine_accelerations() {
    double last = std::numeric_limits<double>::infinity();
    for (int pass = 0; pass < 3; ++pass) {
      system_.force_residual(state_, force_residual_);
      const double now = force_residual_.cwiseProduct(system_.scale()).norm();
      if (!(now < last)) return;
      last = now;
      if (!solve(-force_residual_, VectorXd::Zero(m_))) return;
      state_.a += solution_.head(n_);
      state_.lambda += rigid_.cwiseProduct(solution_.tail(m_));
    }
  }

  bool solve_with_mass_scaling(double fraction, const VectorXd& bias) {
    assemble(fraction);
    return matrix_.factor(system_.has_symmetric_tangent()) && solve(-force_residual_, bias);
  }

  /// Returns the second time derivatives d(G v + dg/dt)/dt of the constraints g with gradient G,
  /// for zero acceleration. They are computed by a central difference along the motion. Ten digits
  /// are sufficient, because the acceleration is only a start value of the time integration.
  VectorXd acceleration_bias() {
    const double speed = state_.v.size() > 0 ? weighted_rms_norm(system_, state_.v) : 0.0;
    double d = 1e-2 * step_;
    if (speed > 0) d = std::min(d, 1e-5 / speed);
    VectorXd before = VectorXd::Zero(m_), after = VectorXd::Zero(m_);
    State shifted = state_;
    shifted.q = state_.q - d * state_.v;
    shifted.t = state_.t - d;
    system_.constraint_residual(shifted, constraint_residual_, before);
    shifted.q = state_.q + d * state_.v;
    shifted.t = state_.t + d;
    system_.constraint_residual(shifted, constraint_residual_, after);
    return (after - before) / (2 * d);
  }

  const ConstrainedSystem& system_;
  State& state_;
  double step_;
  Index n_, m_;
  bool resolved_ = true;  ///< true: the step resolves all vibrations
  VectorXd rigid_;        ///< 1 for each rigid constraint row, 0 for each compliant row
  KktMatrix matrix_;
  VectorXd constraint_residual_, constraint_rate_, force_residual_, solution_;
};

}  // namespace

Outcome make_consistent(const ConstrainedSystem& system, State& state,
                        const PrescribedVelocities& given, double step) {
  return ConsistentInitialization(system, state, step).run(given);
}

std::string drive_conflicts_text(const GeometricallyExactSystem& system, const State& state,
                                 double step) {
  // Smallest velocity error of a drive that counts as a contradiction to the constraints. The error
  // is relative to the largest velocity or velocity error of the model. Round-off errors are much
  // smaller.
  constexpr double kContradiction = 1e-3;
  const std::vector<Drive>& drives = system.large_motion().drives;
  if (drives.empty() || !state.q.allFinite()) return "";
  for (const double aside : {0.5, -0.5}) {  // a drive may start or stop at the time `state.t`
    State at = state;
    at.t += aside * step;
    at.load = system.load_factor(at.t);
    const VectorXd defect =
        ConsistentInitialization(system, at, step).rate_defect().cwiseQuotient(system.row_units());
    const double fastest =
        at.v.size() > 0 ? at.v.cwiseQuotient(system.scale()).lpNorm<Eigen::Infinity>() : 0;
    const double limit = kContradiction * std::max(fastest, defect.lpNorm<Eigen::Infinity>());
    std::string names;
    for (std::size_t i = 0; i < drives.size(); ++i) {
      if (std::abs(defect[system.drive_row(static_cast<Index>(i))]) > limit)
        names += std::string(names.empty() ? "" : ", ") + drives[i].name;
    }
    if (!names.empty())
      return "; the constraints and other drives do not admit the prescribed motion of " + names;
  }
  return "";
}

Outcome make_accelerations_consistent(const ConstrainedSystem& system, State& state, double step) {
  return ConsistentInitialization(system, state, step).run_accelerations();
}

PrescribedVelocities rigid_member_velocities(const GeometricallyExactSystem& system,
                                             const Eigen::MatrixX3d& node, const VectorXd& member) {
  // Velocity of each coordinate, or NaN if no member or node determines the velocity. If several
  // members or nodes share a coordinate, the value that is set last is used. A map would be too
  // slow, because damping requires these velocities in every iteration.
  VectorXd values = VectorXd::Constant(system.coordinate_count(), kNaN);
  const auto set = [&](Index k, double value) {
    if (k >= 0 && k < values.size()) values[k] = value;
  };
  for (const MemberElement& element : system.layout().elements) {
    const Member& moved = system.model().members[to_size(element.member)];
    const Vector2d& from = system.model().nodes[to_size(moved.nodes[0])].position;
    const Vector2d along = system.model().nodes[to_size(moved.nodes[1])].position - from;
    for (std::size_t a = 0; a < element.nodes(); ++a) {
      const Index* coordinate = &element.coordinates[element.coordinates_per_node() * a];
      const double s = (element.position(a) - from).dot(along) / along.squaredNorm();
      for (Index k = 0; k < 2; ++k)
        set(coordinate[k], (1 - s) * node(moved.nodes[0], k) + s * node(moved.nodes[1], k));
      if (!element.is_bar()) set(coordinate[2], member[element.member]);
    }
  }
  for (Index i = 0; i < node.rows(); ++i) {
    for (Index k = 0; k < 3; ++k) set(system.layout().node[to_size(i)][to_size(k)], node(i, k));
  }
  PrescribedVelocities given;
  for (Index k = 0; k < values.size(); ++k)
    if (!std::isnan(values[k])) given.emplace_back(k, values[k]);
  return given;
}

}  // namespace trammel::solver::large_motion
