#include "harness/studies/cost_study.h"

#include <boost/test/unit_test.hpp>

#include "harness/input/catalogue.h"
#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(cost_study)

using namespace trammel;
using namespace trammel::references;
using namespace trammel::testing;

namespace {

Json study_json() {
  return Json::parse(R"({
    "id": "arm", "family": "arms", "title": "A cantilever's first frequencies", "case": "cantilever",
    "patch": {"analysis": {"statics": null, "modes": {"count": 2}}},
    "quantities": {"frequency_Hz": {"index": [0, 1]}},
    "reference_solution": {"title": "32 elements", "patch": {"model": {"elements": 32}}},
    "curves": {
      "consistent": {"title": "consistent mass", "pointers": ["/model/elements"], "values": [1, 2, 4, 8],
                     "value_title": "{} elements", "quick_values": [2, 4]},
      "lumped": {"title": "lumped mass", "patch": {"model": {"members": {"AB": {"mass_matrix": "lumped"}}}},
                 "pointers": ["/model/elements"], "values": [4, 16], "quick_values": []}
    },
    "baseline": {"curve": "consistent", "value": 4}
  })");
}

/// Writes a cost study next to its case, and loads the study.
CostStudy load(const Json& json, SweepExtent sweeping = SweepExtent::full) {
  const Folder folder;
  (void)folder.write(testing::cantilever());
  const References references;
  return load_cost_study(folder.write("arm.json", json.dump(1)), sweeping, references);
}

std::string fault_of(const Json& json, SweepExtent sweeping = SweepExtent::full) {
  return input_error_message([&] { (void)load(json, sweeping); });
}

}  // namespace

BOOST_AUTO_TEST_CASE(settings_are_the_case_with_the_patches_of_curves) {
  const CostStudy study = load(study_json());
  BOOST_TEST_REQUIRE(study.settings.size() == 6U);
  BOOST_TEST(study.settings[0].title == "consistent mass, 1 element");
  BOOST_TEST(study.settings[3].title == "consistent mass, 8 elements");
  BOOST_TEST(study.settings[5].document.value().at("model").at("elements") == 16);
  BOOST_TEST(study.settings[5].document.value()["model"]["members"]["AB"]["mass_matrix"] ==
             "lumped");
  BOOST_TEST(!study.settings[3].document.value()["model"]["members"]["AB"].contains("mass_matrix"));
  BOOST_TEST(!study.settings[0].document.value()["analysis"].contains("statics"));  // null patch
  BOOST_TEST(study.baseline == 2U);
  BOOST_TEST_REQUIRE(study.reference_solution.has_value());
  BOOST_TEST(study.reference_solution->document.value().at("model").at("elements") == 32);
  BOOST_TEST(study.reference_description == "32 elements");
}

BOOST_AUTO_TEST_CASE(quick_sweep_has_quick_values_and_their_baseline) {
  const CostStudy study = load(study_json(), SweepExtent::quick);
  BOOST_TEST_REQUIRE(study.settings.size() == 2U);
  BOOST_TEST(study.settings[study.baseline].title == "consistent mass, 4 elements");
  Json json = study_json();
  json["baseline"]["value"] = 8;
  BOOST_TEST(fault_of(json) == "");
  BOOST_TEST(contains(fault_of(json, SweepExtent::quick), "/baseline: no setting has this curve"));
}

BOOST_AUTO_TEST_CASE(invalid_studies_are_refused_with_their_pointer) {
  const auto spoiled = [](const std::string& pointer, const Json& value) {
    Json json = study_json();
    json[JsonPointer(pointer)] = value;
    return fault_of(json);
  };
  BOOST_TEST(contains(spoiled("/norm", "maximum"), "/norm"));
  BOOST_TEST(contains(spoiled("/case", "cantilevr"), "/case"));
  BOOST_TEST(contains(spoiled("/variant", "none"), "expected the name of a variant"));
  BOOST_TEST(contains(spoiled("/curves/lumped/pointers/0", "/model/elemnts"),
                      "/curves/lumped/pointers/0: expected a pointer to a value of the case"));
  BOOST_TEST(contains(spoiled("/curves/lumped/values/1", -3), "arm.json: /curves/lumped/values/1"));
  BOOST_TEST(contains(spoiled("/curves/consistent/quick_values/0", 3),
                      "/curves/consistent/quick_values/0"));
  BOOST_TEST(contains(spoiled("/curves/lumped/patches", Json::parse("[{}]")),
                      "expected exactly one of 'pointers' and 'patches'"));
  BOOST_TEST(contains(spoiled("/baseline/curve", "none"), "/baseline"));
  BOOST_TEST(contains(spoiled("/quantities/frequency_Hz/reference", "cantilever-frequencies"),
                      "'reference_solution' excludes references"));
  BOOST_TEST(contains(spoiled("/patch/model", {{"elemnts", 3}}), "elemnts"));
  Json json = study_json();
  json.erase("reference_solution");
  BOOST_TEST(contains(fault_of(json), "expected 'reference_solution'"));
  json = study_json();
  json["quantities"] = {{"frequency_Hz", {{"reference", "cantilever-tip-force-rotation"}}}};
  json.erase("reference_solution");
  BOOST_TEST(contains(fault_of(json), "expected a reference in Hz"));
}

BOOST_AUTO_TEST_CASE(each_output_has_a_scale_and_quantities) {
  Json json = study_json();
  json["outputs"] = {{"tones", {{"title", "frequencies"}}},
                     {"size", {{"title", "coordinates"}, {"scale", "largest"}}}};
  BOOST_TEST(contains(fault_of(json), "/quantities: no quantity of output 'coordinates'"));
  json["quantities"]["degrees_of_freedom"] = {{"output", "size"}};
  const CostStudy study = load(json);
  BOOST_TEST_REQUIRE(study.outputs.size() == 2U);
  BOOST_TEST(study.settings[0].observed[1].output == 1U);
  BOOST_TEST((study.outputs[1].scale.kind == Scale::Kind::largest));
  Json spoiled = json;
  spoiled["quantities"]["degrees_of_freedom"]["output"] = "sizes";
  BOOST_TEST(contains(fault_of(spoiled), "/quantities/degrees_of_freedom/output: expected one of"));
  spoiled = json;
  spoiled["scale"] = "largest";
  BOOST_TEST(contains(fault_of(spoiled), "/scale: each of 'outputs' requires its scale"));
  // A curve of a cost study must compute the first output of the study; other outputs are optional.
  spoiled = json;
  spoiled["curves"]["lumped"]["quantities"] = {{"frequency_Hz", {{"index", {0, 1}}}}};
  BOOST_TEST(fault_of(spoiled) == "");
  spoiled["curves"]["lumped"]["quantities"] = {{"degrees_of_freedom", {{"output", "size"}}}};
  BOOST_TEST(contains(fault_of(spoiled), "/curves/lumped: expected 1 quantities"));
}

BOOST_AUTO_TEST_CASE(observed_values_apply_index_addend_and_statistic) {
  const Quantities quantities = {{"pose_x_m", {{1, 2, 3}, {}}},
                                 {"displacement_x_m:P", {{0.1, 0.2, -0.6}, {}}}};
  ObservedQuantity one;
  one.quantity = "displacement_x_m:P";
  one.addend = "pose_x_m";
  BOOST_TEST(extract_observations(quantities, {one})[0] == (std::vector<double>{1.1, 2.2, 2.4}),
             boost::test_tools::per_element());
  one.index = {0, 2};
  BOOST_TEST(extract_observations(quantities, {one})[0] == (std::vector<double>{1.1, 2.4}),
             boost::test_tools::per_element());
  one.addend = "";
  one.statistic = "max_abs";
  BOOST_TEST(extract_observations(quantities, {one})[0][0] == 0.6);
  const auto said = [&](const ObservedQuantity& observed) {
    try {
      (void)extract_observations(quantities, {observed});
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  one.quantity = "displacement_x_m:Q";
  BOOST_TEST(contains(said(one), "did you mean 'displacement_x_m:P'"));
  one.quantity = "pose_x_m";
  one.index = {3};
  BOOST_TEST(contains(said(one), "expected 4 values of pose_x_m (got 3)"));
}

BOOST_AUTO_TEST_CASE(sweeps_of_a_case_are_a_cost_study) {
  Json json = testing::cantilever();
  json["analysis"] = {{"modes", {{"count", 2}}}};
  json["sweeps"]["elements"] = {{"pointers", {"/model/elements"}},
                                {"values", {1, 2, 4}},
                                {"quantities", {{"frequency_Hz", {{"index", {0, 1}}}}}}};
  const Folder folder;
  const References references;
  const Case given = testing::read(folder, json);
  const CostStudy study = cost_study_of_sweeps(given, kBaseVariant, {"elements"}, references);
  BOOST_TEST_REQUIRE(study.settings.size() == 3U);
  BOOST_TEST(study.settings[1].title == "elements 2");
  BOOST_TEST(study.baseline == 0U);
  BOOST_TEST(study.reference_description == "the finest level, elements 4");
  BOOST_TEST(contains(input_error_message([&] {
                        (void)cost_study_of_sweeps(given, kBaseVariant, {"element"}, references);
                      }),
                      "did you mean 'elements'"));
  const Case without = testing::read(folder, testing::cantilever());
  BOOST_TEST(contains(input_error_message([&] {
                        (void)cost_study_of_sweeps(without, kBaseVariant, {}, references);
                      }),
                      "expected 'sweeps'"));
}

BOOST_AUTO_TEST_CASE(sweep_errors_refer_to_exact_values_of_checks) {
  const References references;
  const Case given = load_named_case("beam-cantilever");
  const CostStudy study = cost_study_of_sweeps(given, kBaseVariant, {}, references);
  BOOST_TEST(!study.reference_solution.has_value());
  BOOST_TEST_REQUIRE(study.settings.front().observed.size() == 1U);
  BOOST_TEST(study.settings.front().observed[0].quantity == "frequency_Hz");
  BOOST_TEST(study.settings.front().observed[0].exact.size() == 6U);
}

BOOST_AUTO_TEST_CASE(every_study_of_the_catalogue_can_be_read) {
  const References references;
  BOOST_TEST(!cost_study_files().empty());
  for (const auto& file : cost_study_files()) {
    const CostStudy full = load_cost_study(file, SweepExtent::full, references);
    const CostStudy quick = load_cost_study(file, SweepExtent::quick, references);
    BOOST_TEST(full.settings.size() >= quick.settings.size(), file);
    BOOST_TEST(quick.settings.size() >= 2U, file);
    BOOST_TEST(!full.description.empty(), file);
  }
}

BOOST_AUTO_TEST_SUITE_END()
