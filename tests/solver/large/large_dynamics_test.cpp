// ctest: timeout=300
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "solver/large/integrate_large_motion.h"
#include "solver/large/state_results.h"
#include "tests/support/solver/large_models.h"
#include "tests/support/solver/numerics.h"

BOOST_AUTO_TEST_SUITE(large_dynamics)

namespace {

using namespace trammel::solver;
using namespace trammel::solver::large_motion;
using namespace trammel::testing;
using boost::test_tools::tolerance;

enum class Integrator { generalized_alpha, energy_momentum };

TransientOptions options_with_integrator(Integrator integrator, double step, double end) {
  TransientOptions options = transient_options(end, step, generalized_alpha(0.9));
  options.scheme.conserves_energy = integrator == Integrator::energy_momentum;
  return options;
}

/// Integrates a motion, and requires that the integration succeeds.
State run(const GeometricallyExactSystem& system, const TransientOptions& options,
          IntegrationSummary* found = nullptr, const Observer& observe = {}) {
  State state;
  const IntegrationSummary summary = integrate(system, state, options, observe);
  BOOST_REQUIRE_MESSAGE(summary.outcome.solved(), summary.outcome.reason);
  if (found) *found = summary;
  return state;
}

/// Errors of the simple pendulum after 2 s: position [m], speed [m/s], force at the hinge [N]. The
/// exact position follows from elliptic functions. The exact speed and force follow from the
/// position by conservation of energy.
struct PendulumError {
  double place = 0, speed = 0, pull = 0, gap = 0, gap_rate = 0;
};

PendulumError pendulum_error(Integrator integrator, double step) {
  const Vector2d exact(-.793566195343322, -.608483930443792);
  const GeometricallyExactSystem system(simple_pendulum());
  const TransientOptions options = options_with_integrator(integrator, step, 2);
  IntegrationSummary summary;
  const State state = run(system, options, &summary);
  const Vector2d place =
      Vector2d(-1, 0) + node_motion(system, state.q).row(1).head<2>().transpose();
  const double speed = node_motion(system, state.v).row(1).head<2>().norm();
  const double pull = reactions(system, state).row(0).head<2>().norm();
  return {(place - exact).norm(), std::abs(speed - std::sqrt(2 * 9.81 * -exact.y())),
          std::abs(pull - 3 * 9.81 * -exact.y()), summary.constraints.position,
          summary.constraints.rate};
}

/// Returns the relative change of the total energy of a free vibration.
double energy_drift(Integrator integrator, double step, double end) {
  Model model = cantilever(unit_section(1e4), 1, 2);
  model.members[0].load = {0, 0};
  LargeMotionModel large_motion;
  large_motion.initial_velocities = {{1, 1, 2.0}};
  const GeometricallyExactSystem system(model, large_motion);
  const TransientOptions options = options_with_integrator(integrator, step, end);
  double first = 0;
  const auto look = [&](const State& s) {
    if (s.t == 0) first = system.energy(s).total();
  };
  const State state = run(system, options, nullptr, look);
  return system.energy(state).total() / first - 1;
}

}  // namespace

BOOST_AUTO_TEST_CASE(pendulum_converges_with_order_2_on_its_constraints) {
  for (const Integrator which : {Integrator::generalized_alpha, Integrator::energy_momentum}) {
    const PendulumError coarse = pendulum_error(which, 0.005), fine = pendulum_error(which, 0.0025);
    BOOST_TEST(observed_order(coarse.place, fine.place) == 2, tolerance(0.025));
    BOOST_TEST(observed_order(coarse.speed, fine.speed) == 2, tolerance(0.025));
    BOOST_TEST(observed_order(coarse.pull, fine.pull) == 2, tolerance(0.05));
    if (which == Integrator::energy_momentum) continue;
    BOOST_TEST(fine.gap < 1e-14);
    BOOST_TEST(fine.gap_rate < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(energy_momentum_conserves_and_alpha_loses_energy) {
  BOOST_TEST(std::abs(energy_drift(Integrator::energy_momentum, 1e-3, 5)) < 1e-10);
  const double lost = energy_drift(Integrator::generalized_alpha, 1e-3, 5);
  BOOST_TEST(lost < 1e-9);
  BOOST_TEST(lost > -0.05);
}

BOOST_AUTO_TEST_CASE(torque_law_turns_a_wheel_by_its_double_integral) {
  Model model;
  model.nodes = {{"A", Vector2d(0, 0)}};
  model.supports = {{"A", 0, {true, true, false}}};
  model.masses = {{0, 2, 0.25, Vector2d::Zero()}};
  LargeMotionModel large_motion;
  large_motion.torques = {{"motor", 0, [](double t) { return 3 * std::cos(2 * t); }}};
  const GeometricallyExactSystem system(model, large_motion);
  const double exact = 3 / 0.25 * (1 - std::cos(2 * 1.5)) / 4;
  for (const Integrator which : {Integrator::generalized_alpha, Integrator::energy_momentum}) {
    const auto error = [&](double step) {
      const State state = run(system, options_with_integrator(which, step, 1.5));
      return std::abs(node_motion(system, state.q)(0, 2) - exact);
    };
    BOOST_TEST(error(0.01) < 1e-3);
    BOOST_TEST(observed_order(error(0.01), error(0.005)) == 2, tolerance(0.025));
  }
}

/// The energy-momentum method computes the mean force of a rod in each step, and extrapolates the
/// force to the end of the step. In this test, a mass at rest is pulled outward by a force of t N.
/// The extrapolation is then exact, even for a last step of half length.
BOOST_AUTO_TEST_CASE(force_after_a_shorter_step_is_that_at_its_end) {
  Model model = simple_pendulum();
  model.gravity = {0, 0};
  LargeMotionModel large_motion;
  large_motion.follower_loads = {{1, {-1, 0, 0}}};
  large_motion.load_history = [](double t) { return t; };
  const GeometricallyExactSystem system(model, large_motion);
  for (const Integrator which : {Integrator::generalized_alpha, Integrator::energy_momentum}) {
    TransientOptions options = options_with_integrator(which, 0.1, 0.95);
    options.sample_times = {0.9, 0.95};
    BOOST_TEST(reactions(system, run(system, options))(0, 0) == 0.95, tolerance(1e-12));
  }
}

BOOST_AUTO_TEST_CASE(too_many_steps_are_refused_with_their_time) {
  const GeometricallyExactSystem system(simple_pendulum());
  TransientOptions options = options_with_integrator(Integrator::generalized_alpha, 1e-3, 1);
  options.max_steps = 10;
  State state;
  const IntegrationSummary summary = integrate(system, state, options);
  BOOST_TEST((summary.outcome.status == Status::not_converged));
  BOOST_TEST(summary.outcome.reason.find("step 11 at time 0.01 s") != std::string::npos,
             summary.outcome.reason);
}

BOOST_AUTO_TEST_SUITE_END()
