// ctest: labels=slow timeout=600
#include <boost/test/unit_test.hpp>

#include "harness/studies/effect_study.h"
#include "harness/studies/random_scenes.h"

using namespace trammel::references;
using namespace trammel::solver;
using namespace trammel::harness;

BOOST_AUTO_TEST_SUITE(random_motions)

/// In motion the estimates of several effects add up as bounds, so that what is kept errs on the
/// safe side: within the tolerance in 99 %, minimal in three of four scenes.
BOOST_AUTO_TEST_CASE(automatic_effects_hold_in_motion) {
  constexpr std::uint64_t kScenes = 200;
  std::uint64_t within = 0, minimal = 0;
  for (std::uint64_t n = 0; n < kScenes; ++n) {
    const EffectStudy study = study_effects(random_motion(1, n), {0.01, false, 0});
    BOOST_TEST_REQUIRE(study.full.outcome.solved(), "scene " << n);
    within += study.within_tolerance() ? 1 : 0;
    minimal += study.is_minimal() ? 1 : 0;
  }
  BOOST_TEST_MESSAGE(within << " within, " << minimal << " minimal of " << kScenes);
  BOOST_TEST(100 * within >= 99 * kScenes);
  BOOST_TEST(100 * minimal >= 75 * kScenes);
}

BOOST_AUTO_TEST_SUITE_END()
