#include "solver/elastodynamics/path_follower.h"

#include <algorithm>
#include <cmath>

#include "solver/elastodynamics/nominal_motion.h"

namespace trammel::solver {

using Eigen::VectorXd;

namespace {

/// Below this ratio of pivot to diagonal the stiffness counts as singular.
constexpr double kSingularPivotRatio = 1e-13;

Model loaded_model(const ElastodynamicsOptions& options, double time) {
  Model model = build_manipulator(options.design, at(options.path, time).pose);
  if (!options.wrench.isZero(0)) model.loads.push_back({model.find_node("P"), options.wrench});
  return model;
}

}  // namespace

PathFollower::PathFollower(const ElastodynamicsOptions& options, double built_at)
    : options_(options),
      stands_still_(solver::stands_still(options.path)),
      rigid_(rigid_manipulator(options.design)),
      moving_(loaded_model(options, built_at),
              {.inertia = options.elastic_inertia, .gyroscopic = options.gyroscopic}) {
  rigid_.gravity = options.gravity;
  start_ = inverse_dynamics(rigid_, at(options.path, built_at), wrench(built_at)).q;
}

bool PathFollower::update_to(double time) {
  if (time == time_) return outcome_.solved();
  if (stands_still_ && options_.load_history.constant() && !std::isnan(time_)) {
    point_.time = time;
  } else {
    outcome_ = move_to(time, options_.gravity);
    if (!outcome_.solved()) {
      outcome_.reason = "at t = " + std::to_string(time) + " s: " + outcome_.reason;
    }
  }
  time_ = time;
  return outcome_.solved();
}

Outcome PathFollower::move_to(double time, const Vector2d& gravity) {
  time_ = kNaN;
  factored_ = false;
  point_ = at(options_.path, time);
  dynamics_ = inverse_dynamics(rigid_, point_, wrench(time));
  if (!dynamics_.outcome.solved()) return dynamics_.outcome;
  NominalMotion motion = nominal_motion(moving_.start().model, dynamics_, start_, point_, gravity);
  motion.load_factor = options_.load_history.at(time);
  return moving_.move_to(motion);
}

Vector3d PathFollower::wrench(double time) const {
  return options_.load_history.at(time) * options_.wrench;
}

bool PathFollower::damped() const {
  return options_.damping.mass != 0 || options_.damping.stiffness != 0;
}

VectorXd PathFollower::load() const {
  VectorXd f = moving_.load();
  if (options_.nominal_inertia) f += moving_.inertia_load();
  return f;
}

void PathFollower::matrices(SparseMatrix& M, SparseMatrix& C, SparseMatrix& K) {
  K.coeffs() = moving_.K().coeffs();
  M.coeffs().setZero();
  if (options_.elastic_inertia) M.coeffs() = moving_.M().coeffs();
  const auto [mass, stiffness] = options_.damping;
  if (damped() || options_.gyroscopic)
    C.coeffs() = mass * M.coeffs() + stiffness * moving_.K().coeffs();
  if (damped()) counters_.count(Effect::damping, 1);
  if (!options_.gyroscopic) return;
  counters_.count(Effect::gyroscopic, 1);
  C.coeffs() += moving_.gyroscopic_matrix().coeffs();
  K.coeffs() += moving_.centrifugal_and_euler_matrix().coeffs() +
                mass * moving_.M_T_dot().coeffs() + stiffness * moving_.K_T_dot().coeffs();
}

bool PathFollower::solve_statically(const VectorXd& f, VectorXd& q) {
  if (!factored_) {
    factored_ = true;
    ++counters_.factorizations;
    regular_ = stiffness_.factorize(moving_.K()) &&
               stiffness_.smallest_to_largest_pivot() > kSingularPivotRatio;
  }
  if (!regular_) return false;
  ++counters_.solves;
  stiffness_.solve(f, q);
  return true;
}

double PathFollower::energy_norm(const VectorXd& f) {
  VectorXd q;
  return solve_statically(f, q) ? std::sqrt(std::max(0.0, f.dot(q))) : kNaN;
}

Vector3d PathFollower::rigid_torque() const {
  if (options_.nominal_inertia) return dynamics_.torque;
  TrajectoryPoint still = point_;
  still.velocity.setZero();
  still.acceleration.setZero();
  return inverse_dynamics(rigid_, still, wrench(point_.time)).torque;
}

Counters PathFollower::counters() const {
  Counters all = counters_;
  all.element_evaluations += moving_.element_evaluations();
  all.effects = moving_.start().counters.effects;
  for (std::size_t i = 0; i < kEffectCount; ++i) all.effects[i] += counters_.effects[i];
  if (!options_.gravity.isZero(0)) all.count(Effect::gravity, 1);
  return all;
}

}  // namespace trammel::solver
