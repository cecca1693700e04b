#include "solver/manipulator/forward_dynamics.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace trammel::solver {

namespace {

using State = Eigen::Matrix<double, 6, 1>;  // pose, velocity
using Stages = Eigen::Matrix<double, 6, 7>;

Pose pose_of(const State& y) {
  return {y(0), y(1), y(2)};
}

/// Dormand, Prince (1980), table 2: stage times, stage weights, error weights.
struct Tableau {
  static constexpr std::array<double, 7> c = {0, 1.0 / 5, 3.0 / 10, 4.0 / 5, 8.0 / 9, 1, 1};
  static constexpr double a[7][6] = {
      {},
      {1.0 / 5},
      {3.0 / 40, 9.0 / 40},
      {44.0 / 45, -56.0 / 15, 32.0 / 9},
      {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
      {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
      {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};
  static constexpr std::array<double, 7> error = {
      71.0 / 57600, 0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525, -1.0 / 40};
};

class Integrator {
 public:
  Integrator(const RigidManipulator& manipulator, const std::function<Vector3d(double)>& torque,
             const Vector3d& wrench, const ForwardOptions& options, const TrajectoryPoint& start)
      : manipulator_(manipulator),
        torque_(torque),
        wrench_(wrench),
        options_(options),
        t_(start.time) {
    y_ << start.pose.x, start.pose.y, start.pose.phi, start.velocity;
    for (const Vector2d& c : manipulator.geometry.platform) size_ += c.norm() / 3;
    result.outcome = evaluate(t_, y_, k_, 0);
  }

  /// Goes on to the time `end`; the last step is shortened to meet it.
  void advance(double end) {
    while (result.outcome.solved() && t_ < end) {
      if (result.steps + result.rejected >= options_.max_steps) {
        stop(Status::not_converged, "too many steps");
        return;
      }
      const bool last = t_ + 1.01 * h_ >= end;
      step(last ? end - t_ : h_, last ? end : t_ + h_);
    }
  }

  [[nodiscard]] TrajectoryPoint point() const {
    return {t_, pose_of(y_), y_.tail<3>(), k_.col(0).tail<3>()};
  }

  ForwardDynamics result;

 private:
  Outcome evaluate(double t, const State& y, Stages& k, Index stage) {
    ++result.evaluations;
    const PlatformAcceleration a =
        forward_acceleration(manipulator_, pose_of(y), y.tail<3>(), torque_(t), wrench_);
    if (a.outcome.solved()) k.col(stage) << y.tail<3>(), a.acceleration;
    return a.outcome;
  }

  void step(double h, double end) {
    State y = y_;
    for (Index s = 1; s < 7; ++s) {
      y = y_;
      for (Index j = 0; j < s; ++j) y += h * Tableau::a[s][j] * k_.col(j);
      const Outcome outcome = evaluate(t_ + h * Tableau::c[static_cast<std::size_t>(s)], y, k_, s);
      if (!outcome.solved()) return shrink(h / 4, outcome.reason);
    }
    State error = State::Zero();
    for (Index s = 0; s < 7; ++s)
      error += h * Tableau::error[static_cast<std::size_t>(s)] * k_.col(s);
    const double norm = std::max(relative(error, y, 0), relative(error, y, 3)) / options_.tolerance;
    if (!(norm <= 1)) return shrink(h * std::clamp(0.9 * std::pow(norm, -0.2), 0.2, 0.9), "");
    ++result.steps;
    t_ = end;
    y_ = y;
    k_.col(0) = k_.col(6);  // first same as last
    const double next = h * std::clamp(0.9 * std::pow(std::max(norm, 1e-9), -0.2), 0.5, 5.0);
    h_ = h < h_ ? std::max(h_, next) : next;  // a step shortened to meet a time says little
  }

  /// Error of positions (first = 0) or velocities (3); rotations count by the platform's radius.
  [[nodiscard]] double relative(const State& error, const State& y, Index first) const {
    const Vector3d scale(1, 1, size_);
    const double largest = y.segment<3>(first).cwiseProduct(scale).cwiseAbs().maxCoeff();
    return error.segment<3>(first).cwiseProduct(scale).cwiseAbs().maxCoeff() /
           std::max(largest, size_);
  }

  void shrink(double h, const std::string& reason) {
    ++result.rejected;
    h_ = h;
    if (std::abs(h_) > 16 * std::numeric_limits<double>::epsilon() * std::max(1.0, std::abs(t_)))
      return;
    if (reason.empty()) {
      stop(Status::not_converged, "the step has become smaller than the rounding of time");
    } else {
      stop(Status::singular, reason);
    }
  }

  void stop(Status status, const std::string& reason) {
    std::ostringstream why;
    why << "at " << t_ << " s: " << reason;
    result.outcome = {status, why.str()};
  }

  const RigidManipulator& manipulator_;
  const std::function<Vector3d(double)>& torque_;
  const Vector3d wrench_;
  const ForwardOptions options_;
  double size_ = 0;
  double t_;
  double h_ = 1e-3;
  State y_;
  Stages k_;
};

}  // namespace

PlatformAcceleration forward_acceleration(const RigidManipulator& m, const Pose& pose,
                                          const Vector3d& velocity, const Vector3d& torque,
                                          const Vector3d& wrench) {
  const RigidTerms terms = rigid_terms(m, pose, velocity);
  PlatformAcceleration result{terms.outcome,
                              Vector3d::Constant(std::numeric_limits<double>::quiet_NaN())};
  if (!terms.outcome.solved()) return result;
  const Matrix3d G = terms.W.bottomRows<3>();
  const Vector3d rates = terms.q_dot.head<3>();
  const Vector3d force = torque + G.transpose() * wrench - terms.Ch * rates - terms.Nh;
  const Eigen::LLT<Matrix3d> llt(terms.Mh);
  if (llt.info() != Eigen::Success) {
    result.outcome = {Status::singular, "the reduced mass matrix is not positive definite"};
    return result;
  }
  const Vector3d active = llt.solve(force);
  result.acceleration = G * active + terms.W_dot.bottomRows<3>() * rates;
  return result;
}

ForwardDynamics forward_dynamics(const RigidManipulator& m, const TrajectoryPoint& start,
                                 const std::function<Vector3d(double)>& torque,
                                 const std::vector<double>& times, const Vector3d& wrench,
                                 const ForwardOptions& options) {
  if (!(options.tolerance > 0)) throw ModelError("the tolerance of the motion must be positive");
  double last = start.time;
  for (const double t : times) {
    if (!(t >= last) || !std::isfinite(t))
      throw ModelError("the times of the motion must ascend from its start");
    last = t;
  }
  Integrator integrator(m, torque, wrench, options, start);
  integrator.result.motion.reserve(times.size());
  for (const double t : times) {
    integrator.advance(t);
    if (!integrator.result.outcome.solved()) break;
    integrator.result.motion.push_back(integrator.point());
  }
  return std::move(integrator.result);
}

}  // namespace trammel::solver
