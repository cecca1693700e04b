#include "solver/large/small_vibration.h"

#include <boost/test/unit_test.hpp>

#include "solver/linear/modes.h"
#include "solver/linear/system.h"
#include "tests/support/solver/large_models.h"

BOOST_AUTO_TEST_SUITE(small_vibration)

using namespace trammel::solver;
using namespace trammel::solver::large_motion;
using namespace trammel::testing;
using boost::test_tools::tolerance;

BOOST_AUTO_TEST_CASE(unloaded_state_has_the_frequencies_of_linear_modes) {
  const Model model = elastica(8);
  const GeometricallyExactSystem system(model);
  const SmallVibration found = large_motion::small_vibration(system, system.reference_state(), 3);
  BOOST_REQUIRE(found.outcome.solved());
  const ModalSolution modes = solve_modes(assemble(elastica(32)), {3});
  for (Index i = 0; i < 3; ++i) {
    BOOST_TEST(found.frequency[i] == modes.frequency[i], tolerance(1e-5));
    BOOST_TEST(found.growth_rate[i] == 0);
  }
}

BOOST_AUTO_TEST_CASE(model_without_mass_is_refused) {
  Model model = elastica(4);
  for (Section* section : {&model.members[0].section, &model.members[0].end_section})
    section->mass_per_length = section->inertia_per_length = 0;
  const GeometricallyExactSystem system(model);
  const SmallVibration found = large_motion::small_vibration(system, system.reference_state(), 1);
  BOOST_TEST((found.outcome.status == Status::singular));
  BOOST_TEST(found.outcome.reason == "nothing vibrates: no movable coordinate has a mass");
}

BOOST_AUTO_TEST_CASE(model_too_large_for_a_dense_matrix_is_refused) {
  const GeometricallyExactSystem system(elastica(60));
  BOOST_CHECK_THROW((void)large_motion::small_vibration(system, system.reference_state(), 1),
                    ModelError);
}

BOOST_AUTO_TEST_SUITE_END()
