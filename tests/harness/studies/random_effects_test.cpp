#include <boost/test/unit_test.hpp>

#include "harness/studies/effect_study.h"
#include "harness/studies/random_scenes.h"

using namespace trammel::references;
using namespace trammel::solver;
using namespace trammel::harness;

BOOST_AUTO_TEST_SUITE(random_effects)

BOOST_AUTO_TEST_CASE(a_random_scene_is_the_same_every_time) {
  BOOST_TEST(random_scene(1, 7).value() == random_scene(1, 7).value());
  BOOST_TEST(random_scene(1, 7).value() != random_scene(1, 8).value());
  BOOST_TEST(random_scene(1, 7).value() != random_scene(2, 7).value());
}

/// Of 100 scenes, near buckling loads and singularities and in motion too, automatic effects are
/// within the tolerance of the whole scene, and in 90 % none of them could be left out. Of motions,
/// whose estimates add up as bounds, one in four has some that could.
BOOST_AUTO_TEST_CASE(automatic_effects_hold_and_are_minimal_on_random_scenes) {
  constexpr int kScenes = 100;
  int minimal = 0, solved = 0;
  for (int n = 0; n < kScenes; ++n) {
    const EffectStudy study = study_effects(random_scene(1, n), {0.01, false, 0});
    if (!study.full.outcome.solved()) continue;
    ++solved;
    BOOST_TEST(study.within_tolerance(), "scene " << n);
    minimal += study.is_minimal() ? 1 : 0;
  }
  BOOST_TEST(solved >= 0.95 * kScenes);
  BOOST_TEST(minimal >= 0.9 * solved);
}

BOOST_AUTO_TEST_SUITE_END()
