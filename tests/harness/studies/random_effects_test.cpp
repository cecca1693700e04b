#include <boost/test/unit_test.hpp>

#include "harness/studies/effect_study.h"
#include "harness/studies/random_scenes.h"

BOOST_AUTO_TEST_SUITE(random_effects)

using namespace trammel::references;
using namespace trammel::solver;
using namespace trammel::harness;

BOOST_AUTO_TEST_CASE(a_random_scene_is_the_same_every_time) {
  BOOST_TEST(random_scene(1, 7).value() == random_scene(1, 7).value());
  BOOST_TEST(random_scene(1, 7).value() != random_scene(1, 8).value());
  BOOST_TEST(random_scene(1, 7).value() != random_scene(2, 7).value());
}

/// By symmetry linear theory turned nothing; second-order theory, which stood for large
/// displacement at the poses between, was off by 14 %.
BOOST_AUTO_TEST_CASE(large_displacement_near_a_singularity_is_measured_at_every_pose) {
  const EffectStudy study = study_effects(random_scene(1, 231), {0.01, false, 0});
  BOOST_TEST(study.within_tolerance());
  BOOST_TEST(study.choice.chosen.has(Effect::large_displacement));
}

/// It took 3.5 to 7 times the whole when every effect was left out along the whole band, the peaks
/// searched each time.
BOOST_AUTO_TEST_CASE(harmonic_decisions_take_a_few_frequencies) {
  const EffectStudy study = study_effects(random_scene(1, 98), {0.01, false, 0});
  BOOST_TEST(study.within_tolerance());
  BOOST_TEST(study.choice.counters.factorizations < 0.3 * study.full.counters.factorizations);
}

/// On a platform of three triangles the resonance beside which the response was largest lay
/// elsewhere: 0.24 % was decided by, 3.3 % it was.
BOOST_AUTO_TEST_CASE(what_is_beside_a_resonance_is_decided_on_the_scenes_own_mesh) {
  BOOST_TEST(study_effects(random_scene(3, 188), {0.01, false, 0}).within_tolerance());
}

/// Linear theory off by all of a tie's deflection passed for beyond buckling, and two elements'
/// second-order theory for what large displacement is worth.
BOOST_AUTO_TEST_CASE(second_order_theory_is_enough_for_columns_below_their_buckling_load) {
  for (const int number : {1, 10, 41, 72, 90}) {
    const EffectStudy study = study_effects(random_scene(2, number), {0.01, false, 0});
    BOOST_TEST(study.within_tolerance(), "scene " << number);
    BOOST_TEST(!study.choice.chosen.has(Effect::large_displacement), "scene " << number);
  }
}

/// A load that sets in at once sets every mode vibrating, where estimates knew the first: forces
/// were off by 33 times the tolerance without a stiff joint, by 2.4 without rotary inertia, and by
/// ten without the flexibility of a light platform.
BOOST_AUTO_TEST_CASE(estimates_of_a_sudden_start_know_its_modes) {
  for (const auto& [seed, number] : {std::pair(1, 139), std::pair(2, 19), std::pair(2, 69)}) {
    const EffectStudy study = study_effects(random_scene(seed, number), {0.01, false, 0});
    BOOST_TEST(study.within_tolerance(), "scene " << seed << ", " << number);
  }
}

/// It took twice the whole scene, which it ran, to save a fifth of it. What costs there is to
/// evaluate and factor in the geometrically exact tier; in the third scene nothing can be saved.
BOOST_AUTO_TEST_CASE(deciding_for_a_motion_takes_no_step_of_the_whole) {
  for (const int number : {29, 89, 169}) {
    const EffectStudy study = study_effects(random_scene(2, number), {0.01, false, 0});
    BOOST_TEST(study.within_tolerance(), "scene " << number);
    const Counters &deciding = study.choice.counters, &whole = study.full.counters;
    BOOST_TEST(deciding.element_evaluations < 0.2 * whole.element_evaluations, "scene " << number);
    if (number == 169) BOOST_TEST(deciding.factorizations < 0.2 * whole.factorizations);
  }
}

/// Of 100 scenes, near buckling loads and singularities and in motion too, automatic effects are
/// within the tolerance of the whole scene, and in 90 % none of them could be left out.
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
