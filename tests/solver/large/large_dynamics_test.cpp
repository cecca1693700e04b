// ctest: timeout=300
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "solver/large/integrate_large_motion.h"
#include "solver/large/state_results.h"
#include "tests/support/solver/large_models.h"

BOOST_AUTO_TEST_SUITE(large_dynamics)

namespace {

using namespace trammel::solver;
using namespace trammel::solver::large_motion;
using namespace trammel::testing;

constexpr double kPi = std::numbers::pi;

enum class Integrator { generalized_alpha, energy_momentum };

TransientOptions options_of(Integrator integrator, double step, double end) {
  TransientOptions options;
  options.scheme = generalized_alpha(0.9);
  options.scheme.conserves_energy = integrator == Integrator::energy_momentum;
  options.step = step;
  options.end = end;
  return options;
}

/// Integrates a system to a time; the summary must say that it went well.
State run(const GeometricallyExactSystem& system, const TransientOptions& options,
          IntegrationSummary* found = nullptr, const Observer& observe = {}) {
  State state;
  const IntegrationSummary summary = integrate(system, state, options, observe);
  BOOST_REQUIRE_MESSAGE(summary.outcome.solved(), summary.outcome.reason);
  if (found) *found = summary;
  return state;
}

/// What the simple pendulum gets wrong after 2 s: place [m], speed [m/s], force at the hinge [N].
/// The place is that of the elliptic functions; speed and force follow from it by energy.
struct PendulumError {
  double place = 0, speed = 0, pull = 0, gap = 0, gap_rate = 0;
};

PendulumError pendulum_error(Integrator integrator, double step) {
  const Vector2d exact(-.793566195343322, -.608483930443792);
  const GeometricallyExactSystem system(simple_pendulum());
  const TransientOptions options = options_of(integrator, step, 2);
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

double order(double coarse, double fine) {
  return std::log2(coarse / fine);
}

/// Largest error of the angles of Andrews' mechanism at 0.03 s, over their size.
double andrews_error(double step) {
  // Reference solution of the IVP test set.
  const AndrewsAngles exact{15.81077119629904,  -15.75637105984298, .04082224013073101,
                            -.5347301163226948, .5244099658805304,  .5347301163226948,
                            1.048080741042263};
  const Andrews a = andrews_mechanism();
  const GeometricallyExactSystem system(a.model, a.large_motion);
  TransientOptions options = options_of(Integrator::generalized_alpha, step, .03);
  options.sample_times = {0, .03};
  State state;
  const IntegrationSummary summary = integrate_extrapolated(system, state, options);
  BOOST_REQUIRE_MESSAGE(summary.outcome.solved(), summary.outcome.reason);
  const AndrewsAngles found = a.angles(node_motion(system, state.q));
  double worst = 0;
  for (std::size_t i = 0; i < 7; ++i) {
    worst = std::max(worst, std::abs((found[i] + a.start[i]) / exact[i] - 1));
  }
  return worst;
}

/// Total energy after some time of free vibration over what it was, minus 1.
double energy_drift(Integrator integrator, double step, double end) {
  Model model = cantilever(unit_section(1e4), 1, 2);
  model.members[0].load = {0, 0};
  LargeMotionModel large_motion;
  large_motion.initial_velocities = {{1, 1, 2.0}};
  const GeometricallyExactSystem system(model, large_motion);
  const TransientOptions options = options_of(integrator, step, end);
  double first = 0;
  const auto look = [&](const State& s) {
    if (s.t == 0) first = system.energy(s).total();
  };
  const State state = run(system, options, nullptr, look);
  return system.energy(state).total() / first - 1;
}

}  // namespace

BOOST_AUTO_TEST_CASE(places_velocities_and_multipliers_of_a_pendulum_converge_with_order_2) {
  for (const Integrator which : {Integrator::generalized_alpha, Integrator::energy_momentum}) {
    const PendulumError coarse = pendulum_error(which, 0.005), fine = pendulum_error(which, 0.0025);
    BOOST_TEST(std::abs(order(coarse.place, fine.place) - 2) < 0.05);
    BOOST_TEST(std::abs(order(coarse.speed, fine.speed) - 2) < 0.05);
    BOOST_TEST(std::abs(order(coarse.pull, fine.pull) - 2) < 0.1);
  }
}

BOOST_AUTO_TEST_CASE(generalized_alpha_keeps_positions_and_velocities_on_the_constraints) {
  const PendulumError error = pendulum_error(Integrator::generalized_alpha, 0.01);
  BOOST_TEST(error.gap < 1e-14);
  BOOST_TEST(error.gap_rate < 1e-12);
}

BOOST_AUTO_TEST_CASE(tiny_steps_do_not_blow_up_the_multipliers) {
  // Round-off in a multiplier is eps / h; the error of the method, 0.4 h^2 N, falls first.
  for (const double step : {1e-4, 1e-5}) {
    const PendulumError error = pendulum_error(Integrator::generalized_alpha, step);
    BOOST_TEST(error.pull < 500 * step * step + 1e-14 / step);
    BOOST_TEST(error.gap < 1e-14);
    BOOST_TEST(error.gap_rate < 1e-13);
  }
}

BOOST_AUTO_TEST_CASE(four_bars_in_a_row_pass_their_singular_positions_again_and_again) {
  // All links are in line twice a turn. At the start, upright with 1 m/s, three cranks hold 1/6 J
  // and two couplers 1/2 J each: 1.5 J.
  for (const Integrator which : {Integrator::generalized_alpha, Integrator::energy_momentum}) {
    const auto [model, large_motion] = four_bar_chain(2);
    const GeometricallyExactSystem system(model, large_motion);
    const State state = run(system, options_of(which, 2e-3, 10));
    const Eigen::MatrixX3d motion = node_motion(system, state.q);
    BOOST_TEST(std::abs(system.energy(state).total() - 1.5) < 1e-4);
    // A parallelogram it stays: both cranks have turned alike.
    BOOST_TEST(std::abs(motion(0, 2) - motion(2, 2)) < 1e-10);
    BOOST_TEST(std::abs(motion(0, 2)) > 2 * kPi);
  }
}

BOOST_AUTO_TEST_CASE(andrews_squeezing_mechanism_agrees_to_eight_digits) {
  BOOST_TEST(andrews_error(1e-5) < 1e-8);
}

BOOST_AUTO_TEST_CASE(a_torque_with_a_law_turns_a_wheel_by_its_double_integral) {
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
      const State state = run(system, options_of(which, step, 1.5));
      return std::abs(node_motion(system, state.q)(0, 2) - exact);
    };
    BOOST_TEST(error(0.01) < 1e-3);
    BOOST_TEST(std::abs(order(error(0.01), error(0.005)) - 2) < 0.05);
  }
}

BOOST_AUTO_TEST_CASE(a_spun_up_beam_bends_as_the_recomputed_history_of_vm258_says) {
  // Tip at 7.5 s in the hub's axes, by 8 quadratic Reissner elements and steps of 1 ms, to four
  // digits: -1.7742e-2 m, -0.559087 m, -4.28453 degrees.
  const auto [model, large_motion] = spin_up(4);
  const GeometricallyExactSystem system(model, large_motion);
  const TransientOptions options = options_of(Integrator::generalized_alpha, 5e-3, 7.5);
  State state;
  const IntegrationSummary summary = integrate_extrapolated(system, state, options);
  BOOST_REQUIRE_MESSAGE(summary.outcome.solved(), summary.outcome.reason);
  const Eigen::RowVector3d tip = node_motion(system, state.q).row(1);
  const double hub = large_motion.drives[0].law(7.5)[0];
  const double c = std::cos(hub), s = std::sin(hub), x = 10 + tip[0], y = tip[1];
  BOOST_TEST(std::abs(x * c + y * s - 10 + 1.7742e-2) < 3e-6);
  BOOST_TEST(std::abs(y * c - x * s + 0.559087) < 3e-5);
  BOOST_TEST(std::abs((tip[2] - hub) * 180 / kPi + 4.28453) < 3e-4);
}

BOOST_AUTO_TEST_CASE(energy_momentum_keeps_the_energy_of_a_whirling_beam) {
  BOOST_TEST(std::abs(energy_drift(Integrator::energy_momentum, 1e-3, 5)) < 1e-10);
}

BOOST_AUTO_TEST_CASE(generalized_alpha_only_takes_energy_away) {
  const double lost = energy_drift(Integrator::generalized_alpha, 1e-3, 5);
  BOOST_TEST(lost < 1e-9);
  BOOST_TEST(lost > -0.05);
}

BOOST_AUTO_TEST_CASE(adaptive_steps_keep_the_error_asked_for) {
  const GeometricallyExactSystem system(simple_pendulum());
  const Vector2d exact(-.793566195343322, -.608483930443792);
  double last = 1;
  for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
    TransientOptions options = options_of(Integrator::generalized_alpha, 1e-3, 2);
    options.adaptive = {.relative = tolerance};
    IntegrationSummary summary;
    const State state = run(system, options, &summary);
    const Vector2d place =
        Vector2d(-1, 0) + node_motion(system, state.q).row(1).head<2>().transpose();
    const double error = (place - exact).norm();
    // Global error over local: tolerance^(2/3), as a hundred times the tolerance gives 21.5.
    BOOST_TEST(error < 0.1 * last);
    last = error;
  }
}

BOOST_AUTO_TEST_CASE(a_motion_that_asks_for_too_many_steps_says_when_it_stopped) {
  const GeometricallyExactSystem system(simple_pendulum());
  TransientOptions options = options_of(Integrator::generalized_alpha, 1e-3, 1);
  options.max_steps = 10;
  State state;
  const IntegrationSummary summary = integrate(system, state, options);
  BOOST_TEST((summary.outcome.status == Status::not_converged));
  BOOST_TEST(summary.outcome.reason.find("step 11 at time 0.01 s") != std::string::npos,
             summary.outcome.reason);
}

BOOST_AUTO_TEST_SUITE_END()
