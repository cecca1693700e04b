#include "solver/manipulator/elastodynamics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "solver/elements/triangle_element.h"
#include "solver/linalg/sparse_ldlt.h"
#include "solver/model/numbers.h"
#include "solver/model/plane.h"
#include "solver/modes/modes.h"
#include "solver/time/modal_superposition.h"

namespace trammel::solver {
namespace {

using Eigen::VectorXd;

/// Below this ratio of pivot to diagonal the stiffness counts as singular.
constexpr double kSingularPivotRatio = 1e-13;

Model loaded_model(const ElastodynamicsOptions& options) {
  Model model = build_manipulator(options.design, at(options.path, options.time.start).pose);
  if (!options.wrench.isZero(0)) model.loads.push_back({model.find_node("P"), options.wrench});
  return model;
}

/// The system on its way along the path. Poses are evaluated once for each time, and only once for
/// a platform that stands still.
class PathFollower {
 public:
  explicit PathFollower(const ElastodynamicsOptions& options)
      : options_(options),
        stands_still_(solver::stands_still(options.path)),
        rigid_(rigid_manipulator(options.design)),
        moving_(loaded_model(options), options.gyroscopic, options.elastic_inertia) {
    rigid_.gravity = options.gravity;
    const TrajectoryPoint first = at(options.path, options.time.start);
    start_ = inverse_dynamics(rigid_, first, options.wrench).q;
  }

  bool advance_to(double time) {
    if (time == time_) return outcome_.solved();
    const bool is_evaluated = stands_still_ && !std::isnan(time_);
    time_ = time;
    if (is_evaluated) {
      point_.time = time;
      return outcome_.solved();
    }
    factored_ = false;
    point_ = at(options_.path, time);
    dynamics_ = inverse_dynamics(rigid_, point_, options_.wrench);
    outcome_ = dynamics_.outcome;
    if (outcome_.solved()) {
      outcome_ = moving_.move_to(nominal_motion(options_.design, moving_.start().model, dynamics_,
                                                start_, point_, options_.gravity));
    }
    if (!outcome_.solved()) {
      outcome_.reason = "at t = " + std::to_string(time) + " s: " + outcome_.reason;
    }
    return outcome_.solved();
  }

  /// K q = f here; false where K is singular.
  bool solve_statically(const VectorXd& f, VectorXd& q) {
    if (!factored_) {
      factored_ = true;
      ++counters_.factorizations;
      regular_ =
          stiffness_.factorize(moving_.K()) && stiffness_.pivot_ratio() > kSingularPivotRatio;
    }
    if (!regular_) return false;
    ++counters_.solves;
    stiffness_.solve(f, q);
    return true;
  }

  /// (f^T K^-1 f)^(1/2), twice the energy that the load f alone would store [J^(1/2)]; NaN where K
  /// is singular.
  double energy_norm(const VectorXd& f) {
    return solve_statically(f, static_) ? std::sqrt(std::max(0.0, f.dot(static_))) : kNaN;
  }

  void load(VectorXd& f) const {
    f = moving_.load();
    if (options_.nominal_inertia) f += moving_.inertia_load();
  }

  [[nodiscard]] bool damped() const {
    return options_.damping.mass != 0 || options_.damping.stiffness != 0;
  }

  /// C stays empty where nothing goes with velocities.
  void matrices(SparseMatrix& M, SparseMatrix& C, SparseMatrix& K) {
    M.coeffs() = moving_.M().coeffs();
    K.coeffs() = moving_.K().coeffs();
    if (damped()) {
      C.coeffs() =
          options_.damping.mass * M.coeffs() + options_.damping.stiffness * moving_.K().coeffs();
      counters_.count(Effect::damping, 1);
    } else if (options_.gyroscopic) {
      C.coeffs() = moving_.gyroscopic_matrix().coeffs();
    }
    if (!options_.gyroscopic) return;
    counters_.count(Effect::gyroscopic, 1);
    if (damped()) C.coeffs() += moving_.gyroscopic_matrix().coeffs();
    K.coeffs() += moving_.centrifugal_and_euler_matrix().coeffs();
  }

  /// Torques of rigid links under the same loads and, where it is on, the same inertia.
  [[nodiscard]] Vector3d rigid_torque() const {
    if (options_.nominal_inertia) return dynamics_.torque;
    TrajectoryPoint still = point_;
    still.velocity.setZero();
    still.acceleration.setZero();
    return inverse_dynamics(rigid_, still, options_.wrench).torque;
  }

  [[nodiscard]] const MovingSystem& system() const { return moving_; }
  [[nodiscard]] const TrajectoryPoint& point() const { return point_; }
  [[nodiscard]] const Outcome& outcome() const { return outcome_; }
  [[nodiscard]] bool stands_still() const { return stands_still_; }
  /// Elements, what was solved with K, and the effects: what the parts have, once; what only the
  /// motion has, each time.
  [[nodiscard]] Counters counters() const {
    Counters all = counters_;
    all.element_evaluations += moving_.element_evaluations();
    all.effects = moving_.start().counters.effects;
    for (std::size_t i = 0; i < kEffectCount; ++i) all.effects[i] += counters_.effects[i];
    if (!options_.gravity.isZero(0)) all.count(Effect::gravity, 1);
    return all;
  }

 private:
  const ElastodynamicsOptions& options_;
  bool stands_still_;
  RigidManipulator rigid_;
  MovingSystem moving_;
  SparseLdlt stiffness_{SparseLdlt::Triangle::mean};
  bool factored_ = false, regular_ = false;
  VectorXd static_;
  Counters counters_;
  Vector9d start_;
  double time_ = kNaN;
  TrajectoryPoint point_;
  InverseDynamics dynamics_;
  Outcome outcome_;
};

/// What a motion means at one pose, as `solve_statics` puts it.
class MotionPostprocessor {
 public:
  MotionPostprocessor(const MovingSystem& moving, const VectorXd& q,
                      const MovingSystem::Forces& forces)
      : moving_(moving),
        system_(moving.start()),
        model_(system_.model),
        u_(moving.constraints().T * q),
        forces_(forces),
        multipliers_(moving.constraints().multipliers(forces.total)) {
    state_.q = q;
  }

  StaticSolution run() {
    displacements();
    reactions();
    members();
    triangles();
    equilibrium();
    return std::move(state_);
  }

 private:
  [[nodiscard]] double u(Index coordinate) const { return coordinate < 0 ? kNaN : u_[coordinate]; }

  void displacements() {
    const auto nodes = static_cast<Index>(model_.nodes.size());
    state_.displacement.resize(nodes, 3);
    for (Index i = 0; i < nodes; ++i) {
      const auto& c = system_.coordinates.node[static_cast<std::size_t>(i)];
      state_.displacement.row(i) << u(c[0]), u(c[1]), u(c[2]);
    }
    const auto members = static_cast<Index>(model_.members.size());
    state_.end_rotation.resize(members, 2);
    for (Index i = 0; i < members; ++i) {
      const auto& c = system_.coordinates.member_end[static_cast<std::size_t>(i)];
      state_.end_rotation.row(i) << u(c[0]), u(c[1]);
    }
  }

  void reactions() {
    state_.reaction.setZero(static_cast<Index>(model_.supports.size()), 3);
    const auto& rows = moving_.constraints().rows;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if (rows[r].source != ConstraintRow::Source::support) continue;
      const Support& support = model_.supports[static_cast<std::size_t>(rows[r].index)];
      const auto& node = system_.coordinates.node[static_cast<std::size_t>(support.node)];
      const auto k = std::find(node.begin(), node.end(), rows[r].terms.front().first);
      state_.reaction(rows[r].index, k - node.begin()) = multipliers_[static_cast<Index>(r)];
    }
  }

  void members() {
    const auto count = static_cast<Index>(model_.members.size());
    state_.resultant_start.resize(count, 3);
    state_.resultant_end.resize(count, 3);
    state_.member_stress.setZero(count);
    Eigen::MatrixXd ends = forces_.element;
    const auto& rows = moving_.constraints().rows;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if (rows[r].source != ConstraintRow::Source::inextensible) continue;
      const double tension = -multipliers_[static_cast<Index>(r)];
      ends(0, rows[r].index) -= tension;
      ends(3, rows[r].index) += tension;
    }
    Index before = -1;
    for (std::size_t i = 0; i < system_.mesh.frame.size(); ++i) {
      const FrameElement& e = system_.mesh.frame[i];
      const Vector6d f = ends.col(static_cast<Index>(i));
      const Eigen::RowVector3d first = -f.head<3>().transpose();
      const Eigen::RowVector3d second = f.tail<3>().transpose();
      if (e.member != before) state_.resultant_start.row(e.member) = first;
      state_.resultant_end.row(e.member) = second;
      before = e.member;
      double& largest = state_.member_stress[e.member];
      for (const Eigen::RowVector3d& s : {first, second}) {
        largest = nan_max(
            largest, std::abs(s[0]) / e.section.area + std::abs(s[2]) / e.section.section_modulus);
      }
    }
  }

  void triangles() {
    state_.triangle_stress.resize(static_cast<Index>(model_.triangles.size()), 3);
    for (std::size_t i = 0; i < model_.triangles.size(); ++i) {
      const Triangle& triangle = model_.triangles[i];
      TrianglePoints points;
      Vector6d local;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto node = static_cast<std::size_t>(triangle.nodes[k]);
        points[k] = moving_.position(triangle.nodes[k]);
        local[static_cast<Index>(2 * k)] = u_[system_.coordinates.node[node][0]];
        local[static_cast<Index>(2 * k + 1)] = u_[system_.coordinates.node[node][1]];
      }
      const Material& material = model_.plates[static_cast<std::size_t>(triangle.plate)].material;
      state_.triangle_stress.row(static_cast<Index>(i)) =
          membrane_stress(material, triangle_deformation(points) * local);
    }
  }

  /// Reactions, loads, weight, inertia and the drag of damping by mass add up to nothing.
  void equilibrium() {
    Vector2d force = Vector2d::Zero();
    double moment = 0;
    const auto add = [&](const Vector2d& at, const Vector2d& f, double m) {
      force += f;
      moment += m + cross(at, f);
    };
    const auto nodes = static_cast<Index>(system_.coordinates.node.size());
    for (Index node = 0; node < nodes; ++node) {
      const auto& c = system_.coordinates.node[static_cast<std::size_t>(node)];
      add(moving_.position(node), {forces_.external[c[0]], forces_.external[c[1]]},
          c[2] < 0 ? 0 : forces_.external[c[2]]);
    }
    for (std::size_t i = 0; i < model_.members.size(); ++i) {
      for (std::size_t end = 0; end < 2; ++end) {
        const Index own = system_.coordinates.member_end[i][end];
        const auto node = static_cast<std::size_t>(model_.members[i].nodes[end]);
        if (own >= 0 && own != system_.coordinates.node[node][2]) moment += forces_.external[own];
      }
    }
    for (std::size_t i = 0; i < model_.supports.size(); ++i) {
      const Eigen::RowVector3d r = state_.reaction.row(static_cast<Index>(i));
      add(moving_.position(model_.supports[i].node), {r[0], r[1]}, r[2]);
    }
    state_.equilibrium_residual = force.norm();
    state_.moment_residual = std::abs(moment);
  }

  const MovingSystem& moving_;
  const System& system_;
  const Model& model_;
  VectorXd u_;
  const MovingSystem::Forces& forces_;
  VectorXd multipliers_;
  StaticSolution state_;
};

/// Rotation that best fits the displacements of C1 C2 C3.
double mean_rotation(const Model& model, const MovingSystem& moving,
                     const Eigen::MatrixX3d& displacement) {
  std::array<Vector2d, 3> r;
  std::array<Vector2d, 3> u;
  for (std::size_t i = 0; i < 3; ++i) {
    const Index node = model.find_node("C" + std::to_string(i + 1));
    r[i] = moving.position(node);
    u[i] = displacement.row(node).head<2>();
  }
  const Vector2d center = (r[0] + r[1] + r[2]) / 3;
  double turning = 0;
  double size = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    turning += cross(r[i] - center, u[i]);
    size += (r[i] - center).squaredNorm();
  }
  return turning / size;
}

class Recorder {
 public:
  Recorder(const ElastodynamicsOptions& options, PathFollower& follower,
           ElastodynamicsSolution& solution)
      : options_(options), follower_(follower), solution_(solution) {}

  void record(double time, const VectorXd& q, const VectorXd& v, const VectorXd& a,
              const MotionEnergy& energy) {
    if (!follower_.advance_to(time)) return;
    const MovingSystem& moving = follower_.system();
    const Model& model = moving.start().model;
    const MovingSystem::Forces forces = moving.forces(
        q, v, a, options_.damping.mass, options_.damping.stiffness, options_.nominal_inertia);
    solution_.time.push_back(time);
    solution_.nominal.push_back(follower_.point());
    solution_.energy.push_back(energy);
    solution_.state.push_back(MotionPostprocessor(moving, q, forces).run());
    const StaticSolution& state = solution_.state.back();
    rotation_.push_back(mean_rotation(model, moving, state.displacement));
    const Index P = model.find_node("P");
    deflection_.emplace_back(state.displacement.row(P).head<2>());
    quasi_static_.push_back(options_.elastic_inertia ? quasi_static_displacement(moving, P)
                                                     : deflection_.back());
    torque_.emplace_back(state.reaction.col(2));
    rigid_torque_.push_back(follower_.rigid_torque());
    update_effect_numbers(moving);
  }

  void finish() {
    const auto n = static_cast<Index>(solution_.time.size());
    solution_.deflection.resize(n, 2);
    solution_.quasi_static_deflection.resize(n, 2);
    solution_.torque.resize(n, 3);
    solution_.rigid_torque.resize(n, 3);
    for (VectorXd* x :
         {&solution_.tangential_error, &solution_.normal_error, &solution_.platform_rotation}) {
      x->resize(n);
    }
    for (Index i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Vector2d velocity = solution_.nominal[k].velocity.head<2>();
      const Vector2d along = velocity / velocity.norm();  // NaN at a standstill
      solution_.deflection.row(i) = deflection_[k];
      solution_.quasi_static_deflection.row(i) = quasi_static_[k];
      solution_.tangential_error[i] = along.dot(deflection_[k]);
      solution_.normal_error[i] = cross(along, deflection_[k]);
      solution_.platform_rotation[i] = rotation_[k];
      solution_.torque.row(i) = torque_[k];
      solution_.rigid_torque.row(i) = rigid_torque_[k];
    }
    ElastodynamicsEffects& effects = solution_.effects;
    const double first = 2 * std::numbers::pi * effects.first_frequency;
    const double path = max_velocity_ > 0 ? max_acceleration_ / max_velocity_ : 0;
    effects.nominal_inertia = inertia_;
    effects.elastic_inertia = path * path / (first * first);
    effects.gyroscopic = 2 * max_angular_velocity_ / first;
  }

 private:
  Vector2d quasi_static_displacement(const MovingSystem& moving, Index node) {
    follower_.load(load_);
    if (!follower_.solve_statically(load_, static_)) return Vector2d::Constant(kNaN);
    const auto& c = moving.start().coordinates.node[static_cast<std::size_t>(node)];
    const auto& T = moving.constraints().T;
    return {T.row(c[0]).dot(static_), T.row(c[1]).dot(static_)};
  }

  void update_effect_numbers(const MovingSystem& moving) {
    const double inertia = follower_.energy_norm(moving.inertia_load());
    const double share = inertia == 0 ? 0 : inertia / follower_.energy_norm(moving.load());
    inertia_ = nan_max(inertia_, share);
    const NominalMotion& motion = moving.motion();
    for (const auto* parts : {&motion.member, &motion.plate, &motion.rigid_body}) {
      for (const PartMotion& part : *parts)
        max_angular_velocity_ = std::max(max_angular_velocity_, std::abs(part.rate));
    }
    max_velocity_ = std::max(max_velocity_, follower_.point().velocity.norm());
    max_acceleration_ = std::max(max_acceleration_, follower_.point().acceleration.norm());
  }

  const ElastodynamicsOptions& options_;
  PathFollower& follower_;
  ElastodynamicsSolution& solution_;
  std::vector<double> rotation_;
  std::vector<Vector2d> deflection_, quasi_static_;
  VectorXd load_, static_;
  std::vector<Vector3d> torque_, rigid_torque_;
  double inertia_ = 0, max_angular_velocity_ = 0, max_velocity_ = 0, max_acceleration_ = 0;
};

std::vector<double> sample_times(const TransientOptions& options) {
  if (!options.sample_times.empty()) return options.sample_times;
  if (!(options.step > 0 && options.end > options.start)) {
    throw ModelError("a motion ends after it starts, and its step is positive");
  }
  std::vector<double> times;
  const double step_count = std::ceil((options.end - options.start) / options.step - 1e-9);
  for (Index i = 0; i <= static_cast<Index>(step_count); ++i) {
    times.push_back(std::min(options.end, options.start + static_cast<double>(i) * options.step));
  }
  return times;
}

/// K q = F + f at every sample.
void solve_quasi_statically(const ElastodynamicsOptions& options, PathFollower& follower,
                            Recorder& recorder, ElastodynamicsSolution& solution) {
  const std::vector<double> times = sample_times(options.time);
  VectorXd f;
  VectorXd q;
  const VectorXd still = VectorXd::Zero(follower.system().K().rows());
  for (const double time : times) {
    if (!follower.advance_to(time)) return;
    follower.load(f);
    if (!follower.solve_statically(f, q)) {
      solution.outcome = {Status::singular,
                          "the stiffness is singular: free joints have no quasi-static position"};
      return;
    }
    MotionEnergy energy;
    energy.strain = q.dot(follower.system().K() * q) / 2;
    recorder.record(time, q, still, still, energy);
    solution.summary.time = time;
  }
}

/// All modes at every sample, each by its closed form.
void superpose_modes(const ElastodynamicsOptions& options, PathFollower& follower,
                     Recorder& recorder, ElastodynamicsSolution& solution) {
  const std::vector<double> times = sample_times(options.time);
  if (!follower.stands_still()) {
    throw ModelError("modes are superposed where the matrices are constant: the platform moves");
  }
  if (options.gyroscopic) throw ModelError("a platform that stands still has no convective terms");
  const SparseMatrix& M = follower.system().M();
  const SparseMatrix& K = follower.system().K();
  VectorXd f;
  follower.load(f);
  VectorXd q0 = VectorXd::Zero(f.size());
  if (options.time.quasi_static_start && !follower.solve_statically(f, q0)) {
    solution.outcome = {Status::singular, "the stiffness is singular: no quasi-static start"};
    return;
  }
  std::vector<double> from_start = {options.time.start};
  from_start.insert(from_start.end(), times.begin(), times.end());
  const ModalBasis basis = all_modes(M, K);
  solution.outcome = basis.outcome;
  if (!basis.outcome.solved()) return;
  const ModalResponse response =
      superpose(basis, decay_rates(options.damping, basis.omega), M,
                step_load(f, options.time.start), from_start, q0, VectorXd::Zero(f.size()));
  const double strain_at_start = q0.dot(K * q0) / 2;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto column = static_cast<Index>(i) + 1;
    const VectorXd q = response.q.col(column);
    const VectorXd v = response.v.col(column);
    MotionEnergy energy;
    energy.kinetic = v.dot(M * v) / 2;
    energy.strain = q.dot(K * q) / 2;
    energy.work = f.dot(q - q0);
    // What is missing has been dissipated; without damping it shows the round-off.
    const bool damped = options.damping.mass != 0 || options.damping.stiffness != 0;
    if (damped) energy.dissipated = strain_at_start + energy.work - energy.kinetic - energy.strain;
    recorder.record(times[i], q, v, response.a.col(column), energy);
    solution.summary.time = times[i];
  }
}

void find_first_frequency(const ElastodynamicsOptions& options, const System& start,
                          ElastodynamicsEffects& effects) {
  const ModalSolution modes = solve_modes(start, {.count = 4});  // three may be rigid
  const auto first = std::find_if(modes.frequency.begin(), modes.frequency.end(),
                                  [](double frequency) { return frequency > 0; });
  if (first == modes.frequency.end()) return;
  effects.first_frequency = *first;
  effects.damping_ratio = damping_ratio(options.damping, 2 * std::numbers::pi * *first);
}

/// By a scheme; the matrices are evaluated at every step unless the platform stands still.
void integrate(const ElastodynamicsOptions& options, PathFollower& follower, Recorder& recorder,
               ElastodynamicsSolution& solution) {
  EquationOfMotion equation;
  equation.M = equation.K = follower.system().K();
  if (follower.damped() || options.gyroscopic) equation.C = follower.system().K();
  follower.matrices(equation.M, equation.C, equation.K);
  // Where there is no pose the numbers end, and with them the integration.
  equation.load = [&follower](double time, VectorXd& f) {
    if (follower.advance_to(time)) {
      follower.load(f);
    } else {
      f.setConstant(kNaN);
    }
  };
  if (!follower.stands_still()) {
    equation.update = [&follower](double time, SparseMatrix& M, SparseMatrix& C, SparseMatrix& K) {
      if (follower.advance_to(time)) follower.matrices(M, C, K);
    };
  }
  solution.summary = solve_transient(equation, options.time, [&](const MotionSample& sample) {
    recorder.record(sample.time, sample.q, sample.v, sample.a, sample.energy);
  });
  solution.outcome = solution.summary.outcome;
}

}  // namespace

NominalMotion nominal_motion(const ManipulatorDesign& design, const Model& model,
                             const InverseDynamics& dynamics, const Vector9d& from,
                             const TrajectoryPoint& point, const Vector2d& gravity) {
  const auto part = [&](Index i) {
    return PartMotion{dynamics.q[i] - from[i], dynamics.q_dot[i], dynamics.q_ddot[i]};
  };
  const PartMotion platform = part(8);
  NominalMotion motion;
  motion.gravity = gravity;
  motion.plate.assign(model.plates.size(), platform);
  motion.rigid_body.assign(model.rigid_bodies.size(), platform);
  const auto nodes = static_cast<Index>(model.nodes.size());
  motion.position.resize(nodes, 2);
  motion.acceleration.setZero(nodes, 2);
  for (Index i = 0; i < 3; ++i) {
    motion.member.push_back(part(i));
    motion.member.push_back(part(3 + i));
    const Vector2d A = design.geometry.base[static_cast<std::size_t>(i)];
    const double length = design.geometry.proximal[static_cast<std::size_t>(i)];
    const Vector2d arm = length * Vector2d(std::cos(dynamics.q[i]), std::sin(dynamics.q[i]));
    const double rate = dynamics.q_dot[i];
    motion.position.row(i) = A;
    motion.position.row(3 + i) = A + arm;
    motion.acceleration.row(3 + i) = dynamics.q_ddot[i] * perpendicular(arm) - rate * rate * arm;
  }
  // C1 C2 C3, P and the nodes of a plate turn with the platform.
  const Vector2d P = from.segment<2>(6);
  const Vector2d now(point.pose.x, point.pose.y);
  for (Index i = 6; i < nodes; ++i) {
    const Vector2d arm =
        rotated(model.nodes[static_cast<std::size_t>(i)].position - P, platform.angle);
    motion.position.row(i) = now + arm;
    motion.acceleration.row(i) = point.acceleration.head<2>() +
                                 platform.acceleration * perpendicular(arm) -
                                 platform.rate * platform.rate * arm;
  }
  return motion;
}

ElastodynamicsSolution solve_elastodynamics(const ElastodynamicsOptions& options) {
  if (options.gyroscopic && !options.elastic_inertia) {
    throw ModelError(
        "convective terms are inertia of the elastic motion: without it there are none");
  }
  ElastodynamicsSolution solution;
  PathFollower follower(options);
  Recorder recorder(options, follower, solution);
  if (!follower.advance_to(options.time.start)) {
    solution.outcome = follower.outcome();
    return solution;
  }
  if (options.elastic_inertia) {
    find_first_frequency(options, follower.system().start(), solution.effects);
  }
  if (!options.elastic_inertia) {
    solve_quasi_statically(options, follower, recorder, solution);
  } else if (options.modal_superposition) {
    superpose_modes(options, follower, recorder, solution);
  } else {
    integrate(options, follower, recorder, solution);
  }
  if (!follower.outcome().solved()) solution.outcome = follower.outcome();
  solution.summary.counters += follower.counters();
  recorder.finish();
  return solution;
}

}  // namespace trammel::solver
