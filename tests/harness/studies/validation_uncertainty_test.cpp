#include "harness/studies/validation_uncertainty.h"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "harness/input/document.h"
#include "harness/run/results.h"
#include "harness/run/run.h"
#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(validation_uncertainty)

using namespace trammel;
using namespace trammel::references;
using namespace trammel::solver;
using namespace trammel::testing;

namespace {

/// Exact first frequency of a steel cantilever [Hz]. It is proportional to depth, sqrt(E) and 1 /
/// length^2.
const double kExact = 3.5160152685 * std::sqrt(2e11 / 7800 / 12) * 0.1 / 4 / (2 * std::acos(-1.0));

/// Returns a beam with three uncertain inputs: depth 0.1 m +-1 mm, E +-1 %, nominal length 2 m
/// +-0.5 m. The printed frequency has the relative error `off`.
Json beam(const Folder& folder, double off) {
  folder.write_reference("printed", "Hz", kExact * (1 - off), {{"absolute", 0.05}}, "code");
  folder.write_reference("other", "Hz", kExact * (1 - off) + 3, {{"absolute", 0.05}}, "code");
  folder.write_reference("depth", "m", 0.1, {{"absolute", 1e-3}}, "code");
  Json json = testing::cantilever();
  json["analysis"] = {{"modes", {{"count", 1}}}};
  for (const char* name : {"printed", "other"})
    json["checks"][name] = {
        {"quantity", "frequency_Hz"}, {"reference", name}, {"role", "validation"}};
  json["uncertainty"] = Json::parse(R"({
    "inputs": {
      "depth": {"pointers": ["/model/sections/bar/rectangle/thickness_m"], "reference": "depth"},
      "modulus": {"pointers": ["/model/materials/steel/E_Pa"], "half_width": 2e9, "why": "1 %"},
      "length": {"pointers": ["/model/nodes/B/0"], "half_width": 0.5, "nominal": true, "why": "round"},
      "words": {"pointers": ["/model/members/AB/section"], "half_width": 1, "why": "no number here"}
    },
    "samples": 300, "samples_all_inputs": 50, "seed": 1
  })");
  return json;
}

Run run(const Case& given) {
  const References references;
  return run_cases({given}, references, {}).at(0);
}

}  // namespace

BOOST_AUTO_TEST_CASE(uncertainties_agree_with_scaling_laws_of_a_beam) {
  const Folder folder;
  const Run found = run(testing::read(folder, beam(folder, 0)));
  BOOST_REQUIRE(found.uncertainty->comparisons.size() == 2U);
  const results::Comparison& entry = found.uncertainty->comparisons[0];
  const double f = *entry.simulation, depth = 0.01 * f / std::sqrt(3.0);
  const double modulus = 0.5 * 0.01 * f / std::sqrt(3.0);
  BOOST_TEST(f == kExact, boost::test_tools::tolerance(1e-4));
  BOOST_TEST(*entry.contributions[0].second == depth, boost::test_tools::tolerance(1e-4));
  BOOST_TEST(*entry.contributions[1].second == modulus, boost::test_tools::tolerance(1e-4));
  BOOST_TEST(*entry.u_input == std::hypot(depth, modulus), boost::test_tools::tolerance(1e-4));
  BOOST_TEST(*entry.u_input_sampled == *entry.u_input, boost::test_tools::tolerance(0.05));
  BOOST_TEST(entry.dominant_input == "depth");
  BOOST_TEST(*entry.dominant_share == 0.8, boost::test_tools::tolerance(1e-3));
  BOOST_TEST(*entry.u_reference == 0.05 / std::sqrt(3.0), boost::test_tools::tolerance(1e-12));
  // The difference between two references of the same value is reported, but does not change the
  // verdict.
  BOOST_REQUIRE(entry.spread.size() == 1U);
  BOOST_TEST(*entry.spread[0] == 3, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(*entry.u_val < 0.5);
  BOOST_TEST(found.uncertainty->inputs.size() == 3U);  // without the input that is not a number
}

BOOST_AUTO_TEST_CASE(nominal_length_uncertainty_counts_for_all_inputs_only) {
  const Folder folder;
  const Run found = run(testing::read(folder, beam(folder, 0)));
  const results::Comparison& entry = found.uncertainty->comparisons[0];
  const double length = 2 * 0.25 * *entry.simulation / std::sqrt(3.0);  // frequency ~ 1/L^2
  BOOST_TEST(std::abs(*entry.contributions[2].second) == length,
             boost::test_tools::tolerance(0.01));
  BOOST_TEST(
      *entry.all_inputs.u_input == std::hypot(*entry.u_input, *entry.contributions[2].second),
      boost::test_tools::tolerance(1e-12));
  BOOST_TEST(*entry.all_inputs.u_val > 10 * *entry.u_val);
}

BOOST_AUTO_TEST_CASE(u_num_covers_the_mesh_error_within_a_factor_of_4) {
  const Folder folder;
  const Run found = run(testing::read(folder, beam(folder, 0)));
  const double u = found.uncertainty->comparisons[0].u_num.value();
  const double error = std::abs(found.uncertainty->comparisons[0].simulation.value() - kExact);
  BOOST_TEST(1.15 * u > error);
  BOOST_TEST(u < 4 * error);
}

BOOST_AUTO_TEST_CASE(difference_beyond_uncertainty_is_a_model_error) {
  const Folder folder;
  const auto verdict = [&](double off) {
    return run(testing::read(folder, beam(folder, off))).uncertainty->comparisons[0].verdict;
  };
  BOOST_TEST(verdict(0.01) == "within-uncertainty");
  BOOST_TEST(verdict(0.05) == "model-error");
}

BOOST_AUTO_TEST_CASE(uncertainty_does_not_depend_on_jobs) {
  const Folder folder;
  Json json = beam(folder, 0);
  json["variants"]["deep"]["model"]["sections"]["bar"]["rectangle"]["thickness_m"] = 0.11;
  const Case given = testing::read(folder, json);
  const auto results = [&](unsigned jobs) {
    const References references;
    RunOptions options;
    options.jobs = jobs;
    return to_json(collect_results(run_cases({given}, references, options), {given}, references));
  };
  const Json one = results(1), two = results(2);
  const auto fault = find_schema_fault(one, "results");
  BOOST_TEST(!fault.has_value(), (fault ? fault->pointer + ": " + fault->message : ""));
  BOOST_TEST((one["runs"][1]["uncertainty"] == two["runs"][1]["uncertainty"]));
  BOOST_TEST(one["runs"][1]["uncertainty"]["comparisons"].size() == 2U);
}

BOOST_AUTO_TEST_CASE(pointer_to_a_missing_value_is_refused) {
  const Folder folder;
  Json json = beam(folder, 0);
  json["uncertainty"]["inputs"]["depth"]["pointers"][0] = "/model/sections/beam";
  const Run found = run(testing::read(folder, json));
  BOOST_TEST((found.status == results::Status::error));
  BOOST_TEST(testing::contains(found.reason, "/uncertainty/inputs/depth/pointers/0"));
}

BOOST_AUTO_TEST_CASE(input_with_two_half_widths_is_refused) {
  const Folder folder;
  Json json = beam(folder, 0);
  json["uncertainty"]["inputs"]["depth"]["half_width"] = 1e-3;
  BOOST_TEST(
      testing::contains(run(testing::read(folder, json)).reason,
                        "expected either 'half_width' or 'reference' of an uncertain input"));
}

BOOST_AUTO_TEST_CASE(verdict_other_than_the_recorded_one_fails) {
  const Folder folder;
  Json json = beam(folder, 0);
  Json& expect = json["checks"]["printed"]["expect"];
  expect = {{"agrees", "the model is exact"}, {"relative_between", {-0.01, 0.01}}};
  expect["validation_verdicts"] = {"within-uncertainty"};
  const Run as_recorded = run(testing::read(folder, json));
  BOOST_TEST(exit_status({as_recorded}) == 0);
  BOOST_TEST(as_recorded.checks.back().name == "printed.validation");
  expect["validation_verdicts"] = {"model-error"};
  BOOST_TEST(exit_status({run(testing::read(folder, json))}) == 1);
  expect["validation_verdicts"] = {"within-uncertainty", "within-uncertainty"};
  BOOST_TEST(exit_status({run(testing::read(folder, json))}) == 1);
}

BOOST_AUTO_TEST_SUITE_END()
