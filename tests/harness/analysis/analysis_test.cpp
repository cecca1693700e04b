#include "harness/analysis/analysis.h"

#include <boost/test/unit_test.hpp>
#include <cfenv>
#include <cmath>

#include "harness/analysis/size_estimate.h"
#include "harness/base/recorder.h"
#include "harness/input/catalogue.h"
#include "tests/support/harness/analysing.h"

BOOST_AUTO_TEST_SUITE(analysis)

using namespace trammel;
using namespace trammel::testing;

namespace {

Json manipulator_on_circle(Json json, int points) {
  json["model"].erase("pose");
  json["model"]["trajectory"]["circle"] = {
      {"center_m", {0.25, 0.144}}, {"radius_m", 0.01}, {"points", points}, {"step_s", 0.01}};
  return json;
}

}  // namespace

BOOST_AUTO_TEST_CASE(fine_six_node_mesh_is_drawn_with_corner_nodes_only) {
  Json json = testing::quarter_ring();
  const AnalysisResult coarse = analyze_json(json);
  BOOST_REQUIRE(coarse.drawing.has_value());
  BOOST_TEST(coarse.drawing->nodes.size() == 45U);
  BOOST_TEST(coarse.drawing->triangles.at(0).size() == 6U);
  json["model"]["plates"]["ring"]["divisions"] = 16;
  const AnalysisResult fine = analyze_json(json);
  BOOST_REQUIRE(fine.drawing.has_value());
  BOOST_TEST(fine.drawing->nodes.size() == 17U * 33);
  BOOST_TEST(fine.drawing->triangles.at(0).size() == 3U);
  BOOST_TEST(fine.drawing->shapes.at(0).displacement.size() == 17U * 33);
}

BOOST_AUTO_TEST_CASE(section_without_fiber_distance_has_no_stress_quantity) {
  Json json = testing::cantilever();
  json["model"]["sections"]["bar"] = {
      {"material", "steel"}, {"area_m2", 0.01}, {"second_moment_m4", 1e-6}};
  BOOST_TEST(analyze_json(json).quantities.count("stress_Pa:AB") == 0U);
}

BOOST_AUTO_TEST_CASE(quantities_along_a_path_have_one_number_per_point) {
  for (const char* kind : {"statics", "kinematics"}) {
    Json json = manipulator_on_circle(testing::manipulator(), 50);
    json["analysis"] = {{kind, Json::object()}};
    const AnalysisResult result = analyze_json(json);
    BOOST_TEST(result.outcome.solved());
    BOOST_TEST(result.quantities.size() > 10);
    for (const auto& [name, quantity] : result.quantities) {
      BOOST_TEST(quantity.values.size() == 50, name);
      for (const double value : quantity.values) BOOST_TEST(std::isfinite(value), name);
    }
    BOOST_TEST(result.quantities.at("time_s").values[10] == 0.1);
  }
  Json json = manipulator_on_circle(testing::manipulator(), 5);
  const AnalysisResult modes = analyze_json(json);
  BOOST_TEST(modes.quantities.at("frequency_Hz:1").values.size() == 5);
  BOOST_TEST(modes.quantities.at("frequency_Hz:6").values.size() == 5);
}

BOOST_AUTO_TEST_CASE(largest_network_error_includes_negative_errors) {
  Json json = manipulator_on_circle(testing::manipulator(), 100);
  json["model"]["trajectory"]["circle"]["step_s"] = 0.0628;
  json["analysis"] = {{"grnn", {{"train", 60}, {"split", "first"}}}};
  const AnalysisResult result = analyze_json(json);
  double upwards = 0, largest = 0;
  for (const char* item : {"A1", "A2", "A3"})
    for (const auto& [error, active] :
         {std::pair{"held_out_angle_error_rad:", "active_angle_rad:"},
          std::pair{"held_out_velocity_error_rad_per_s:", "active_velocity_rad_per_s:"}}) {
      const std::vector<double>& all = result.quantities.at(std::string(active) + item).values;
      const auto [least, most] = std::minmax_element(all.begin(), all.end());
      for (const double one : result.quantities.at(std::string(error) + item).values) {
        upwards = std::max(upwards, one / (*most - *least));
        largest = std::max(largest, std::abs(one) / (*most - *least));
      }
    }
  BOOST_TEST(largest > 1.01 * upwards);
  BOOST_TEST(only(result, "held_out_largest_error_of_range") == largest,
             boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(study_errors_refer_to_the_run_named_in_relative_to) {
  Json json = testing::cantilever();
  json["analysis"]["study"] = Json::parse(R"({
    "analysis": {"modes": {"count": 1}}, "parameter": "elements", "values": [1, 2, 4],
    "pointers": ["/model/elements"],
    "quantities": {"frequency_Hz": {"index": 0, "relative_to": "first"}}})");
  json["analysis"].erase("statics");
  const auto errors = [&] {
    return analyze_json(json).quantities.at("relative_error:frequency_Hz").values;
  };
  BOOST_TEST(errors().front() == 0);
  BOOST_TEST(errors().back() > 0);
  json["analysis"]["study"]["quantities"]["frequency_Hz"]["relative_to"] = "last";
  BOOST_TEST(errors().front() > 0);
  BOOST_TEST(errors().back() == 0);
}

namespace {

/// Returns the cantilever case with the given id and a check against a reference of the catalogue.
Document cantilever_against_table_2(const Folder& folder, const char* id) {
  Json json = testing::cantilever();
  json["id"] = id;
  json["checks"]["c"] = {
      {"quantity", "frequency_Hz"}, {"role", "validation"}, {"reference", "table-2-ansys"}};
  return patched(testing::read(folder, json), "base");
}

}  // namespace

BOOST_AUTO_TEST_CASE(absent_reference_file_next_to_a_case_has_empty_hash) {
  const Folder folder;
  const Document document = cantilever_against_table_2(folder, "cantilever");
  const References references;
  (void)references.get(JsonView(document)["checks"]["c"]["reference"]);
  const auto hashes = references.hashes();
  const auto beside = hashes.find((folder.path() / "references.json").string() + "#/table-2-ansys");
  BOOST_REQUIRE((beside != hashes.end()));
  BOOST_TEST(beside->second == "");
}

BOOST_AUTO_TEST_CASE(case_file_references_json_is_not_read_as_references) {
  const Folder folder;
  const Document document = cantilever_against_table_2(folder, "references");
  const References references;
  BOOST_TEST(references.get(JsonView(document)["checks"]["c"]["reference"]).unit == "Hz");
}

BOOST_AUTO_TEST_CASE(overflowing_compliance_has_status_not_converged) {
  Json json = testing::cantilever();
  json["model"]["loads"]["tip"]["force_N"] = {0, 1e155};
  BOOST_TEST(analyze_json(json).outcome.solved());
  json["model"]["loads"]["tip"]["force_N"] = {0, 1e160};
  const AnalysisResult result = analyze_json(json);
  BOOST_TEST((result.outcome.status == Status::not_converged));
  BOOST_TEST(result.outcome.reason == "compliance_J is not a finite number");
  BOOST_TEST(result.quantities.empty());
}

BOOST_AUTO_TEST_CASE(intended_nan_does_not_prevent_the_status_solved) {
  Recorder record;
  record.add_or_missing("a", "", std::nan(""));
  record.add("a", "", 1);
  BOOST_TEST(record.first_nonfinite_quantity() == "");
  record.add("b", "P", std::nan(""));
  BOOST_TEST(record.first_nonfinite_quantity() == "b:P");
}

BOOST_AUTO_TEST_CASE(computation_beyond_memory_is_refused_with_key_at_fault) {
  const auto refusal = [](const Json& json) {
    return input_error_message([&] { require_sufficient_memory(document_of(json), 1e8); });
  };
  Json json = testing::cantilever();
  BOOST_TEST(refusal(json) == "");
  json["model"]["elements"] = 65536;
  BOOST_TEST(contains(refusal(json), "/model/elements: expected a computation of at most 0.1 GB"));
  json["model"]["members"]["AB"]["elements"] = 1;
  BOOST_TEST(refusal(json) == "");
  json["model"]["members"]["AB"]["elements"] = 1000;
  json["analysis"] = {{"modes", {{"count", 5}, {"eigensolver", "dense"}}}};
  BOOST_TEST(contains(refusal(json), "/analysis/modes/eigensolver: "));
  json["analysis"] = Json::parse(R"({"transient": {"duration_s": 1, "step_s": 1e-5,
    "samples": 100000, "outputs": ["displacement_y_m:B"]}})");
  BOOST_TEST(contains(refusal(json), "/analysis/transient/samples: "));
  Json ring = testing::quarter_ring();
  BOOST_TEST(refusal(ring) == "");
  ring["model"]["plates"]["ring"]["divisions"] = 512;
  BOOST_TEST(contains(refusal(ring), "/model/plates/ring/divisions: "));
  ring["model"]["plates"]["ring"]["blocks"]["b"]["cells"] = {512, 512};
  BOOST_TEST(contains(refusal(ring), "2^31 non-zeros"));
  Json robot = testing::manipulator();
  robot["model"]["manipulator"]["platform"]["kind"] = "triangles";
  robot["model"]["manipulator"]["platform"]["refinements"] = 8;
  BOOST_TEST(contains(refusal(robot), "/model/manipulator/platform/refinements: "));
  Json map = testing::manipulator();
  map["analysis"] = {{"sensitivity-map", {{"columns", 400}, {"orientations_deg", {0, 10, 20}}}}};
  BOOST_TEST(contains(refusal(map), "/analysis/sensitivity-map/columns: "));
}

BOOST_AUTO_TEST_CASE(every_catalogue_case_requires_less_than_2_GB) {
  const Catalogue catalogue;
  for (const auto& file : catalogue.runnable_files()) {
    const Case given = load_case(file, catalogue);
    for (const std::string& variant : given.variants())
      BOOST_TEST(estimate_problem_size(patched(given, variant)).bytes < 2e9,
                 file << ": " << variant);
  }
}

/// Tests the path of equilibria of a shallow arch in each rounding mode. With upward rounding, a
/// load step once ended on another branch of equilibria with one unstable direction. The program
/// wrongly reported this step as a change of stability.
BOOST_AUTO_TEST_CASE(equilibrium_path_keeps_its_branch_in_any_rounding_mode) {
  const Document arch = patched(load_named_case("shallow-arch"), "nearly-perfect");
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO, FE_TONEAREST}) {
    set_solver_rounding_mode(mode);
    const AnalysisResult result = analyze(arch, References(), {});
    set_solver_rounding_mode(FE_TONEAREST);
    BOOST_TEST_REQUIRE(result.outcome.solved(), result.outcome.reason);
    BOOST_TEST(testing::values(result, "displacement_y_m:N4").back() < -10);
    BOOST_TEST(testing::values(result, "unstable_directions").back() == 0);
  }
}

BOOST_AUTO_TEST_SUITE_END()
