#include <boost/test/unit_test.hpp>
#include <cmath>

#include "solver/large/constrained_stepper.h"
#include "solver/large/integrate_large_motion.h"
#include "solver/large/state_results.h"
#include "solver/large/static_path.h"
#include "tests/support/solver/callable_system.h"
#include "tests/support/solver/large_models.h"

BOOST_AUTO_TEST_SUITE(motion_residuals)

namespace {

using namespace trammel::solver;
using namespace trammel::solver::large_motion;
using trammel::testing::CallableSystem;

/// A mass of 2 kg on a rod of 1 m, its weight and a force that changes with time.
CallableSystem pendulum() {
  return CallableSystem(
      {.coordinates = 2,
       .constraints = 1,
       .mass = [](const VectorXd&) -> Eigen::MatrixXd { return 2 * Eigen::Matrix2d::Identity(); },
       .force = [](double t, const VectorXd&, const VectorXd& v) -> VectorXd {
         return Eigen::Vector2d(3 * std::sin(5 * t), -19.62) - 0.1 * v;
       },
       .constraint_residual = [](double, const VectorXd& q) -> VectorXd {
         return VectorXd::Constant(1, (q.squaredNorm() - 1) / 2);
       },
       .jacobian = [](double, const VectorXd& q) -> Eigen::MatrixXd { return q.transpose(); },
       .constraint_time_derivative = {},
       .scale = Eigen::Vector2d(1, 1)});
}

/// Let go at rest, aside and below.
State start_of(const CallableSystem& system) {
  State state;
  state.q = Eigen::Vector2d(0.6, -0.8);
  state.v = state.a = Eigen::Vector2d::Zero();
  state.lambda = VectorXd::Zero(1);
  BOOST_TEST_REQUIRE(make_consistent(system, state, {}, 0.01).solved());
  return state;
}

TransientOptions options_to(double end) {
  TransientOptions options;
  options.end = end;
  options.step = 0.01;
  options.scheme = generalized_alpha(0.9);
  return options;
}

/// The outcome of ten steps whose last state is claimed to be another.
Outcome outcome_of(const std::function<void(State&)>& change) {
  const CallableSystem system = pendulum();
  State state = start_of(system);
  BOOST_TEST_REQUIRE(integrate(system, state, options_to(0.1)).outcome.solved());
  change(state);
  VectorXd force = VectorXd::Zero(2);
  system.force_residual(state, force);
  MotionResiduals residuals(system);
  Evidence evidence;
  evidence.add(Residual::equation_of_motion, residuals.equation_of_motion(state, force));
  const ConstraintGaps gaps = residuals.constraints(state);
  evidence.add(Residual::constraints, std::max(gaps.relative_position, 0.01 * gaps.relative_rate));
  return outcome_by_evidence({}, evidence, {Residual::equation_of_motion, Residual::constraints});
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_motion_that_was_found_is_solved_and_changed_ones_are_not) {
  const Outcome found = outcome_of([](State&) {});
  BOOST_TEST(found.solved(), found.reason);
  const auto refused = [](const std::function<void(State&)>& change, const char* residual) {
    const Outcome outcome = outcome_of(change);
    BOOST_TEST(!outcome.solved());
    BOOST_TEST(outcome.reason.find(residual) != std::string::npos, outcome.reason);
  };
  refused([](State& s) { s.a.setZero(); }, "equation of motion");         // no inertia
  refused([](State& s) { s.t -= 0.01; }, "equation of motion");           // a stale force
  refused([](State& s) { s.v = -s.v; }, "equation of motion");            // damping of wrong sign
  refused([](State& s) { s.lambda *= 1 + 1e-3; }, "equation of motion");  // an early stop
  refused([](State& s) { s.q += 1e-8 * s.q; }, "constraints");            // drift off the rod
  refused([](State& s) { s.v += 1e-5 * s.q; }, "constraints");
}

BOOST_AUTO_TEST_CASE(an_integration_shows_its_residuals) {
  const CallableSystem system = pendulum();
  State state = start_of(system);
  const IntegrationSummary summary = integrate(system, state, options_to(1));
  BOOST_TEST(summary.outcome.solved(), summary.outcome.reason);
  BOOST_TEST(summary.evidence.largest(Residual::constraints) < 1e-13);
  BOOST_TEST(summary.evidence.largest(Residual::equation_of_motion) < 1e-12);
}

BOOST_AUTO_TEST_CASE(work_and_energy_balance_to_rounding_with_every_kind_of_work) {
  Model model = trammel::testing::cantilever(trammel::testing::unit_section(1e4), 1, 2);
  model.gravity = {1, -9.81};
  model.loads = {{1, {20, -5, 0}}};
  LargeMotionModel large_motion;
  large_motion.initial_velocities = {{1, 1, 2.0}};
  large_motion.follower_loads = {{1, {0, 30, 4}}};
  large_motion.load_history = [](double t) { return std::sin(9 * t); };
  large_motion.torques = {{"motor", 1, [](double t) { return 40 * std::sin(5 * t); }}};
  large_motion.mass_damping = 0.4;
  large_motion.strain_rate_damping = 1e-3;
  large_motion.drives = {
      {"motor", 1, 0, [](double t) -> std::array<double, 3> {
         return {-0.01 * (1 - std::cos(7 * t)), -0.07 * std::sin(7 * t), -0.49 * std::cos(7 * t)};
       }}};
  const GeometricallyExactSystem system(model, large_motion);
  State state;
  TransientOptions options = options_to(1);
  options.scheme.conserves_energy = true;
  const IntegrationSummary summary = integrate(system, state, options);
  BOOST_TEST(summary.outcome.solved(), summary.outcome.reason);
  BOOST_TEST(summary.evidence.largest(Residual::energy) < 1e-9);
}

BOOST_AUTO_TEST_CASE(a_member_cut_free_is_in_equilibrium_only_under_forces_recovered_rightly) {
  Model model = trammel::testing::cantilever(trammel::testing::unit_section(1e4), 1, 2);
  model.loads = {{1, {0, -1, 0}}};
  model.members[0].load = {0.3, 0.7};
  const GeometricallyExactSystem system(model);
  StaticPath path = follow_static_path(system);
  BOOST_TEST(path.outcome.solved(), path.outcome.reason);
  BOOST_TEST(path.evidence.largest(Residual::recovered_forces) < 1e-13);
  BOOST_TEST(path.evidence.largest(Residual::recovered_forces) > 0);  // rounding: it is taken
  State& state = path.points.back().state;
  const auto residual = [&] {
    MemberBalance balance;
    balance.add(system, state);
    return balance.residual();
  };
  state.lambda[0] *= 1 + 1e-6;
  BOOST_TEST(residual() > 1e-8);
  state.lambda[0] /= 1 + 1e-6;
  state.load *= 1 + 1e-6;
  BOOST_TEST(residual() > 1e-8);
}

BOOST_AUTO_TEST_SUITE_END()
