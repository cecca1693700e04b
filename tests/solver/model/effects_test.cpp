#include "solver/model/effects.h"

#include <boost/test/unit_test.hpp>

#include "solver/linear/system.h"
#include "solver/linear/validate.h"
#include "tests/support/solver/frames.h"

BOOST_AUTO_TEST_SUITE(effects)

using namespace trammel;
using namespace trammel::solver;

namespace {

constexpr double kLength = 0.5, kDepth = 0.1, kWidth = 0.05;
const Material kMaterial{7e10, 2700, 0.33};

Section stubby() {
  return testing::rectangle(kMaterial, kDepth, kWidth);
}

Model sprung_cantilever() {
  Model model = testing::cantilever(stubby(), kLength, 2);
  model.members[0].theory = BeamTheory::timoshenko;
  model.members[0].ends[0] = {EndFixity::sprung, 1e5, 0};
  model.loads = {{1, {300, 1000, 0}}};
  model.gravity = {0, -9.81};
  return model;
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_effect_has_its_own_name) {
  for (const Effect effect : Effects::all().list())
    BOOST_TEST((find_effect(name_of(effect)) == effect));
  BOOST_TEST(Effects::all().list().size() == kEffectCount);
  BOOST_TEST(!find_effect("friction"));
}

BOOST_AUTO_TEST_CASE(inactive_effect_has_no_matrix_and_no_evaluation) {
  const Model model = sprung_cantilever();
  const Effects all = applicable_effects(model).with(Effect::inertia);
  const System whole = assemble(model, all);
  for (const Effect effect : all.list()) {
    BOOST_TEST_CONTEXT(name_of(effect)) {
      BOOST_TEST(whole.counters.evaluations(effect) > 0);
      const System without = assemble(model, all.without(effect));
      BOOST_TEST(without.counters.evaluations(effect) == 0);
    }
  }
  BOOST_TEST(assemble(model, all.without(Effect::inertia)).M.size() == 0);
  // Without axial flexibility, two elements become inextensible. Without joint compliance, one
  // sprung member end becomes welded. The number of free coordinates decreases.
  BOOST_TEST(assemble(model, all.without(Effect::axial_flexibility)).K.rows() ==
             whole.K.rows() - 2);
  BOOST_TEST(assemble(model, all.without(Effect::joint_compliance)).K.rows() == whole.K.rows() - 1);
}

BOOST_AUTO_TEST_CASE(applicable_effects_follow_the_parts_of_a_model) {
  const Model model = sprung_cantilever();
  Effects bare = applicable_effects(testing::cantilever(stubby(), kLength, 1));
  BOOST_TEST((bare == Effects().with(Effect::axial_flexibility).with(Effect::link_mass)));
  BOOST_TEST(applicable_effects(model).has(Effect::shear));
  BOOST_TEST(applicable_effects(model).has(Effect::joint_compliance));
  BOOST_TEST(applicable_effects(model).has(Effect::gravity));
  const Model stripped = restrict_effects(model, Effects());
  BOOST_TEST(applicable_effects(stripped).empty());
}

BOOST_AUTO_TEST_CASE(counters_add_up) {
  Counters all{.element_evaluations = 1, .factorizations = 2, .solves = 3, .steps = 4};
  all.add(Effect::damping, 5);
  all += all;
  BOOST_TEST(all.element_evaluations == 2);
  BOOST_TEST(all.factorizations == 4);
  BOOST_TEST(all.solves == 6);
  BOOST_TEST(all.steps == 8);
  BOOST_TEST(all.evaluations(Effect::damping) == 10);
}

BOOST_AUTO_TEST_SUITE_END()
