#include "solver/manipulator/elastodynamics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/linear/element_operators.h"
#include "solver/linear/modes.h"
#include "solver/linear/statics.h"
#include "solver/manipulator/moving_system.h"
#include "solver/model/model.h"
#include "solver/model/numbers.h"
#include "solver/motion/modal_superposition.h"
#include "solver/motion/motion_evidence.h"
#include "solver/motion/transient_start.h"

namespace trammel::solver {

/// Balance of all forces [N] and of all moments [N m] on the complete model: the largest residual
/// and the largest sum of magnitudes over the samples. Single rows of the equation of motion
/// include the round-off errors of very stiff members. The sums over the complete model do not
/// include these errors.
struct WholeBalance {
  Vector2d residual = Vector2d::Zero(), terms = Vector2d::Zero();

  [[nodiscard]] double share() const {
    return nan_max(terms[0] > 0 ? residual[0] / terms[0] : 0,
                   terms[1] > 0 ? residual[1] / terms[1] : 0);
  }
};

/// Computes displacements, reactions, section forces and stresses of the elastic motion with free
/// coordinates q at the pose of `moving`. Reactions and section forces are in equilibrium with
/// loads, inertia and damping. The stress of a member is the largest stress at the ends of its
/// elements. Adds the residuals to `balance`.
[[nodiscard]] StaticSolution postprocess_motion(const MovingSystem& moving,
                                                const Eigen::VectorXd& q,
                                                const MovingSystem::Forces& forces,
                                                WholeBalance& balance);

namespace {

using Eigen::VectorXd;

std::vector<double> sample_times(const TransientOptions& options) {
  if (!options.sample_times.empty()) return options.sample_times;
  if (!(options.step > 0 && options.end > options.start))
    throw ModelError("the motion must end after its start, and the time step must be positive");
  return even_times(options.start, options.end, options.step);
}

/// Returns a matrix with one sample (3 components) per row.
Eigen::MatrixX3d stack(const std::vector<Vector3d>& samples) {
  Eigen::MatrixX3d rows(std::ssize(samples), 3);
  for (Index i = 0; i < rows.rows(); ++i) rows.row(i) = samples[to_size(i)];
  return rows;
}

class MotionSolver {
 public:
  explicit MotionSolver(const ElastodynamicsOptions& options)
      : options_(options), follower_(options, options.time.start), moving_(follower_.system()) {}

  ElastodynamicsSolution run() {
    if (!follower_.update_to(options_.time.start)) {
      solution_.outcome = follower_.outcome();
      return std::move(solution_);
    }
    if (!options_.elastic_inertia) {
      solve_quasi_statically();
    } else {
      find_first_frequency();
      options_.modal_superposition ? superpose_modes() : integrate();
    }
    if (!follower_.outcome().solved()) solution_.outcome = follower_.outcome();
    if (!solution_.state.empty())
      solution_.evidence.add(Residual::equation_of_motion, balance_.share());
    solution_.outcome =
        outcome_by_evidence(solution_.outcome, solution_.evidence, {Residual::equation_of_motion});
    solution_.summary.counters += follower_.counters();
    finish();
    return std::move(solution_);
  }

 private:
  /// Returns the equation of the elastic motion. Its matrices are updated at every time unless the
  /// platform is at rest.
  EquationOfMotion equation() {
    EquationOfMotion equation;
    equation.M = equation.K = moving_.K();
    if (follower_.is_damped() || options_.gyroscopic) equation.C = moving_.K();
    follower_.compute_matrices(equation.M, equation.C, equation.K);
    // The load is NaN if the pose is out of reach, which ends the integration.
    equation.load = [this](double time, VectorXd& f) {
      if (follower_.update_to(time)) {
        f = follower_.load();
      } else {
        f.setConstant(kNaN);
      }
    };
    if (!options_.load_history.is_constant()) equation.breakpoints = options_.load_history.time;
    if (options_.gyroscopic) {
      equation.working_motion = [this](double time, const VectorXd& q, const VectorXd& v) {
        // If the pose is unreachable, the load is already NaN.
        follower_.update_to(time);
        return follower_.forces(q, v, VectorXd::Zero(q.size())).working;
      };
    }
    if (!follower_.is_at_rest()) {
      equation.update = [this](double time, SparseMatrix& M, SparseMatrix& C, SparseMatrix& K) {
        if (follower_.update_to(time)) follower_.compute_matrices(M, C, K);
      };
    }
    return equation;
  }

  /// Returns the time at which the loads of a sample are evaluated. If the load factor jumps at the
  /// sample, this time is just before the sample.
  [[nodiscard]] double load_time(double time) const {
    const bool begins = time == options_.time.start;
    return begins ? time : options_.load_history.step_end_load_time(time);
  }

  /// Solves the quasi-static equation K q = T^T F + f at every sample.
  void solve_quasi_statically() {
    VectorXd q;
    const VectorXd still = VectorXd::Zero(moving_.K().rows());
    const EquationOfMotion equation = this->equation();
    MotionEvidence evidence(equation);
    for (const double time : sample_times(options_.time)) {
      if (!follower_.update_to(load_time(time))) return;
      if (!follower_.solve_statically(follower_.load(), q)) {
        solution_.outcome = {Status::singular,
                             "the stiffness is singular: free joints have no static equilibrium"};
        return;
      }
      record_exact({0, time, q, still, still, {.strain = q.dot(moving_.K() * q) / 2}},
                   load_time(time), evidence);
    }
    solution_.evidence = evidence.result();
  }

  /// Records a sample that was computed without a time integration scheme.
  void record_exact(const MotionSample& sample, double load_time, MotionEvidence& evidence) {
    evidence.add_equilibrium(sample.time, load_time, sample.q, sample.v, sample.a,
                             options_.time.step);
    record(sample, load_time);
    solution_.summary.time = sample.time;
  }

  /// Returns the load f at the current pose as a function of time. The load history scales the part
  /// of f that the wrench on the platform causes.
  [[nodiscard]] PiecewiseLinearLoad load_in_time(const VectorXd& f) const {
    const LoadHistory& history = options_.load_history;
    if (history.is_constant()) return step_load(f, options_.time.start);
    const System& start = moving_.start();
    const VectorXd applied = start.T.transpose() * start.load;
    return load_by_history(history, applied, f - history.at(options_.time.start) * applied);
  }

  /// Computes the motion at every sample by superposition of closed-form solutions for all modes.
  void superpose_modes() {
    const std::vector<double> times = sample_times(options_.time);
    if (!follower_.is_at_rest())
      throw ModelError("modal superposition requires constant matrices, but the platform moves");
    if (options_.gyroscopic) throw ModelError("a platform at rest has no gyroscopic terms");
    const SparseMatrix& M = moving_.M();
    const SparseMatrix& K = moving_.K();
    const VectorXd f = follower_.load();
    VectorXd q0 = VectorXd::Zero(f.size());
    if (options_.time.quasi_static_start && !follower_.solve_statically(f, q0)) {
      solution_.outcome = {Status::singular, "the stiffness is singular: no quasi-static start"};
      return;
    }
    std::vector<double> from_start = {options_.time.start};
    from_start.insert(from_start.end(), times.begin(), times.end());
    const ModalBasis basis = all_modes(M, K);
    solution_.outcome = basis.outcome;
    if (!basis.outcome.solved()) return;
    const ModalResponse response =
        superpose(basis, decay_rates(options_.damping, basis.omega), M, load_in_time(f), from_start,
                  q0, VectorXd::Zero(f.size()));
    const double strain_at_start = q0.dot(K * q0) / 2;
    const EquationOfMotion equation = this->equation();
    MotionEvidence evidence(equation);
    for (std::size_t i = 0; i < times.size(); ++i) {
      const auto column = static_cast<Index>(i) + 1;
      const VectorXd q = response.q.col(column), v = response.v.col(column);
      const VectorXd a = response.a.col(column);
      MotionEnergy energy{.kinetic = v.dot(M * v) / 2, .strain = q.dot(K * q) / 2};
      // The work of a variable load would require an integral over time. This work is therefore not
      // computed.
      energy.work = options_.load_history.is_constant() ? f.dot(q - q0) : kNaN;
      // Damping has dissipated the difference between the supplied energy and the current energy.
      // Without damping, this difference is only a round-off error.
      if (follower_.is_damped())
        energy.dissipated = strain_at_start + energy.work - energy.kinetic - energy.strain;
      record_exact({0, times[i], q, v, a, energy}, times[i], evidence);
    }
    solution_.evidence = evidence.result();
  }

  void find_first_frequency() {
    // Up to three modes are rigid. The four lowest modes therefore include the first elastic mode.
    const ModalSolution modes = solve_modes(moving_.start(), {.count = 4});
    const auto first = std::find_if(modes.frequency.begin(), modes.frequency.end(),
                                    [](double frequency) { return frequency > 0; });
    if (first == modes.frequency.end()) return;
    solution_.effects.first_frequency = *first;
    solution_.effects.damping_ratio =
        damping_ratio(options_.damping, 2 * std::numbers::pi * *first);
  }

  /// Computes a quasi-static start with the time derivative T. of the constraint matrix T. The
  /// start solves K q = f - T^T C u., where u. is the velocity of the solution of K q = f. Elastic
  /// inertia is omitted, because each inertia term depends on the choice of free coordinates.
  Outcome start_with_rates(TransientOptions& time, Counters& counters) {
    EquationOfMotion equation = this->equation();
    equation.C = {};
    equation.K = moving_.K();
    if (equation.update) {
      equation.update = [this](double now, SparseMatrix&, SparseMatrix&, SparseMatrix& K) {
        if (follower_.update_to(now)) K.coeffs() = moving_.K().coeffs();
      };
    }
    EquationMatrices matrices(equation);
    time.quasi_static_start = false;
    const VectorXd zero = VectorXd::Zero(equation.K.rows());
    time.q0 = time.v0 = zero;
    Outcome outcome = start_quasi_statically(matrices, options_.time, time.q0, time.v0, counters);
    if (!outcome.solved() || !follower_.is_damped() || !follower_.update_to(time.start))
      return outcome;
    const VectorXd drag = follower_.forces(time.q0, time.v0, zero).working.drag;
    const VectorXd f = follower_.load() - moving_.constraints().T.transpose() * drag;
    // The part T. q of the velocity u. = T v + T. q changes with q. Correct v so that the rates of
    // the strains remain unchanged.
    VectorXd q, change;
    if (!follower_.solve_statically(f, q) ||
        !follower_.solve_statically(moving_.K_T_dot() * (q - time.q0), change)) {
      return {Status::singular, "the stiffness is singular, so there is no quasi-static start"};
    }
    time.v0 -= change;
    time.q0 = q;
    return outcome;
  }

  /// Returns true if the computed work depends on the choice of free coordinates. The work depends
  /// on the choice if inextensible links move and the terms of the time derivatives of T are
  /// omitted.
  [[nodiscard]] bool work_depends_on_axes() const {
    return !options_.gyroscopic && !follower_.is_at_rest() &&
           std::ranges::any_of(moving_.constraints().rows, [](const ConstraintRow& row) {
             return row.source == ConstraintRow::Source::inextensible;
           });
  }

  /// Integrates the equation of motion with a time scheme.
  void integrate() {
    TransientOptions time = options_.time;
    Counters start;
    if (options_.gyroscopic && time.quasi_static_start) {
      solution_.outcome = start_with_rates(time, start);
      if (!solution_.outcome.solved()) return;
    }
    const bool no_work = work_depends_on_axes();
    solution_.summary = solve_transient(equation(), time, [&](const MotionSample& sample) {
      record(sample, load_time(sample.time));
      if (sample.index < 0 || !no_work || solution_.energy.empty()) return;
      solution_.energy.back().work = solution_.energy.back().dissipated = kNaN;
    });
    solution_.summary.counters += start;
    solution_.outcome = solution_.summary.outcome;
    solution_.evidence = solution_.summary.evidence;
  }

  /// Updates pose and loads to `load_time` and records the state of the sample. Nothing is recorded
  /// if the pose is out of reach.
  void record(const MotionSample& sample, double load_time) {
    if (!follower_.update_to(load_time)) return;
    const MovingSystem::Forces forces = follower_.forces(sample.q, sample.v, sample.a);
    // At the end of a time step at which no sample is requested, update only the balance of forces.
    if (sample.index < 0) {
      static_cast<void>(postprocess_motion(moving_, sample.q, forces, balance_));
      return;
    }
    solution_.time.push_back(sample.time);
    solution_.nominal.push_back(follower_.platform_state());
    solution_.nominal.back().time = sample.time;
    solution_.energy.push_back(sample.energy);
    // Exclude samples at which a load starts or jumps from the balance of forces, because massless
    // coordinates do not follow a jump at once.
    const std::vector<double>& jumps = options_.load_history.time;
    const bool jumps_here = std::ranges::find(jumps, sample.time) != jumps.end();
    const bool begins =
        sample.time == options_.time.start || (jumps_here && load_time == sample.time);
    WholeBalance unbalanced;
    solution_.state.push_back(postprocess_motion(
        moving_, sample.q, forces, begins || sample.interpolated ? unbalanced : balance_));
    quasi_static_.push_back(quasi_static_displacement(solution_.state.back()));
    rigid_torque_.push_back(follower_.rigid_torque());
    update_effect_numbers();
  }

  /// Returns the displacement (ux, uy [m], NaN) of the platform point P without elastic inertia and
  /// damping.
  [[nodiscard]] Vector3d quasi_static_displacement(const StaticSolution& state) {
    const Index P = moving_.start().model.find_node("P");
    if (!options_.elastic_inertia) return state.displacement.row(P);
    VectorXd q;
    if (!follower_.solve_statically(follower_.load(), q)) return Vector3d::Constant(kNaN);
    const auto& c = moving_.start().coordinates.node[to_size(P)];
    const auto& T = moving_.constraints().T;
    return {T.row(c[0]).dot(q), T.row(c[1]).dot(q), kNaN};
  }

  void update_effect_numbers() {
    const double inertia = follower_.energy_norm(moving_.inertia_load());
    const auto ratio = inertia == 0 ? 0 : inertia / follower_.energy_norm(moving_.external_load());
    double& largest = solution_.effects.nominal_inertia;
    largest = nan_max(largest, ratio);
    max_angular_velocity_ =
        std::max(max_angular_velocity_, largest_angular_velocity(moving_.motion()));
    const Vector3d unit(1, 1, platform_radius(options_.design.geometry));
    const TrajectoryPoint& point = follower_.platform_state();
    max_velocity_ = std::max(max_velocity_, point.velocity.cwiseProduct(unit).norm());
    max_acceleration_ = std::max(max_acceleration_, point.acceleration.cwiseProduct(unit).norm());
  }

  void finish() {
    solution_.quasi_static_deflection = stack(quasi_static_).leftCols<2>();
    solution_.rigid_torque = stack(rigid_torque_);
    set_platform_motion(options_.design.geometry, solution_);
    ElastodynamicsEffects& effects = solution_.effects;
    const double first = 2 * std::numbers::pi * effects.first_frequency;
    const double path = max_velocity_ > 0 ? max_acceleration_ / max_velocity_ : 0;
    effects.elastic_inertia = path * path / (first * first);
    effects.gyroscopic = 2 * max_angular_velocity_ / first;
  }

  const ElastodynamicsOptions& options_;
  PathFollower follower_;
  const MovingSystem& moving_;
  ElastodynamicsSolution solution_;
  WholeBalance balance_;
  std::vector<Vector3d> quasi_static_, rigid_torque_;
  double max_angular_velocity_ = 0, max_velocity_ = 0, max_acceleration_ = 0;
};

/// Returns the rotation that best fits the displacements (ux, uy) of C1, C2 and C3 in the
/// least-squares sense, at the platform orientation phi [rad].
double mean_platform_rotation(const ManipulatorGeometry& geometry, double phi,
                              const Eigen::Matrix<double, 3, 2>& displacement) {
  const auto& C = geometry.platform;
  const Vector2d center = (C[0] + C[1] + C[2]) / 3;
  double turning = 0, size = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector2d arm = rotated(C[i] - center, phi);
    turning += cross(arm, displacement.row(static_cast<Index>(i)));
    size += arm.squaredNorm();
  }
  return turning / size;
}

}  // namespace

ElastodynamicsSolution solve_elastodynamics(const ElastodynamicsOptions& options) {
  if (options.gyroscopic && !options.elastic_inertia)
    throw ModelError("gyroscopic terms require elastic inertia");
  return MotionSolver(options).run();
}

void set_platform_motion(const ManipulatorGeometry& geometry, ElastodynamicsSolution& solution) {
  constexpr Index kC = 6, kP = 9;  // indices of the nodes C1 and P in a built model
  const Index n = std::ssize(solution.state);
  solution.deflection.resize(n, 2);
  solution.tangential_error.resize(n);
  solution.normal_error.resize(n);
  solution.platform_rotation.resize(n);
  solution.torque.resize(n, 3);
  for (Index i = 0; i < n; ++i) {
    const StaticSolution& state = solution.state[to_size(i)];
    const TrajectoryPoint& nominal = solution.nominal[to_size(i)];
    const Vector2d deflection = state.displacement.row(kP).head<2>();
    const Vector2d velocity = nominal.velocity.head<2>();
    // Direction of the nominal velocity; NaN at zero velocity.
    const Vector2d along = velocity / velocity.norm();
    solution.deflection.row(i) = deflection;
    solution.tangential_error[i] = along.dot(deflection);
    solution.normal_error[i] = cross(along, deflection);
    solution.platform_rotation[i] =
        mean_platform_rotation(geometry, nominal.pose.phi, state.displacement.block<3, 2>(kC, 0));
    solution.torque.row(i) = state.reaction.col(2).head<3>();
  }
}

namespace {

/// Returns the end forces of the frame elements. The end forces include the tension of inextensible
/// members, which is a constraint force.
Eigen::Matrix<double, 6, Eigen::Dynamic> end_forces(const MovingSystem& moving,
                                                    const MovingSystem::Forces& forces,
                                                    const VectorXd& multipliers) {
  Eigen::Matrix<double, 6, Eigen::Dynamic> ends = forces.element;
  const auto& rows = moving.constraints().rows;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (rows[r].source != ConstraintRow::Source::inextensible) continue;
    const double tension = -multipliers[static_cast<Index>(r)];
    ends(0, rows[r].index) -= tension;
    ends(3, rows[r].index) += tension;
  }
  return ends;
}

void set_triangle_stress(const MovingSystem& moving, const VectorXd& u, StaticSolution& state) {
  const auto& triangles = moving.start().model.triangles;
  state.triangle_stress.resize(std::ssize(triangles), 3);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    TrianglePoints points;
    for (std::size_t k = 0; k < 3; ++k) points[k] = moving.position(triangles[i].nodes[k]);
    const auto local = detail::gather(moving.start().coordinates.triangle_dofs<6>(triangles[i]), u);
    const Plate& plate = moving.start().model.plates[to_size(triangles[i].plate)];
    state.triangle_stress.row(static_cast<Index>(i)) =
        membrane_stress(plate.material, triangle_deformation_matrix(points) * local);
  }
}

}  // namespace

StaticSolution postprocess_motion(const MovingSystem& moving, const VectorXd& q,
                                  const MovingSystem::Forces& forces, WholeBalance& balance) {
  StaticSolution state;
  state.q = q;
  const Constraints& constraints = moving.constraints();
  const VectorXd multipliers = constraints.lagrange_multipliers(forces.total);
  std::vector<Vector2d> positions;
  for (Index node = 0; node < std::ssize(moving.start().mesh.positions); ++node)
    positions.push_back(moving.position(node));
  set_displacements_and_forces(moving.start(),
                               {positions, forces.working.u, constraints, multipliers,
                                end_forces(moving, forces, multipliers)},
                               state);
  set_triangle_stress(moving, forces.working.u, state);
  const ForceSum sum = sum_forces(moving.start(), positions, forces.external, state);
  state.equilibrium_residual = sum.force.norm();
  state.moment_residual = std::abs(sum.moment);
  balance.residual =
      balance.residual.cwiseMax(Vector2d(state.equilibrium_residual, state.moment_residual));
  balance.terms = balance.terms.cwiseMax(sum.terms);
  return state;
}

}  // namespace trammel::solver
