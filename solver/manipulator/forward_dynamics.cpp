#include "solver/manipulator/forward_dynamics.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <boost/numeric/odeint/algebra/vector_space_algebra.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "solver/linalg/dense_eigen.h"
#include "solver/manipulator/rigid_dynamics.h"
#include "solver/model/model.h"
#include "solver/model/numbers.h"

namespace trammel::solver {

namespace {

namespace odeint = boost::numeric::odeint;
// Components of the state: pose (3), velocity (3), work of torques and wrench (1).
using State = Eigen::Matrix<double, 7, 1>;

/// Local error of a time step relative to the tolerance, as defined in ForwardOptions. Odeint
/// accepts the step if the relative error is at most 1.
struct ErrorNorm {
  double tolerance;
  double duration;  ///< duration of the motion [s]
  /// Platform radius, by which rotations are multiplied for the comparison with translations [m].
  double radius;

  template <class Algebra>
  double error(Algebra&, const State& y, const State&, const State& error, double) const {
    if (!error.allFinite()) return std::numeric_limits<double>::infinity();
    // Returns the largest magnitude of the pose coordinates (first = 0) or velocities (first = 3)
    // in a state x.
    const auto size = [this](const State& x, Index first) {
      return x.segment<3>(first).cwiseProduct(Vector3d(1, 1, radius)).cwiseAbs().maxCoeff();
    };
    const double speed = duration > 0 ? radius / duration : 0;
    return std::max(size(error, 0) / std::max(size(y, 0), radius),
                    size(error, 3) / std::max(size(y, 3), speed)) /
           tolerance;
  }
};

using DormandPrince =
    odeint::runge_kutta_dopri5<State, double, State, double, odeint::vector_space_algebra>;
using ControlledStepper = odeint::controlled_runge_kutta<DormandPrince, ErrorNorm>;

class MotionIntegrator {
 public:
  MotionIntegrator(const RigidManipulator& manipulator,
                   const std::function<Vector3d(double)>& torque, const Vector3d& wrench,
                   const ForwardOptions& options, const TrajectoryPoint& start, double end)
      : manipulator_(manipulator),
        torque_(torque),
        wrench_(wrench),
        max_steps_(options.max_steps),
        duration_(end - start.time),
        stepper_(ErrorNorm{options.tolerance, duration_, platform_radius(manipulator.geometry)}),
        t_(start.time),
        h_(1e-3 * duration_) {  // initial time step; the error control adjusts it
    y_ << start.pose.vector(), start.velocity, 0;
    result.outcome = evaluate(t_, y_, rate_);
    side_ = side();
    if (result.outcome.solved()) add_evidence();
  }

  /// Adds the residuals of the equation of motion and of loop closure at the current time, and
  /// updates the energy balance.
  void add_evidence() {
    const InverseDynamics now = inverse_dynamics(manipulator_, point(), wrench_);
    const RigidTerms terms = rigid_terms(manipulator_, pose(), y_.segment<3>(3));
    const Vector3d given = torque_(t_);
    const Vector3d size = terms.Mh.cwiseAbs() * now.q_ddot.head<3>().cwiseAbs() +
                          terms.Ch.cwiseAbs() * now.q_dot.head<3>().cwiseAbs() +
                          terms.Nh.cwiseAbs() + given.cwiseAbs() +
                          terms.W.bottomRows<3>().transpose().cwiseAbs() * wrench_.cwiseAbs();
    result.evidence.add(Residual::equation_of_motion, row_backward_error(now.torque - given, size));
    const ManipulatorGeometry& g = manipulator_.geometry;
    double reach = 0;
    for (std::size_t i = 0; i < 3; ++i) reach = std::max(reach, g.proximal[i] + g.distal[i]);
    result.evidence.add(Residual::constraints, inverse_kinematics(g, pose()).closure_error / reach);
    const double energy = now.kinetic_energy + now.potential_energy;
    if (std::isnan(start_energy_)) start_energy_ = energy;
    const double change = energy - start_energy_;
    turnover_ += std::abs(y_(6) - last_work_);
    last_work_ = y_(6);
    energy_size_ = std::max({energy_size_, now.kinetic_energy, std::abs(change)});
    largest_imbalance_ = nan_max(largest_imbalance_, std::abs(change - y_(6)));
  }

  /// Adds the residual of the energy balance over the complete motion and returns the result.
  [[nodiscard]] ForwardDynamics finish() {
    const double size = energy_size_ + turnover_;
    result.evidence.add(Residual::energy, size > 0 ? largest_imbalance_ / size : 0);
    result.outcome = outcome_by_evidence(
        result.outcome, result.evidence,
        {Residual::equation_of_motion, Residual::constraints, Residual::energy});
    return std::move(result);
  }

  /// Integrates to the time `end`. The last time step is shortened to end at this time.
  void advance(double end) {
    while (result.outcome.solved() && t_ < end) {
      if (result.steps + result.rejected >= max_steps_) {
        stop(Status::not_converged, "the limit of the number of time steps was reached");
      } else {
        step(end);
      }
    }
  }

  [[nodiscard]] TrajectoryPoint point() const {
    return {t_, pose(), y_.segment<3>(3), rate_.segment<3>(3)};
  }

  ForwardDynamics result;

 private:
  [[nodiscard]] Pose pose() const { return pose_of(y_.head<3>()); }

  Outcome evaluate(double t, const State& y, State& rate) {
    ++result.evaluations;
    const PlatformAcceleration a = forward_acceleration(manipulator_, pose_of(y.head<3>()),
                                                        y.segment<3>(3), torque_(t), wrench_);
    rate << y.segment<3>(3), a.acceleration, a.power;
    return a.outcome;
  }

  void step(double end) {
    const bool last = t_ + 1.01 * h_ >= end;
    const double tried = last ? end - t_ : h_;
    double h = tried;
    // Outcome of the Runge-Kutta stages. After a singular stage, the remaining stages are skipped.
    Outcome stages;
    const auto system = [&](const State& y, State& rate, double t) {
      if (stages.solved()) {
        stages = evaluate(t, y, rate);
      } else {
        rate.setConstant(kNaN);
      }
    };
    if (stepper_.try_step(system, y_, rate_, t_, h) == odeint::success) {
      ++result.steps;
      if (side() * side_ < 0) stop(Status::singular, kSingularity);
      if (last) t_ = end;
      // A step that was shortened to end at the requested time does not reduce the next step.
      h_ = tried < h_ ? std::max(h_, h) : h;
      return;
    }
    ++result.rejected;
    h_ = h;
    if (h > 16 * kEps * std::max(duration_, std::abs(t_))) return;
    if (stages.solved()) {
      stop(Status::not_converged,
           "the time step has become smaller than the round-off error of the time");
    } else {
      stop(Status::singular, stages.reason);
    }
  }

  /// Returns the determinant of the parallel Jacobian matrix J_x, whose sign changes at a parallel
  /// singularity. The equation of motion in the actuator angles has no solution at the singularity.
  /// A time step may jump over the singularity, depending on round-off errors.
  [[nodiscard]] double side() const { return parallel_determinant(manipulator_.geometry, pose()); }

  static constexpr const char* kSingularity =
      "a parallel (type 2) singularity was passed, where the actuator angles do not determine the "
      "motion; real rigid bodies could pass the singularity";

  void stop(Status status, const std::string& reason) {
    std::ostringstream why;
    why << "at " << t_ << " s: " << reason;
    result.outcome = {status, why.str()};
  }

  const RigidManipulator& manipulator_;
  const std::function<Vector3d(double)>& torque_;
  const Vector3d wrench_;
  const Index max_steps_;
  const double duration_;  // duration of the motion [s]
  ControlledStepper stepper_;
  double t_, h_;
  double start_energy_ = kNaN, energy_size_ = 0, largest_imbalance_ = 0;
  double last_work_ = 0, turnover_ = 0;
  double side_ = 0;  // determinant of the Jacobian matrix J_x at the start of the motion
  State y_, rate_;
};

}  // namespace

PlatformAcceleration forward_acceleration(const RigidManipulator& m, const Pose& pose,
                                          const Vector3d& velocity, const Vector3d& torque,
                                          const Vector3d& wrench) {
  const RigidTerms terms = rigid_terms(m, pose, velocity);
  PlatformAcceleration result{terms.outcome, Vector3d::Constant(kNaN), kNaN};
  if (!terms.outcome.solved()) return result;
  const Matrix3d G = terms.W.bottomRows<3>();
  const Vector3d rates = terms.q_dot.head<3>();
  const Vector3d force = torque + G.transpose() * wrench - terms.Ch * rates - terms.Nh;
  const Eigen::LLT<Matrix3d> llt(terms.Mh);
  if (llt.info() != Eigen::Success) {
    result.outcome = {Status::singular, "mass matrix of the actuator angles not positive definite"};
    return result;
  }
  const Vector3d active = llt.solve(force);
  result.power = torque.dot(rates) + wrench.dot(velocity);
  result.acceleration = G * active + terms.W_dot.bottomRows<3>() * rates;
  return result;
}

ForwardDynamics forward_dynamics(const RigidManipulator& m, const TrajectoryPoint& start,
                                 const std::function<Vector3d(double)>& torque,
                                 const std::vector<double>& times, const Vector3d& wrench,
                                 const ForwardOptions& options) {
  if (!(options.tolerance > 0)) throw ModelError("the integration tolerance must be positive");
  double last = start.time;
  for (const double t : times) {
    if (!(t >= last) || !std::isfinite(t))
      throw ModelError("the times of the motion must be ascending and not before its start");
    last = t;
  }
  MotionIntegrator integrator(m, torque, wrench, options, start, last);
  integrator.result.motion.reserve(times.size());
  for (const double t : times) {
    integrator.advance(t);
    if (!integrator.result.outcome.solved()) break;
    integrator.result.motion.push_back(integrator.point());
    integrator.add_evidence();
  }
  return integrator.finish();
}

}  // namespace trammel::solver
