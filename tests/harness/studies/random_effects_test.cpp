#include <boost/test/unit_test.hpp>
#include <cstdlib>
#include <fstream>

#include "harness/input/case.h"
#include "harness/studies/effect_study.h"
#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(random_effects)

using namespace trammel::references;
using namespace trammel::solver;
using namespace trammel::harness;

namespace {

/// The scenes of random_scenes.py.
std::vector<Document> random_scenes(int seed, const std::string& numbers) {
  const trammel::testing::Folder folder;
  const std::string path = folder.path().string();
  const std::string program = TRAMMEL_SOURCE_DIR "/tests/harness/studies/random_scenes.py";
  BOOST_REQUIRE(std::system(("python3 " + program + " " + path + " --seed " + std::to_string(seed) +
                             " --scenes " + numbers + " > " + path + "/files")
                                .c_str()) == 0);
  std::vector<Document> scenes;
  std::ifstream files(folder.path() / "files");
  for (std::string file; std::getline(files, file);)
    scenes.push_back(patched(load_case(file), kBaseVariant));
  return scenes;
}

EffectStudy study_of(const Document& scene) {
  return study_effects(scene, {0.01, false, 0});
}

EffectStudy study_of(int seed, int number) {
  return study_of(random_scenes(seed, std::to_string(number)).front());
}

}  // namespace

/// By symmetry linear theory turned nothing; second-order theory, which stood for large
/// displacement at the poses between, was off by 14 %.
BOOST_AUTO_TEST_CASE(large_displacement_near_a_singularity_is_measured_at_every_pose) {
  const EffectStudy study = study_of(1, 231);
  BOOST_TEST(study.within_tolerance());
  BOOST_TEST(study.choice.chosen.has(Effect::large_displacement));
}

/// It took 3.5 to 7 times the whole when every effect was left out along the whole band, the peaks
/// searched each time.
BOOST_AUTO_TEST_CASE(harmonic_decisions_take_a_few_frequencies) {
  const EffectStudy study = study_of(1, 98);
  BOOST_TEST(study.within_tolerance());
  BOOST_TEST(study.choice.counters.factorizations < 0.3 * study.full.counters.factorizations);
}

/// On a platform of three triangles the resonance beside which the response was largest lay
/// elsewhere: 0.24 % was decided by, 3.3 % it was.
BOOST_AUTO_TEST_CASE(what_is_beside_a_resonance_is_decided_on_the_scenes_own_mesh) {
  BOOST_TEST(study_of(3, 188).within_tolerance());
}

/// Linear theory off by all of a tie's deflection passed for beyond buckling, and two elements'
/// second-order theory for what large displacement is worth.
BOOST_AUTO_TEST_CASE(second_order_theory_is_enough_for_columns_below_their_buckling_load) {
  for (const int number : {1, 10, 41, 72, 90}) {
    const EffectStudy study = study_of(2, number);
    BOOST_TEST(study.within_tolerance(), "scene " << number);
    BOOST_TEST(!study.choice.chosen.has(Effect::large_displacement), "scene " << number);
  }
}

/// A load that sets in at once sets every mode vibrating, where estimates knew the first: forces
/// were off by 33 times the tolerance without a stiff joint, by 2.4 without rotary inertia, and by
/// ten without the flexibility of a light platform.
BOOST_AUTO_TEST_CASE(estimates_of_a_sudden_start_know_its_modes) {
  for (const auto& [seed, number] : {std::pair(1, 139), std::pair(2, 19), std::pair(2, 69)}) {
    const EffectStudy study = study_of(seed, number);
    BOOST_TEST(study.within_tolerance(), "scene " << seed << ", " << number);
  }
}

/// It took twice the whole scene, which it ran, to save a fifth of it. What costs there is to
/// evaluate and factor in the geometrically exact tier; in the third scene nothing can be saved.
BOOST_AUTO_TEST_CASE(deciding_for_a_motion_takes_no_step_of_the_whole) {
  for (const int number : {29, 89, 169}) {
    const EffectStudy study = study_of(2, number);
    BOOST_TEST(study.within_tolerance(), "scene " << number);
    const Counters &deciding = study.choice.counters, &whole = study.full.counters;
    BOOST_TEST(deciding.element_evaluations < 0.2 * whole.element_evaluations, "scene " << number);
    if (number == 169) BOOST_TEST(deciding.factorizations < 0.2 * whole.factorizations);
  }
}

/// Of 100 scenes, near buckling loads and singularities and in motion too, automatic effects are
/// within the tolerance of the whole scene, and in 90 % none of them could be left out.
BOOST_AUTO_TEST_CASE(automatic_effects_hold_and_are_minimal_on_random_scenes) {
  int minimal = 0, solved = 0;
  const std::vector<Document> scenes = random_scenes(1, "$(seq 0 99)");
  BOOST_REQUIRE(scenes.size() == 100U);
  for (const Document& scene : scenes) {
    const EffectStudy study = study_of(scene);
    if (!study.full.outcome.solved()) continue;
    ++solved;
    BOOST_TEST(study.within_tolerance(), scene.value().at("id"));
    minimal += study.is_minimal() ? 1 : 0;
  }
  BOOST_TEST(solved >= 95);
  BOOST_TEST(minimal >= 0.9 * solved);
}

/// Springs so soft that the manipulator leaves its path: what linear theory estimates of the other
/// effects means nothing there.
BOOST_AUTO_TEST_CASE(all_effects_stay_where_linear_theory_is_lost) {
  const EffectStudy study = study_of(3, 179);
  BOOST_TEST_REQUIRE(study.full.outcome.solved(), study.full.outcome.reason);
  for (const EffectReason& one : study.choice.reasons)
    if (one.effect != Effect::gyroscopic) BOOST_TEST(one.active == one.applicable, one.why);
}

BOOST_AUTO_TEST_SUITE_END()
