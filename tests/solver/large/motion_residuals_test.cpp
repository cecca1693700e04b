#include <boost/test/unit_test.hpp>
#include <cmath>

#include "solver/large/consistent_initialization.h"
#include "solver/large/constrained_stepper.h"
#include "solver/large/integrate_large_motion.h"
#include "solver/large/state_results.h"
#include "solver/large/static_path.h"
#include "tests/support/solver/large_models.h"
#include "tests/support/solver/numerics.h"

BOOST_AUTO_TEST_SUITE(motion_residuals)

namespace {

using namespace trammel::solver;
using namespace trammel::solver::large_motion;
using namespace trammel::testing;
using boost::test_tools::tolerance;

/// Returns a damped mass of 1 kg on a rod of 1 m under a torque that varies with time.
GeometricallyExactSystem pendulum() {
  LargeMotionModel large_motion;
  large_motion.torques = {{"motor", 0, [](double t) { return 3 * std::sin(5 * t); }}};
  large_motion.mass_damping = 0.1;
  return GeometricallyExactSystem(simple_pendulum(), large_motion);
}

TransientOptions options_with_alpha(double end) {
  return transient_options(end, 0.01, generalized_alpha(0.9));
}

/// Integrates a motion of the pendulum, and changes its last state.
/// @returns the outcome of the residual checks of the changed state
Outcome outcome_after_change(const std::function<void(State&)>& change) {
  const GeometricallyExactSystem system = pendulum();
  State state;
  BOOST_TEST_REQUIRE(integrate(system, state, options_with_alpha(0.1)).outcome.solved());
  change(state);
  VectorXd force = VectorXd::Zero(system.coordinate_count());
  system.force_residual(state, force);
  MotionResiduals residuals(system);
  Evidence evidence;
  evidence.add(Residual::equation_of_motion, residuals.motion_residual(state, force));
  const ConstraintGaps gaps = residuals.largest_gaps(state);
  evidence.add(Residual::constraints, std::max(gaps.relative_position, 0.01 * gaps.relative_rate));
  return outcome_by_evidence({}, evidence, {Residual::equation_of_motion, Residual::constraints});
}

}  // namespace

BOOST_AUTO_TEST_CASE(wrong_states_of_a_motion_are_refused) {
  const Outcome found = outcome_after_change([](State&) {});
  BOOST_TEST(found.solved(), found.reason);
  const auto refused = [](const std::function<void(State&)>& change, const char* residual) {
    const Outcome outcome = outcome_after_change(change);
    BOOST_TEST(!outcome.solved());
    BOOST_TEST(outcome.reason.find(residual) != std::string::npos, outcome.reason);
  };
  refused([](State& s) { s.a.setZero(); }, "equation of motion");  // no inertia force
  refused([](State& s) { s.t -= 0.01; }, "equation of motion");    // force at another time
  refused([](State& s) { s.v = -s.v; }, "equation of motion");     // damping of the wrong sign
  refused([](State& s) { s.lambda *= 1 + 1e-3; }, "equation of motion");  // early termination
  refused([](State& s) { s.q.array() += 1e-8; }, "constraints");          // drift off the rod
  refused([](State& s) { s.v.array() += 1e-5; }, "constraints");
}

BOOST_AUTO_TEST_CASE(integration_reports_its_residuals) {
  const GeometricallyExactSystem system = pendulum();
  State state;
  const IntegrationSummary summary = integrate(system, state, options_with_alpha(1));
  BOOST_TEST(summary.outcome.solved(), summary.outcome.reason);
  BOOST_TEST(summary.evidence.largest(Residual::constraints) < 1e-13);
  BOOST_TEST(summary.evidence.largest(Residual::equation_of_motion) < 1e-12);
}

BOOST_AUTO_TEST_CASE(energy_balances_with_every_kind_of_work) {
  Model model = cantilever(unit_section(1e4), 1, 2);
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
  TransientOptions options = options_with_alpha(1);
  options.scheme.conserves_energy = true;
  const IntegrationSummary summary = integrate(system, state, options);
  BOOST_TEST(summary.outcome.solved(), summary.outcome.reason);
  BOOST_TEST(summary.evidence.largest(Residual::energy) < 1e-9);
}

BOOST_AUTO_TEST_CASE(wrong_member_forces_are_out_of_balance) {
  Model model = cantilever(unit_section(1e4), 1, 2);
  model.loads = {{1, {0, -1, 0}}};
  model.members[0].load = {0.3, 0.7};
  const GeometricallyExactSystem system(model);
  StaticPath path = follow_static_path(system);
  BOOST_TEST(path.outcome.solved(), path.outcome.reason);
  BOOST_TEST(path.evidence.largest(Residual::recovered_forces) < 1e-13);
  BOOST_TEST(path.evidence.largest(Residual::recovered_forces) > 0);  // round-off, thus computed
  State& state = path.points.back().state;
  const auto residual = [&] {
    MemberBalance balance;
    balance.add_state(system, state);
    return balance.residual();
  };
  state.lambda[0] *= 1 + 1e-6;
  BOOST_TEST(residual() > 1e-8);
  state.lambda[0] /= 1 + 1e-6;
  state.load *= 1 + 1e-6;
  BOOST_TEST(residual() > 1e-8);
}

BOOST_AUTO_TEST_CASE(motion_starts_with_velocity_and_acceleration_of_drive) {
  Model model;
  model.nodes = {{"A", {0, 0}}};
  model.supports = {pin(0)};
  model.masses = {{0, 2, 0.25, Vector2d::Zero()}};
  LargeMotionModel large_motion;
  large_motion.drives = {{"motor", 0, 2, [](double t) {
                            return std::array<double, 3>{1.5 * t * t, 3 * t, 3};
                          }}};
  const GeometricallyExactSystem system(model, large_motion);
  State state = system.reference_state();
  state.t = 0.2;
  BOOST_TEST_REQUIRE(make_consistent(system, state, {}, 1e-3).solved());
  BOOST_TEST(node_motion(system, state.q)(0, 2) == 0.06, tolerance(1e-12));
  BOOST_TEST(node_motion(system, state.v)(0, 2) == 0.6, tolerance(1e-12));
  BOOST_TEST(node_motion(system, state.a)(0, 2) == 3, tolerance(1e-6));  // by finite differences
}

BOOST_AUTO_TEST_SUITE_END()
