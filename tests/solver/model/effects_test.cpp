#include "solver/model/effects.h"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "solver/assembly/restrict_model_effects.h"
#include "solver/effects/effect_choice.h"
#include "solver/effects/modal_effect_estimates.h"
#include "solver/effects/static_effect_estimates.h"
#include "solver/modes/modes.h"
#include "solver/statics/statics.h"
#include "tests/support/solver/frames.h"

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

double first_frequency_squared(BeamTheory theory, Index mode) {
  Model model = testing::beam(stubby(), kLength, 32);
  model.supports = {testing::pin(0), testing::roller(1)};
  model.members[0].theory = theory;
  const ModalSolution modes = solve_modes(assemble(model), {6, EigenMethod::automatic});
  const double w = 2 * std::numbers::pi * modes.frequency[mode];
  return w * w;
}

const EffectEstimate& of(const EffectEstimates& estimates, Effect effect) {
  for (const EffectEstimate& one : estimates.effects) {
    if (one.effect == effect) return one;
  }
  throw std::logic_error("not estimated");
}

EffectEstimate made_up(Effect effect, const Eigen::VectorXd& change) {
  return {effect, 0, change};
}

}  // namespace

BOOST_AUTO_TEST_SUITE(effects)

BOOST_AUTO_TEST_CASE(every_effect_has_a_name_of_its_own) {
  for (const Effect effect : Effects::all().list()) {
    BOOST_TEST((effect_named(name_of(effect)) == effect));
  }
  BOOST_TEST(Effects::all().list().size() == kEffectCount);
  BOOST_TEST(!effect_named("friction"));
}

/// Han, Benaroya & Wei (1999): with k = pi / L between pins, w^2 = EI k^4 / rho A over
/// 1 + k^2 I / A (Rayleigh) or 1 + k^2 EI / kappa GA (shear).
BOOST_AUTO_TEST_CASE(a_pinned_beam_vibrates_as_each_of_the_four_theories_says) {
  const Section s = stubby();
  const double k = std::numbers::pi / kLength;
  const double plain = s.EI * std::pow(k, 4) / s.mass_per_length;
  const double turned = 1 + k * k * s.inertia_per_length / s.mass_per_length;
  const double sheared = 1 + k * k * s.EI / s.kappa_GA;
  // 32 elements: (k h)^4 / 720 = 1e-7 of bending; shear is constant in each, (k h)^2 / 12 of the
  // shear's share of a tenth = 7.6e-5.
  const auto near = boost::test_tools::tolerance(1e-6);
  const auto near_in_shear = boost::test_tools::tolerance(1e-4);
  BOOST_TEST(first_frequency_squared(BeamTheory::euler_bernoulli, 0) == plain, near);
  BOOST_TEST(first_frequency_squared(BeamTheory::rayleigh, 0) == plain / turned, near);
  BOOST_TEST(first_frequency_squared(BeamTheory::shear, 0) == plain / sheared, near_in_shear);
  BOOST_TEST(first_frequency_squared(BeamTheory::timoshenko, 0) < plain / sheared);
}

BOOST_AUTO_TEST_CASE(what_is_off_has_no_matrix_no_coordinate_and_no_evaluation) {
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
  // Two elements that do not stretch, one spring end that is welded.
  BOOST_TEST(assemble(model, all.without(Effect::axial_flexibility)).K.rows() ==
             whole.K.rows() - 2);
  BOOST_TEST(assemble(model, all.without(Effect::joint_compliance)).K.rows() == whole.K.rows() - 1);
}

BOOST_AUTO_TEST_CASE(a_model_admits_what_its_parts_have) {
  const Model model = sprung_cantilever();
  Effects bare = applicable_effects(testing::cantilever(stubby(), kLength, 1));
  BOOST_TEST((bare == Effects().with(Effect::axial_flexibility).with(Effect::link_mass)));
  BOOST_TEST(applicable_effects(model).has(Effect::shear));
  BOOST_TEST(applicable_effects(model).has(Effect::joint_compliance));
  BOOST_TEST(applicable_effects(model).has(Effect::gravity));
  const Model stripped = restrict_effects(model, Effects());
  BOOST_TEST(applicable_effects(stripped).empty());
}

/// Forces follow from equilibrium alone, so that the estimate is no estimate.
BOOST_AUTO_TEST_CASE(where_forces_are_determinate_flexibilities_are_estimated_exactly) {
  Model model = sprung_cantilever();
  model.gravity.setZero();
  const Effects all = applicable_effects(model).without(Effect::link_mass);
  const EffectEstimates estimates =
      estimate_static_effects({model}, all.without(Effect::rotary_inertia));
  const double full = solve_statics(assemble(model)).displacement(1, 1);
  for (const Effect effect : {Effect::shear, Effect::joint_compliance}) {
    const double without = solve_statics(assemble(model, all.without(effect))).displacement(1, 1);
    BOOST_TEST_CONTEXT(name_of(effect)) {
      // Node B's y is the fourth displacement, and the largest.
      BOOST_TEST(of(estimates, effect).change[3] == (without - full) / std::abs(full),
                 boost::test_tools::tolerance(1e-9));
    }
  }
  BOOST_TEST(of(estimates, Effect::shear).number ==
                 12 * stubby().EI / (stubby().kappa_GA * kLength * kLength),
             boost::test_tools::tolerance(1e-12));
}

/// Timoshenko & Gere: load over buckling load is how much the deflection grows, to first order. The
/// ratio of energies is that load ratio where the deflection has the buckling shape.
BOOST_AUTO_TEST_CASE(a_columns_estimate_is_its_load_over_its_buckling_load) {
  Model model = testing::cantilever(stubby(), 5, 4);
  const double buckling = std::pow(std::numbers::pi / 10, 2) * stubby().EI;
  model.loads = {{1, {-0.01 * buckling, 1, 0}}};
  const EffectEstimates estimates = estimate_static_effects(
      {model}, Effects().with(Effect::geometric_stiffening).with(Effect::large_displacement));
  BOOST_TEST(of(estimates, Effect::geometric_stiffening).number == -0.01,
             boost::test_tools::tolerance(0.02));  // the sag is not quite the buckling shape
  const double first = solve_statics(assemble(model)).displacement(1, 1);
  const double second = solve_statics(assemble(model), {.second_order = true}).displacement(1, 1);
  BOOST_TEST(-of(estimates, Effect::geometric_stiffening).change[3] == second / first - 1,
             boost::test_tools::tolerance(0.03));  // its own square, 0.01, and more
}

BOOST_AUTO_TEST_CASE(a_frequencys_estimates_are_what_leaving_out_does) {
  Model model = sprung_cantilever();
  model.masses = {{1, 5, 0, {0, 0}}};
  model.gravity.setZero();
  const Effects all = applicable_effects(model).with(Effect::inertia);
  const double full = solve_modes(assemble(model, all), {1, EigenMethod::dense}).frequency[0];
  const EffectEstimates estimates = estimate_modal_effects({model}, all, 1);
  for (const Effect effect : {Effect::shear, Effect::joint_compliance, Effect::rotary_inertia}) {
    const double without =
        solve_modes(assemble(model, all.without(effect)), {1, EigenMethod::dense}).frequency[0];
    BOOST_TEST_CONTEXT(name_of(effect)) {
      BOOST_TEST(of(estimates, effect).change[0] == without / full - 1,
                 boost::test_tools::tolerance(0.05));
    }
  }
}

BOOST_AUTO_TEST_CASE(small_changes_that_add_up_are_not_small) {
  EffectScope scope;
  scope.applicable = Effects().with(Effect::shear).with(Effect::axial_flexibility);
  EffectEstimates estimates;
  const Eigen::VectorXd change = Eigen::VectorXd::Constant(1, 0.006);
  estimates.effects = {made_up(Effect::axial_flexibility, change), made_up(Effect::shear, change)};
  BOOST_TEST(choose_effects(estimates, scope, 0.01).list().size() == 1);
  estimates.effects[1].change = -change;
  BOOST_TEST(choose_effects(estimates, scope, 0.01).empty());
}

BOOST_AUTO_TEST_CASE(what_carries_another_effect_goes_only_with_it) {
  EffectScope scope;
  scope.applicable = Effects().with(Effect::gravity).with(Effect::link_mass);
  scope.dependents[static_cast<std::size_t>(Effect::gravity)] = Effects().with(Effect::link_mass);
  EffectEstimates estimates;
  estimates.effects = {made_up(Effect::link_mass, Eigen::VectorXd::Constant(1, 0.1)),
                       made_up(Effect::gravity, Eigen::VectorXd::Zero(1))};
  BOOST_TEST((choose_effects(estimates, scope, 0.01) == scope.applicable));
  BOOST_TEST(scope.without(scope.applicable, Effect::gravity).empty());
  estimates.outcome = {Status::singular, "a mechanism"};
  BOOST_TEST((choose_effects(estimates, scope, 1) == scope.applicable));
}

BOOST_AUTO_TEST_SUITE_END()
