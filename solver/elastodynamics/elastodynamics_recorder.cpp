#include "solver/elastodynamics/elastodynamics_recorder.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/elastodynamics/motion_postprocessing.h"
#include "solver/model/plane.h"

namespace trammel::solver {

using Eigen::VectorXd;

namespace {

/// One row a sample.
template <class Matrix, class Vector>
void stack(const std::vector<Vector>& samples, Matrix& rows) {
  rows.resize(static_cast<Index>(samples.size()), Vector::RowsAtCompileTime);
  for (Index i = 0; i < rows.rows(); ++i) rows.row(i) = samples[to_size(i)];
}

}  // namespace

void set_path_errors(ElastodynamicsSolution& solution) {
  const Index n = solution.deflection.rows();
  solution.tangential_error.resize(n);
  solution.normal_error.resize(n);
  for (Index i = 0; i < n; ++i) {
    const Vector2d velocity = solution.nominal[to_size(i)].velocity.head<2>();
    const Vector2d along = velocity / velocity.norm();  // NaN at a standstill
    const Vector2d deflection = solution.deflection.row(i);
    solution.tangential_error[i] = along.dot(deflection);
    solution.normal_error[i] = cross(along, deflection);
  }
}

StaticSolution ElastodynamicsRecorder::state_of(const VectorXd& q, const VectorXd& v,
                                                const VectorXd& a, WholeBalance& balance) const {
  return postprocess_motion(follower_.system(), q, follower_.forces(q, v, a), balance);
}

void ElastodynamicsRecorder::add_balance(double load_time, const VectorXd& q, const VectorXd& v,
                                         const VectorXd& a) {
  if (follower_.update_to(load_time)) (void)state_of(q, v, a, balance_);
}

void ElastodynamicsRecorder::record(double time, const VectorXd& q, const VectorXd& v,
                                    const VectorXd& a, const MotionEnergy& energy,
                                    std::optional<double> load_time, bool interpolated) {
  if (!follower_.update_to(load_time.value_or(time))) return;
  const MovingSystem& moving = follower_.system();
  solution_.time.push_back(time);
  solution_.nominal.push_back(follower_.point());
  solution_.nominal.back().time = time;
  solution_.energy.push_back(energy);
  // Where the load sets in or jumps, coordinates without mass are not yet where it puts them.
  const std::vector<double>& jumps = options_.load_history.time;
  const bool jumps_here = std::find(jumps.begin(), jumps.end(), time) != jumps.end();
  const bool begins =
      time == options_.time.start || (jumps_here && load_time.value_or(time) == time);
  WholeBalance unbalanced;
  solution_.state.push_back(state_of(q, v, a, begins || interpolated ? unbalanced : balance_));
  const StaticSolution& state = solution_.state.back();
  rotation_.push_back(
      mean_platform_rotation(moving.start().model, moving.motion().position, state.displacement));
  const Index P = moving.start().model.find_node("P");
  deflection_.emplace_back(state.displacement.row(P).head<2>());
  quasi_static_.push_back(options_.elastic_inertia ? quasi_static_displacement(P)
                                                   : deflection_.back());
  torque_.emplace_back(state.reaction.col(2));
  rigid_torque_.push_back(follower_.rigid_torque());
  update_effect_numbers();
}

void ElastodynamicsRecorder::finish() {
  stack(deflection_, solution_.deflection);
  stack(quasi_static_, solution_.quasi_static_deflection);
  stack(torque_, solution_.torque);
  stack(rigid_torque_, solution_.rigid_torque);
  const auto n = static_cast<Index>(solution_.time.size());
  solution_.platform_rotation = Eigen::Map<const VectorXd>(rotation_.data(), n);
  set_path_errors(solution_);
  ElastodynamicsEffects& effects = solution_.effects;
  const double first = 2 * std::numbers::pi * effects.first_frequency;
  const double path = max_velocity_ > 0 ? max_acceleration_ / max_velocity_ : 0;
  effects.nominal_inertia = inertia_;
  effects.elastic_inertia = path * path / (first * first);
  effects.gyroscopic = 2 * max_angular_velocity_ / first;
}

Vector2d ElastodynamicsRecorder::quasi_static_displacement(Index node) {
  VectorXd q;
  if (!follower_.solve_statically(follower_.load(), q)) return Vector2d::Constant(kNaN);
  const MovingSystem& moving = follower_.system();
  const auto& c = moving.start().coordinates.node[to_size(node)];
  const auto& T = moving.constraints().T;
  return {T.row(c[0]).dot(q), T.row(c[1]).dot(q)};
}

void ElastodynamicsRecorder::update_effect_numbers() {
  const MovingSystem& moving = follower_.system();
  const double inertia = follower_.energy_norm(moving.inertia_load());
  const double share = inertia == 0 ? 0 : inertia / follower_.energy_norm(moving.load());
  inertia_ = nan_max(inertia_, share);
  max_angular_velocity_ =
      std::max(max_angular_velocity_, largest_angular_velocity(moving.motion()));
  max_velocity_ = std::max(max_velocity_, follower_.point().velocity.norm());
  max_acceleration_ = std::max(max_acceleration_, follower_.point().acceleration.norm());
}

}  // namespace trammel::solver
