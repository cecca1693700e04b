#include "solver/large/small_vibration.h"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "solver/large/static_path.h"
#include "solver/linear/modes.h"
#include "solver/linear/system.h"
#include "tests/support/solver/large_models.h"

BOOST_AUTO_TEST_SUITE(small_vibration)

namespace {

using namespace trammel::solver;
using namespace trammel::solver::large_motion;
using namespace trammel::testing;

/// The elastica (EI = L = 1) with mass, under an end force of that size along its axis, which
/// follows the tip or does not.
SmallVibration loaded_column(double force, bool follows) {
  Model model = elastica(8);
  LargeMotionModel large_motion;
  if (follows) {
    large_motion.follower_loads = {{1, {-force, 0, 0}}};
  } else {
    model.loads = {{1, {-force, 0, 0}}};
  }
  const GeometricallyExactSystem system(model, large_motion);
  StaticPathOptions options;
  options.keep_points = false;
  const StaticPath path = follow_static_path(system, options);
  BOOST_REQUIRE(path.outcome.solved());
  return large_motion::small_vibration(system, path.points.back().state, 4);
}

}  // namespace

BOOST_AUTO_TEST_CASE(about_the_unloaded_state_it_has_the_frequencies_of_linear_modes) {
  const Model model = elastica(8);
  const GeometricallyExactSystem system(model);
  const SmallVibration found = large_motion::small_vibration(system, system.reference_state(), 3);
  BOOST_REQUIRE(found.outcome.solved());
  const ModalSolution modes = solve_modes(assemble(elastica(32)), {3});
  for (Index i = 0; i < 3; ++i) {
    BOOST_TEST(std::abs(found.frequency[i] / modes.frequency[i] - 1) < 1e-5);
    BOOST_TEST(found.growth_rate[i] == 0);
  }
}

BOOST_AUTO_TEST_CASE(a_hanging_pendulum_swings_by_its_weight_alone) {
  Model model = simple_pendulum();
  model.nodes[1].position = {0, -1};
  const GeometricallyExactSystem system(model);
  State state = system.reference_state();
  system.set_load(state, 1);
  state.lambda << 0, -9.81;  // 1 kg hangs from the rod of 1 m
  const SmallVibration found = large_motion::small_vibration(system, state, 1);
  BOOST_REQUIRE(found.outcome.solved());
  // 1e-11 on the diagonal of the rod's rows, times 9.81 N/m, halved by the root.
  BOOST_TEST(found.frequency[0] == std::sqrt(9.81) / (2 * std::numbers::pi),
             boost::test_tools::tolerance(1e-10));
}

BOOST_AUTO_TEST_CASE(without_mass_nothing_vibrates) {
  Model model = elastica(4);
  for (Section* section : {&model.members[0].section, &model.members[0].end_section})
    section->mass_per_length = section->inertia_per_length = 0;
  const GeometricallyExactSystem system(model);
  const SmallVibration found = large_motion::small_vibration(system, system.reference_state(), 1);
  BOOST_TEST((found.outcome.status == Status::singular));
  BOOST_TEST(found.outcome.reason == "nothing vibrates, for nothing that moves has mass");
}

BOOST_AUTO_TEST_CASE(a_force_that_keeps_its_direction_buckles_and_one_that_follows_flutters) {
  const double euler = std::pow(std::numbers::pi / 2, 2);
  const SmallVibration dead = loaded_column(1.1 * euler, false);
  BOOST_TEST(dead.frequency[0] == 0);
  BOOST_TEST(dead.growth_rate[0] > 0);
  const SmallVibration below = loaded_column(19.9, true);
  BOOST_TEST(below.growth_rate.maxCoeff() == 0);
  const SmallVibration beyond = loaded_column(20.2, true);
  BOOST_TEST(beyond.growth_rate[0] > 0);
  BOOST_TEST(beyond.frequency[0] > 0);
  BOOST_TEST(std::abs(beyond.frequency[0] - beyond.frequency[1]) < 1e-9 * beyond.frequency[0]);
}

BOOST_AUTO_TEST_CASE(a_model_too_large_for_a_dense_matrix_is_refused) {
  const GeometricallyExactSystem system(elastica(60));
  BOOST_CHECK_THROW((void)large_motion::small_vibration(system, system.reference_state(), 1),
                    ModelError);
}

BOOST_AUTO_TEST_SUITE_END()
