#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <map>

#include "harness/analysis/analysis.h"
#include "harness/analysis/effect_numbers.h"
#include "harness/input/catalogue.h"
#include "harness/input/reference_library.h"
#include "harness/printing/printing.h"
#include "harness/studies/effect_study.h"
#include "tests/support/harness/analysing.h"

BOOST_AUTO_TEST_SUITE(effects)

using namespace trammel;
using namespace trammel::testing;

namespace {

Json timoshenko_cantilever() {
  Json json = testing::cantilever();
  json["model"]["members"]["AB"]["beam"] = "timoshenko";
  return json;
}

double tip(const AnalysisResult& result) {
  return result.quantities.at("displacement_y_m:B").values.at(0);
}

}  // namespace

BOOST_AUTO_TEST_CASE(named_effects_are_the_only_active_ones) {
  Json json = timoshenko_cantilever();
  const double whole = tip(analyze_json(json));
  json["effects"] = {"axial-flexibility"};
  const AnalysisResult plain = analyze_json(json);
  const double bending = 100 * 8 / (3 * 2e11 * 0.05 * 1e-3 / 12);
  BOOST_TEST(tip(plain) == bending, boost::test_tools::tolerance(1e-10));
  BOOST_TEST(tip(plain) < whole);
  BOOST_TEST(plain.counters.evaluations(Effect::shear) == 0);
  BOOST_TEST(plain.counters.evaluations(Effect::inertia) == 0);
  BOOST_TEST(plain.counters.evaluations(Effect::axial_flexibility) == 4);
}

BOOST_AUTO_TEST_CASE(geometric_stiffening_by_name_is_second_order_theory) {
  Json json = testing::cantilever();
  json["model"]["loads"]["tip"]["force_N"] = {-1e5, 100};
  json["analysis"]["statics"]["second_order"] = true;
  const double stated = tip(analyze_json(json));
  json["effects"] = {"axial-flexibility", "geometric-stiffening"};
  json["analysis"]["statics"] = Json::object();
  BOOST_TEST(tip(analyze_json(json)) == stated);
}

BOOST_AUTO_TEST_CASE(selected_effects_have_dimensionless_number_and_reason) {
  Json json = timoshenko_cantilever();
  json["effects"] = {{"auto", {{"tolerance", 0.01}}}};
  const AnalysisResult slender = analyze_json(json);
  // The dimensionless number of shear is E I k^2 / (kappa G A) with the wave number k = pi / L:
  // pi^2 * 2.6 / (5/6 * 12) * (0.1 / 2)^2 = 0.64 %.
  const results::EffectRow& shear = slender.effects.at(static_cast<std::size_t>(Effect::shear));
  BOOST_TEST(shear.active);
  BOOST_TEST(*shear.dimensionless_number == 0.006415, boost::test_tools::tolerance(1e-3));
  BOOST_TEST(contains(shear.why, "changes the results by at most"), shear.why);
  json["effects"]["auto"]["tolerance"] = 0.1;
  BOOST_TEST(!analyze_json(json).effects.at(static_cast<std::size_t>(Effect::shear)).active);
}

/// Tests the change of the tip displacement that the effect study reports for a Timoshenko
/// cantilever if shear flexibility is omitted. The expected change follows from beam theory.
BOOST_AUTO_TEST_CASE(effect_study_measures_each_contribution) {
  const Folder folder;
  const Document document = patched(testing::read(folder, timoshenko_cantilever()), "base");
  const EffectStudy study = study_effects(document, {0.01, 0});
  BOOST_TEST(study.within_tolerance());
  BOOST_TEST(study.is_minimal());
  for (const EffectRun& run : study.without_one) {
    if (!(run.left_out == Effects().with(Effect::shear))) continue;
    // Shear contributes about the following fraction of the tip displacement: 3 E I / (kappa G A
    // L^2) = 3 * 2.6 / (5/6 * 12) * (0.1 / 2)^2.
    BOOST_TEST(run.changes.at("displacement").value == 0.00195, boost::test_tools::tolerance(2e-3));
    BOOST_TEST(run.changes.at("force").value < 1e-6);
  }
  BOOST_TEST(study_effects(document, {0.01, 1, false}).without_one.empty());
}

/// Compares the dimensionless numbers of the mechanical effects of a member with their definitions,
/// such as EI k^2 / EA for axial flexibility.
BOOST_AUTO_TEST_CASE(dimensionless_effect_numbers_equal_their_definitions,
                     *boost::unit_test::tolerance(1e-12)) {
  Model model;
  model.nodes = {{"A", {0, 0}}, {"B", {3, 4}}};
  Member& member = model.members.emplace_back();
  member.nodes = {0, 1};
  member.theory = BeamTheory::timoshenko;
  member.section = {
      .EA = 100, .EI = 2, .kappa_GA = 40, .mass_per_length = 3, .inertia_per_length = 0.06};
  member.ends[0] = {.fixity = EndFixity::sprung, .stiffness = 7};
  model.loads = {{.node = 1, .force = {0, 0.5, 0}}};
  const double k = 2 * std::acos(-1.0) / 5;
  const EffectNumbers numbers = dimensionless_numbers(model, {.half_waves = 2, .phase = 3});
  const auto value = [&](Effect effect) {
    return *numbers[static_cast<std::size_t>(effect)].value;
  };
  BOOST_TEST(value(Effect::axial_flexibility) == 0.02 * k * k);
  BOOST_TEST(value(Effect::shear) == 2 * k * k / 40);
  BOOST_TEST(value(Effect::rotary_inertia) == 0.02 * k * k);
  BOOST_TEST(value(Effect::joint_compliance) == 2 * k / 7);
  BOOST_TEST(value(Effect::geometric_stiffening) ==
             0.5 * 25 / (std::acos(-1.0) * std::acos(-1.0) * 2));
  BOOST_TEST(numbers[static_cast<std::size_t>(Effect::shear)].change == 3 * 2 * k * k / 40);
  BOOST_TEST(!numbers[static_cast<std::size_t>(Effect::platform_flexibility)].value);
}

/// Among the effects that increase the computing time, the selection must contain exactly those
/// listed for the scene (case with candidate effects). It may contain any effect that does not
/// increase the computing time.
BOOST_AUTO_TEST_CASE(scenes_use_only_the_expensive_effects_they_require) {
  const std::map<std::string, std::string> expected = {
      {"scene-10-newton", "geometric-stiffening and large-displacement"},
      {"scene-buckling-on-the-way", "geometric-stiffening and large-displacement"},
      {"scene-clamped-strip", "geometric-stiffening and large-displacement"},
      {"scene-column", "geometric-stiffening"},
      {"scene-columns-near-buckling", "geometric-stiffening"},
      {"scene-falling-link", "inertia, geometric-stiffening and large-displacement"},
      {"scene-fast-circle", "inertia, damping, gyroscopic and large-displacement"},
      {"scene-fastest-circle",
       "platform-flexibility, inertia, damping, gyroscopic and large-displacement"},
      {"scene-free-end", "inertia and damping"},
      {"scene-gravity-in-plane", "geometric-stiffening and large-displacement"},
      {"scene-hanging-strip", "inertia and geometric-stiffening"},
      {"scene-heavy-load-in-gravity", "none"},
      {"scene-heavy-platform", "inertia"},
      {"scene-light-load", "none"},
      {"scene-near-singular-path", "geometric-stiffening and large-displacement"},
      {"scene-shaken-arm", "inertia and damping"},
      {"scene-slow-circle", "none"},
      {"scene-soft-joints", "none"},
      {"scene-soft-platform", "platform-flexibility"},
      {"scene-spinning-link", "inertia, gyroscopic and geometric-stiffening"},
      {"scene-struck-arm", "inertia and damping"},
      {"scene-stubby-beam-modes", "inertia"},
      {"scene-table-1-modes", "inertia"},
      {"scene-thick-link-modes", "platform-flexibility and inertia"},
      {"scene-thick-links", "platform-flexibility"},
      {"scene-tie-rod", "inertia, geometric-stiffening and large-displacement"},
      {"scene-tightened-strip", "inertia and geometric-stiffening"},
      {"scene-welded-truss", "none"},
  };
  for (const Case& labeled_case : Catalogue().load({"effects"})) {
    const Document document = patched(labeled_case, kBaseVariant);
    const EffectStudy study = study_effects(document, {0.01, 0});
    BOOST_TEST_CONTEXT(labeled_case.id()) {
      BOOST_TEST(study.within_tolerance());
      BOOST_TEST(!study.choice.is_beyond_linear_theory());
      const auto found = expected.find(labeled_case.id());
      BOOST_REQUIRE(found != expected.end());
      Effects expensive;
      for (const Effect effect : study.choice.chosen.list())
        if (is_expensive(effect)) expensive = expensive.with(effect);
      BOOST_TEST(effect_names(expensive) == found->second);
    }
  }
}

/// The importance of large displacement for compressed columns was once estimated from linear
/// theory, without the factor 1 / (1 - P / Pcr) for an axial load P near the buckling load Pcr.
BOOST_AUTO_TEST_CASE(effect_selection_near_buckling_is_within_tolerance) {
  const Case columns = load_named_case("scene-columns-near-buckling");
  for (const std::string& variant : columns.variants()) {
    if (variant.find("whole") != std::string::npos) continue;
    const EffectStudy study = study_effects(patched(columns, variant), {0.01, 0});
    BOOST_TEST_CONTEXT(variant) {
      BOOST_TEST_REQUIRE(study.full.outcome.solved());
      BOOST_TEST(study.within_tolerance());
      if (variant.rfind("1_02", 0) == 0)
        BOOST_TEST(study.choice.chosen.has(Effect::large_displacement));
    }
  }
}

/// The platform of a manipulator moves slowly on a circle under a load of 10 N. The error of linear
/// theory is between 3 % and 15 %, so that the selection of effects must contain large
/// displacement.
BOOST_AUTO_TEST_CASE(slow_circle_under_10_N_uses_large_displacement) {
  const Case circle = load_named_case("scene-slow-circle");
  const EffectStudy study = study_effects(patched(circle, "ten-newton"), {0.01, 0});
  BOOST_TEST(study.within_tolerance());
  BOOST_TEST(study.choice.chosen.has(Effect::large_displacement));
  for (const EffectRun& run : study.without_one) {
    if (!run.left_out.has(Effect::large_displacement)) continue;
    BOOST_TEST(run.largest_change() > 0.03);
    BOOST_TEST(run.largest_change() < 0.15);
  }
}

/// A sudden start of a manipulator also excites vibrations of its stiff platform. The platform has
/// only 3e-6 of the strain energy. If the platform is rigid, the largest force is wrong by 28 %.
BOOST_AUTO_TEST_CASE(sudden_start_keeps_flexibility_of_stiff_platform) {
  Json json = patched(load_named_case("scene-slow-circle"), "base").value();
  json.erase("extends");
  json["analysis"]["elastodynamics"]["initial_state"] = "at-rest";
  json["model"]["manipulator"]["platform"]["mass_kg"] = 0.02;
  json["effects"] = {{"auto", {{"tolerance", 0.01}}}};
  const Document document = testing::document_of(json);
  const EffectChoice choice = choose_effects(document, read_case_model(document));
  BOOST_TEST(choice.chosen.has(Effect::platform_flexibility));
}

/// Omitting inertia changes the results by at most about r^2 + 2 zeta r. The ratio of path
/// frequency to first natural frequency is r, and zeta is the damping ratio. With this bound, the
/// selection of effects requires no computed motion.
BOOST_AUTO_TEST_CASE(slow_circle_omits_inertia_by_frequency_ratio_alone) {
  Document slower = patched(load_named_case("scene-slow-circle"), "base");
  slower.apply_patch("test", "",
                     {{"model", {{"trajectory", {{"circle", {{"angular_speed_rad_s", 0.3}}}}}}}});
  EffectChoice choice = choose_effects(slower, read_case_model(slower));
  BOOST_TEST(!choice.automatic->of(Effect::inertia).is_measured);
}

/// Along a path, the geometrically exact theory requires fixed time steps and driven actuators.
/// With error control, large displacement therefore cannot be selected, although its effect exceeds
/// the tolerance.
BOOST_AUTO_TEST_CASE(motion_beyond_all_selectable_theories_is_reported) {
  Document document = patched(load_named_case("scene-slow-circle"), "ten-newton");
  document.apply_patch(
      "test", "", {{"analysis", {{"elastodynamics", {{"error_control", {{"relative", 1e-6}}}}}}}});
  const EffectStudy study = study_effects(document, {0.01, 0});
  BOOST_TEST(!study.choice.chosen.has(Effect::large_displacement));
  BOOST_TEST(study.choice.is_beyond_linear_theory());
}

BOOST_AUTO_TEST_CASE(nan_in_one_result_is_an_infinite_change) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  const Quantities full = {{"displacement_x_m:B", {{1, 2, 3}, {}}}};
  const Quantities other = {{"displacement_x_m:B", {{nothing, 2, 3.1}, {}}}};
  BOOST_TEST(std::isinf(max_change(result_changes(full, other, {.length = 1})).value));
}

BOOST_AUTO_TEST_SUITE_END()
