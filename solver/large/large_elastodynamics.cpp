#include "solver/large/large_elastodynamics.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "solver/large/consistent_initialization.h"
#include "solver/large/equilibrium.h"
#include "solver/large/integrate_large_motion.h"
#include "solver/large/large_motion_model.h"
#include "solver/large/state_results.h"
#include "solver/large/static_path.h"
#include "solver/manipulator/elastodynamics.h"
#include "solver/manipulator/moving_element.h"
#include "solver/model/numbers.h"
#include "solver/motion/transient_start.h"

namespace trammel::solver::large_motion {

namespace {

constexpr Index kPlatform = 8;  ///< index of the platform in `InverseDynamics::q`

/// Motion of the rigid (nominal) manipulator at one time.
struct NominalState {
  TrajectoryPoint point;
  InverseDynamics dynamics;
  Model model;  ///< model at this pose, with loads and weight
};

/// Equilibrium of the flexible manipulator at one time of its nominal motion.
struct StaticInstant {
  NominalState nominal;
  std::vector<DrivenEnd> ends;
  std::unique_ptr<GeometricallyExactSystem> system;
  State state;
};

/// Adds a node for the end of a distal link at each joint that resists relative rotation. The
/// rotation of this node is driven. Returns the driven ends.
std::vector<DrivenEnd> add_driven_ends(Model& model) {
  std::vector<DrivenEnd> ends;
  for (std::size_t m = 1; m < model.members.size(); m += 2) {
    const auto limb = static_cast<Index>(m / 2);
    for (std::size_t end = 0; end < 2; ++end) {
      if (model.members[m].ends[end].fixity == EndFixity::hinged) continue;
      const Index beside = model.members[m].nodes[end], node = std::ssize(model.nodes);
      model.nodes.push_back({"", model.nodes[to_size(beside)].position});
      add_pin(model, "joint", {node, beside});
      model.members[m].nodes[end] = node;
      ends.push_back({node, beside, 3 + limb, end == 0 ? limb : kPlatform, m});
    }
  }
  return ends;
}

class LargeElastodynamics {
 public:
  explicit LargeElastodynamics(const ElastodynamicsOptions& options)
      : options_(options),
        rigid_(rigid_manipulator(options.design)),
        rigid_motion_(cached_motion([this, rigid = rigid_](double t) {
          InverseDynamics found = inverse_dynamics(rigid, at(options_.path, t));
          if (!found.outcome.solved() && reached_.solved()) {
            reached_ = found.outcome;
            reached_.reason = "at t = " + std::to_string(t) + " s: " + reached_.reason;
          }
          return found;
        })) {
    rigid_.gravity = options.gravity;
    start_ = at_time(options.time.start);
    if (!start_.dynamics.outcome.solved()) return;
    if (const char* reason = reason_no_large_displacement(options_, start_.model))
      throw ModelError(std::string("elastodynamics with large displacement: ") + reason);
    if (!options_.elastic_inertia && options_.time.sample_times.empty())
      throw ModelError("a quasi-static motion with large displacement requires sample times");
  }

  ElastodynamicsSolution run() {
    if (!start_.dynamics.outcome.solved()) {
      solution_.outcome = start_.dynamics.outcome;
    } else if (options_.elastic_inertia) {
      integrate_motion();
    } else {
      for (const double time : options_.time.sample_times) {
        const std::optional<StaticInstant> found = equilibrium_at(time);
        if (!found) break;
        add_sample(*found->system, found->state, found->nominal, found->nominal);
      }
    }
    solution_.evidence.add(Residual::equation_of_motion, balance_.residual());
    solution_.outcome =
        outcome_by_evidence(solution_.outcome, solution_.evidence, {Residual::equation_of_motion});
    finish();
    // Reset the counter of evaluations of geometric stiffening. This effect is a part of large
    // displacement that cannot be removed separately.
    solution_.summary.counters.effects[static_cast<std::size_t>(Effect::geometric_stiffening)] = 0;
    return std::move(solution_);
  }

 private:
  [[nodiscard]] NominalState at_time(double time) const {
    NominalState state;
    const Vector3d wrench = options_.load_history.at(time) * options_.wrench;
    state.point = at(options_.path, time);
    state.dynamics = inverse_dynamics(rigid_, state.point, wrench);
    if (!state.dynamics.outcome.solved()) return state;
    state.model = build_manipulator(options_.design, state.point.pose);
    state.model.gravity = options_.gravity;
    if (!wrench.isZero(0)) state.model.loads.push_back({state.model.find_node("P"), wrench});
    return state;
  }

  /// Returns the motion of the rigid links and platform at the time of `to`, relative to the pose
  /// of `from`.
  [[nodiscard]] NominalMotion motion_between(const NominalState& from,
                                             const NominalState& to) const {
    return nominal_motion(from.model, to.dynamics, from.dynamics.q, to.point, options_.gravity);
  }

  /// Returns the drives of all joints. If `moves` is false, the drives hold the joints in the pose
  /// of the model.
  [[nodiscard]] LargeMotionModel drives(Model& model, const std::vector<DrivenEnd>& ends,
                                        bool moves) const {
    LargeMotionModel large_motion;
    const auto add = [&](const std::string& name, Index node, Index part, Index from_node,
                         Index from_part) {
      TimeFunction law = [](double) { return std::array<double, 3>{}; };
      if (moves)
        law =
            joint_rotation_law(rigid_motion_, options_.path, options_.time.start, part, from_part);
      large_motion.drives.push_back({name, node, 2, std::move(law), from_node});
    };
    for (Index i = 0; i < 3; ++i) {
      model.supports[to_size(i)].fixed[2] = false;
      add("A" + std::to_string(i + 1), i, i, -1, -1);
    }
    for (const DrivenEnd& end : ends) add("joint", end.node, end.part, end.beside, end.from);
    return large_motion;
  }

  /// Computes the equilibrium at a time under loads, weight and inertia forces of the nominal
  /// motion, without damping. Returns an empty value on failure.
  [[nodiscard]] std::optional<StaticInstant> equilibrium_at(double time) {
    StaticInstant now{at_time(time), {}, {}, {}};
    if (!now.nominal.dynamics.outcome.solved()) {
      solution_.outcome = now.nominal.dynamics.outcome;
      return std::nullopt;
    }
    Model model = now.nominal.model;
    now.ends = add_driven_ends(model);
    LargeMotionModel still = drives(model, now.ends, false);
    still.mass_damping = options_.damping.mass;
    still.strain_rate_damping = options_.damping.stiffness;
    now.system = std::make_unique<GeometricallyExactSystem>(std::move(model), std::move(still));
    now.system->set_accelerations(rates_of(now, 2));
    StaticPathOptions options;
    options.first_step = 0.5;
    options.small_response = 0.01;
    options.keep_points = false;
    StaticPath path = follow_static_path(*now.system, options);
    Counters& counters = solution_.summary.counters;
    counters += path.counters;
    count_element_evaluations(*now.system, path.counters.factorizations, false, counters);
    solution_.outcome = path.outcome;
    if (!path.outcome.solved()) {
      solution_.outcome.reason = "at t = " + std::to_string(time) + " s: " + path.outcome.reason;
      return std::nullopt;
    }
    solution_.evidence.add(Residual::equation_of_motion,
                           path.evidence.largest(Residual::equilibrium));
    now.state = std::move(path.points.back().state);
    return now;
  }

  [[nodiscard]] VectorXd rates_of(const StaticInstant& now, int order) const {
    return nominal_motion_derivative(*now.system, motion_between(now.nominal, now.nominal), order,
                                     now.ends);
  }

  /// Corrects an equilibrium for the damping forces at the given rates of its deflections. Returns
  /// false on failure.
  [[nodiscard]] bool add_damping(StaticInstant& now, const VectorXd& rates) {
    State& state = now.state;
    const VectorXd nominal = rates_of(now, 1);
    now.system->set_damping_reference_velocity([nominal](double) { return nominal; });
    const VectorXd velocities = state.v = nominal + rates;
    Equilibrium equilibrium(*now.system);
    equilibrium.freeze_damping_forces(state);
    state.v.setZero();
    solution_.outcome = equilibrium.solve(state, 1).outcome;
    if (!solution_.outcome.solved()) {
      solution_.outcome.reason = "quasi-static start with damping: " + solution_.outcome.reason;
      return false;
    }
    solution_.evidence.add(Residual::equation_of_motion, equilibrium.backward_error(state));
    state.v = velocities;
    return true;
  }

  /// Computes a quasi-static start with damping, K q = f - C v. The velocities v are finite
  /// differences of second order of the solutions of K q = f. Linear elastodynamics starts in the
  /// same way.
  [[nodiscard]] bool start_quasi_statically(State& state, VectorXd& rates) {
    const double h =
        smooth_load_interval(options_.load_history.breakpoint_times(), options_.time) / 2;
    std::array<std::optional<StaticInstant>, 3> found;
    for (std::size_t i = 0; i < 3; ++i) {
      found[i] = equilibrium_at(options_.time.start + static_cast<double>(i) * h);
      if (!found[i]) return false;
    }
    const VectorXd &a = found[0]->state.q, &b = found[1]->state.q, &c = found[2]->state.q;
    const VectorXd deflection_rates = (4 * b - 3 * a - c) / (2 * h);
    if (!add_damping(*found[0], deflection_rates)) return false;
    rates += deflection_rates;
    state.q = found[0]->state.q;
    start_sample_ =
        sample_of(*found[0]->system, found[0]->state, found[0]->nominal, found[0]->nominal);
    return true;
  }

  void integrate_motion() {
    Model model = start_.model;
    model.loads.clear();
    if (!options_.wrench.isZero(0)) model.loads.push_back({model.find_node("P"), options_.wrench});
    const std::vector<DrivenEnd> ends = add_driven_ends(model);
    LargeMotionModel large_motion = drives(model, ends, true);
    large_motion.load_history = [history = options_.load_history](double t) {
      return history.at(t);
    };
    large_motion.mass_damping = options_.damping.mass;
    large_motion.strain_rate_damping = options_.damping.stiffness;
    GeometricallyExactSystem system(std::move(model), std::move(large_motion));
    const auto velocities = [&](double t) {
      const NominalState now{at(options_.path, t), rigid_motion_(t), {}};
      return nominal_motion_derivative(system, motion_between(start_, now), 1, ends);
    };
    system.set_damping_reference_velocity(velocities);
    State state = system.reference_state();
    state.t = options_.time.start;
    VectorXd rates = velocities(state.t);
    if (options_.time.quasi_static_start && !start_quasi_statically(state, rates)) return;
    PrescribedVelocities given;
    for (Index k = 0; k < rates.size(); ++k) given.emplace_back(k, rates[k]);
    solution_.outcome = make_consistent(system, state, given, options_.time.step);
    if (solution_.outcome.solved()) integrate_from(system, state);
    if (solution_.state.empty() || solution_.time.front() != options_.time.start) return;
    // Replace the first sample, because the integrator starts with the accelerations of an implicit
    // step instead of the exact accelerations.
    if (!options_.time.quasi_static_start) {
      replace_start_by_linear_theory();
    } else {
      solution_.state.front() = std::move(start_sample_);
    }
  }

  /// Replaces the first sample by the solution of linear theory, which is exact for the undeformed
  /// start. The forces of this sample are due to inertia only.
  void replace_start_by_linear_theory() {
    ElastodynamicsOptions first = options_;
    first.time.sample_times = {first.time.start};
    first.time.end = first.time.start + first.time.step;
    ElastodynamicsSolution linear = solve_elastodynamics(first);
    if (!linear.outcome.solved()) {
      solution_.outcome = linear.outcome;
      return;
    }
    StaticSolution& start = solution_.state.front() = std::move(linear.state.front());
    start.member_stress.resize(0);  // samples of large motion have no stresses
    start.triangle_stress.resize(0, 3);
    start.node_stress.resize(0, 3);
  }

  void integrate_from(const GeometricallyExactSystem& system, State& state) {
    constexpr double kInfinity = 1e8;
    TransientOptions integration = options_.time;
    integration.scheme =
        generalized_alpha(std::clamp(spectral_radius(integration.scheme, kInfinity), 0.0, 1.0));
    integration.breakpoints = options_.load_history.breakpoint_times();
    if (integration.sample_times.empty())
      integration.sample_times = even_times(integration.start, integration.end, integration.step);
    const ConstrainedSystem& equations = system;
    const auto summary = integrate(equations, state, integration, [&](const State& now) {
      if (now.t > options_.time.start) balance_.add_state(system, now);
      add_sample(system, now, start_, at_time(now.t));
    });
    solution_.outcome = summary.outcome.solved() || reached_.solved() ? summary.outcome : reached_;
    solution_.evidence.add(summary.evidence);
    TransientSummary& result = solution_.summary;
    const Counters before = result.counters;
    result = summary;
    result.largest_step = options_.time.step;
    result.counters += before;
    count_element_evaluations(system, summary.iterations, true, result.counters);
    if (options_.damping.mass != 0 || options_.damping.stiffness != 0)
      result.counters.add(Effect::damping, summary.iterations);
  }

  /// Adds the results of a state to the samples of the solution.
  void add_sample(const GeometricallyExactSystem& system, const State& state,
                  const NominalState& built, const NominalState& now) {
    StaticSolution sample = sample_of(system, state, built, now);
    solution_.time.push_back(now.point.time);
    solution_.nominal.push_back(now.point);
    rigid_torque_.push_back(now.dynamics.torque);
    solution_.state.push_back(std::move(sample));
  }

  /// Returns the results of a state relative to the nominal position `now`. `built` is the nominal
  /// state in whose pose the model was built.
  [[nodiscard]] StaticSolution sample_of(const GeometricallyExactSystem& system, const State& state,
                                         const NominalState& built, const NominalState& now) const {
    const NominalMotion moved = motion_between(built, now);
    StaticSolution sample = static_solution(system, state);
    const Index nodes = std::ssize(built.model.nodes);
    const auto turn = [](double rotation, double nominal) {
      return std::remainder(rotation - nominal, 2 * std::numbers::pi);
    };
    Eigen::MatrixX3d displacement = sample.displacement.topRows(nodes);
    for (Index i = 0; i < nodes; ++i) {
      const Vector2d from = built.model.nodes[to_size(i)].position;
      displacement.row(i).head<2>() += from.transpose() - moved.node[0].row(i);
      displacement(i, 2) = turn(displacement(i, 2), moved.part_motion_at_node(i).angle);
    }
    sample.displacement = std::move(displacement);
    for (Index m = 0; m < sample.end_rotation.rows(); ++m) {
      for (Index end = 0; end < 2; ++end)
        sample.end_rotation(m, end) =
            turn(sample.end_rotation(m, end), moved.part[to_size(m)].angle);
    }
    for (Index i = 0; i < 3; ++i) sample.reaction(i, 2) = drive_force(system, state, i);
    return sample;
  }

  void finish() {
    const Index n = std::ssize(solution_.state);
    solution_.rigid_torque.resize(n, 3);
    for (Index i = 0; i < n; ++i) solution_.rigid_torque.row(i) = rigid_torque_[to_size(i)];
    solution_.quasi_static_deflection = Eigen::MatrixX2d::Constant(n, 2, kNaN);
    set_platform_motion(options_.design.geometry, solution_);
  }

  const ElastodynamicsOptions& options_;
  RigidManipulator rigid_;
  RigidMotion rigid_motion_;
  Outcome reached_;  ///< failure when the path leaves the reach of the rigid links
  NominalState start_;
  ElastodynamicsSolution solution_;
  StaticSolution start_sample_;  ///< first sample of a quasi-static start
  MemberBalance balance_;
  std::vector<Vector3d> rigid_torque_;
};

}  // namespace

}  // namespace trammel::solver::large_motion

namespace trammel::solver {

const char* reason_no_large_displacement(const ElastodynamicsOptions& options, const Model& model) {
  const bool driven = std::all_of(model.supports.begin(), model.supports.end(),
                                  [](const Support& support) { return support.fixed[2]; });
  const bool tied = std::any_of(
      model.constraints.begin(), model.constraints.end(), [](const LinearConstraint& constraint) {
        return constraint.terms[0].first.kind == Coordinate::Kind::rotation;
      });
  const bool six_nodes = std::any_of(model.triangles.begin(), model.triangles.end(),
                                     [](const Triangle& triangle) { return triangle.quadratic(); });
  const std::vector<double>& times = options.load_history.time;
  if (!driven) return "the actuators must follow the path instead of moving freely";
  if (tied) return "platform joints of type eq25-mean or eq25-sum are not supported";
  if (!options.nominal_inertia) return "the inertia forces of the nominal motion are required";
  if (options.modal_superposition) return "modal superposition is not supported";
  if (options.time.adaptive) return "fixed time steps without error control are required";
  if (std::adjacent_find(times.begin(), times.end()) != times.end())
    return "the load history must not have jumps, which time steps cannot resolve";
  if (std::isfinite(stability_limit(options.time.scheme)))
    return "the time scheme must be stable for any step size";
  if (six_nodes) return "six-node triangles are not supported";
  return nullptr;
}

ElastodynamicsSolution solve_large_elastodynamics(const ElastodynamicsOptions& options) {
  return large_motion::LargeElastodynamics(options).run();
}

}  // namespace trammel::solver

namespace trammel::solver::large_motion {

namespace {

/// Rotation of a rigid link or of the platform at a time [rad], and the rate of the rotation
/// [rad/s].
struct Turn {
  double time = 0, angle = 0, rate = 0;
};

/// Extends a function of time beyond the ends of the path by extrapolation with the acceleration
/// and the rate of the acceleration at the end.
TimeFunction extrapolate_beyond_path(const TimeFunction& law, const Path& path) {
  return [law, limits = time_span(path)](double t) {
    const double end = std::clamp(t, limits.first, limits.second), d = t - end;
    std::array<double, 3> motion = law(end);
    if (d == 0) return motion;
    const double a = motion[2], beyond = 2 * a - law(end - d)[2];
    return std::array<double, 3>{motion[0] + d * motion[1] + d * d * (2 * a + beyond) / 6,
                                 motion[1] + d * (a + beyond) / 2, beyond};
  };
}

}  // namespace

RigidMotion cached_motion(std::function<InverseDynamics(double)> evaluate) {
  struct Last {
    double time = kNaN;
    InverseDynamics motion;
  };
  return [evaluate = std::move(evaluate),
          last = std::make_shared<Last>()](double t) -> const InverseDynamics& {
    if (last->time != t) {
      last->motion = evaluate(t);
      last->time = t;
    }
    return last->motion;
  };
}

TimeFunction joint_rotation_law(const RigidMotion& motion, const Path& path, double start,
                                Index part, Index reference_part) {
  const auto seen = [part, reference_part](const Vector9d& values) {
    return values[part] - (reference_part < 0 ? 0.0 : values[reference_part]);
  };
  const auto last = std::make_shared<Turn>(Turn{start, 0, seen(motion(start).q_dot)});
  const auto law = [motion, seen, before = seen(motion(start).q), last](double t) {
    constexpr double kSmall = 0.5;  // largest increment of the rotation [rad]
    while (true) {
      const double left = t - last->time, limit = kSmall / std::abs(last->rate);
      double step = std::abs(left) > limit ? std::copysign(limit, left) : left;
      while (std::abs(seen(motion(last->time + step).q_dot) * step) > 2 * kSmall) step /= 2;
      const Turn next{step == left ? t : last->time + step, 0, 0};
      const InverseDynamics& now = motion(next.time);
      const double within = seen(now.q) - before, turns = 2 * std::numbers::pi;
      const double angle = within + turns * std::round((last->angle - within) / turns);
      const std::array<double, 3> found = {angle, seen(now.q_dot), seen(now.q_ddot)};
      const bool lost = !std::isfinite(angle + found[1]);  // pose is out of reach or singular
      if (lost || (next.time == last->time && next.time != t)) return found;
      *last = {next.time, angle, found[1]};
      if (next.time == t) return found;
    }
  };
  return extrapolate_beyond_path(law, path);
}

VectorXd nominal_motion_derivative(const GeometricallyExactSystem& system,
                                   const NominalMotion& motion, int order,
                                   const std::vector<DrivenEnd>& ends) {
  const Model& model = system.model();
  const auto turn = [order](const PartMotion& part) {
    return order == 1 ? part.rate : part.acceleration;
  };
  const Index nodes = std::ssize(model.nodes), built = nodes - std::ssize(ends);
  Eigen::MatrixX3d node(nodes, 3);
  node.topLeftCorner(built, 2) = motion.node[to_size(order)].topRows(built);
  for (Index i = 0; i < built; ++i) node(i, 2) = turn(motion.part_motion_at_node(i));
  for (const DrivenEnd& end : ends)
    node.row(end.node) << node.row(end.beside).head<2>(), turn(motion.part[end.member]);
  VectorXd member(std::ssize(model.members));
  for (Index m = 0; m < member.size(); ++m) member[m] = turn(motion.part[to_size(m)]);
  VectorXd rates = VectorXd::Zero(system.coordinate_count());
  for (const auto& [k, value] : rigid_member_velocities(system, node, member)) rates[k] = value;
  for (std::size_t i = 0; i < model.masses.size(); ++i) {
    const PointMass& mass = model.masses[i];
    if (mass.offset.isZero(0)) continue;
    const Vector2d center =
        node.row(mass.node).head<2>().transpose() +
        motion.part_motion_at_node(mass.node).rotated_derivative(mass.offset, order);
    for (std::size_t k = 0; k < 2; ++k)
      rates[system.layout().mass_center[i][k]] = center[static_cast<Index>(k)];
  }
  return rates;
}

}  // namespace trammel::solver::large_motion
