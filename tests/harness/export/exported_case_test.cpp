// ctest: timeout=300
#include "harness/export/exported_case.h"

#include <Eigen/Dense>
#include <boost/test/unit_test.hpp>
#include <cstdlib>
#include <fstream>
#include <set>

#include "harness/base/json_file.h"
#include "harness/base/quantity.h"
#include "harness/input/catalogue.h"
#include "tests/support/harness/analysing.h"
#include "tests/support/harness/export_twin.h"

BOOST_AUTO_TEST_SUITE(exported_case)

/// Tests that an exported case has the same results as its original, and contains all data that
/// another code requires.
using namespace trammel;
using namespace trammel::harness;
using namespace trammel::testing;

namespace {

/// @param limit  largest permitted relative difference between the results of the original case and
/// of the exported case; 0 requires bit-identical numbers
void check_export_twins(const std::vector<std::string>& names, double limit) {
  for (const std::string& name : names) {
    const Case given = load_named_case(name);
    for (const std::string& variant : given.variants()) {
      const ExportTwin twin = export_and_compute_both(given, {variant});
      if (contains(twin.refused, "eq25")) continue;
      BOOST_TEST(twin.refused.empty(), twin.name << ": " << twin.refused);
      BOOST_TEST(twin.difference <= limit, twin.name << ": " << twin.worst);
    }
  }
}

void require_no_key(const Json& json, const std::set<std::string>& keys) {
  if (json.is_array() && !json.empty() && json.front().is_structured())
    for (const Json& item : json) require_no_key(item, keys);
  if (!json.is_object()) return;
  for (const auto& [key, value] : json.items()) {
    BOOST_TEST(keys.count(key) == 0, key);
    require_no_key(value, keys);
  }
}

/// Reads a file in coordinate format (Matrix Market) as a dense matrix.
Eigen::MatrixXd read_matrix(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string head, line;
  std::getline(in, head);
  while (in.peek() == '%') std::getline(in, line);
  Eigen::Index rows = 0, columns = 0, i = 0, k = 0;
  in >> rows >> columns;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(rows, columns);
  in >> line;
  for (double value = 0; in >> i >> k >> value;) {
    matrix(i - 1, k - 1) = value;
    if (contains(head, "symmetric")) matrix(k - 1, i - 1) = value;
  }
  return matrix;
}

std::string refusal_of(const Json& json) {
  const Folder folder;
  const Case given = read(folder, json);
  return input_error_message([&] { (void)export_case(given, {}); });
}

}  // namespace

BOOST_AUTO_TEST_CASE(exported_plain_models_have_bit_identical_results) {
  check_export_twins(
      {"portal-frame", "manipulator-modes", "ansys-vm21", "buckling-portal", "iftomm-a01-pendulum",
       "nafems-5h", "nafems-5t", "rotating-cantilever-hub-1", "scene-tightened-strip"},
      0);
}

// Tests that an exported case has bit-identical results at the start of a motion. The two cases
// contain pins and axial springs, or sliders and drives.
BOOST_AUTO_TEST_CASE(beginning_of_a_motion_is_exported_bit_for_bit) {
  for (const auto& [name, end] :
       {std::pair("iftomm-a03-andrews", 1e-3), std::pair("slider-crank-flexible", 0.02)}) {
    Json json = load_named_case(name).document.value();
    for (const char* key : {"extends", "checks", "variants", "sweeps"}) json.erase(key);
    json["analysis"]["large-motion"]["end_time_s"] = end;
    json["analysis"]["large-motion"].erase("output_step_s");
    const Folder folder;
    const ExportTwin twin = export_and_compute_both(read(folder, json), {});
    BOOST_TEST(twin.refused == "");
    BOOST_TEST(twin.difference == 0, twin.name << ": " << twin.worst);
  }
}

// The export writes the sections of tapered members as E and A; their product differs from EA in
// the last bit. The export also adds the forces on edges to the nodes before the forces on members,
// which changes round-off.
BOOST_AUTO_TEST_CASE(tapers_arcs_and_edges_are_exported_to_round_off) {
  check_export_twins({"ansys-vm34", "ansys-vm61", "cooks-membrane", "nafems-ring",
                      "tapered-cantilever", "vpcs-sdll10"},
                     1e-12);
}

BOOST_AUTO_TEST_CASE(exported_case_has_no_unresolved_keys) {
  const std::set<std::string> keys = {"extends", "variants", "manipulator", "pose",        "edges",
                                      "blocks",  "sweeps",   "end_section", "rectangle",   "circle",
                                      "checks",  "effects",  "taper",       "arc_center_m"};
  for (const char* name : {"manipulator-modes", "tapered-cantilever", "cooks-membrane",
                           "nafems-ring", "scene-welded-truss"})
    require_no_key(export_case(load_named_case(name), {}), keys);
}

BOOST_AUTO_TEST_CASE(exported_quantities_are_those_of_the_exported_case) {
  for (const char* name : {"portal-frame", "manipulator-modes", "buckling-portal"}) {
    const ExportTwin twin = export_and_compute_both(load_named_case(name), {});
    BOOST_TEST(!twin.json["export"]["quantities"].empty());
    for (const Json& asked : twin.json["export"]["quantities"]) {
      const auto quantity = asked["name"].get<std::string>();
      BOOST_REQUIRE_MESSAGE(twin.exported.quantities.count(quantity) == 1, quantity);
      BOOST_TEST(asked["unit"] == unit_of(quantity));
      BOOST_TEST(asked["about"] != "", quantity);
      if (!asked["length"].is_null())
        BOOST_TEST(asked["length"] == twin.exported.quantities.at(quantity).values.size());
    }
  }
}

// The variant "whole" has no checks, but a check of the base variant compares with the variant
// "whole". The export of "whole" once had no quantities, so that the check could not be judged.
BOOST_AUTO_TEST_CASE(variant_exports_quantities_compared_by_other_variants) {
  const Case given = load_named_case("scene-thick-link-modes");
  const Json asked = export_case(given, {"whole"})["export"]["quantities"];
  BOOST_REQUIRE(asked.size() == 1);
  BOOST_TEST(asked[0]["name"] == "frequency_Hz");
}

BOOST_AUTO_TEST_CASE(exporting_twice_changes_nothing) {
  const Folder folder;
  for (const char* name : {"manipulator-modes", "iftomm-a03-andrews", "cooks-membrane"}) {
    const Json once = export_case(load_named_case(name), {});
    const Case again = load_case(folder.write("again.json", once.dump()));
    const Json twice = export_case(again, {});
    BOOST_TEST((twice["model"] == once["model"]), name);
    BOOST_TEST((twice["analysis"] == once["analysis"]), name);
  }
}

BOOST_AUTO_TEST_CASE(sweep_level_is_exported_as_one_case) {
  const Case given = load_named_case("beam-cantilever");
  const std::size_t count = given.document.value()["sweeps"]["elements"]["values"].size();
  const Json finest = export_case(given, {"base", "elements", count - 1});
  BOOST_TEST(finest["model"]["members"]["AB"]["elements"] ==
             given.document.value()["sweeps"]["elements"]["values"].back());
  BOOST_TEST(finest["export"]["level"] == count - 1);
  BOOST_TEST(finest["export"]["hash"] != export_case(given, {})["export"]["hash"]);
  const auto message = [&](const ExportChoice& choice) {
    return input_error_message([&] { (void)export_case(given, choice); });
  };
  BOOST_TEST(contains(message({"base", "elements", count}), "expected a sweep level from 0 to "));
  BOOST_TEST(contains(message({"base", "steps", 0}), "expected the name of a sweep (got 'steps'"));
}

BOOST_AUTO_TEST_CASE(inexpressible_parts_are_refused_by_name) {
  Json robot = manipulator();
  robot["model"]["manipulator"]["joints"]["platform"] = "eq25-mean";
  BOOST_TEST(contains(refusal_of(robot), "cannot express the constraint 'eq25'"));
  Json moving = manipulator();
  moving["model"].erase("pose");
  moving["model"]["trajectory"]["circle"] = {
      {"center_m", {0.25, 0.144}}, {"radius_m", 0.02}, {"points", 3}, {"step_s", 0.1}};
  BOOST_TEST(contains(refusal_of(moving), "/model/trajectory: a trajectory cannot be exported"));
  moving["analysis"] = {{"grnn", {{"sigma", 1}}}};
  BOOST_TEST(contains(refusal_of(moving), "/analysis/grnn: the analysis grnn cannot be exported"));
  Json properties = cantilever();
  properties["analysis"] = {{"properties", Json::object()}};
  BOOST_TEST(contains(refusal_of(properties), "the analysis properties cannot be exported"));
  Json ring = quarter_ring();
  ring["checks"]["sum"] = {{"quantity", "reaction_y_N:bottom"},
                           {"role", "regression"},
                           {"bound", {{"at_least", 0}, {"why", "it presses"}}}};
  BOOST_TEST(contains(refusal_of(ring), "'reaction_y_N:bottom' belongs to an edge"));
}

BOOST_AUTO_TEST_CASE(grnn_with_given_samples_is_exported_without_a_model) {
  const ExportTwin twin = export_and_compute_both(load_named_case("grnn-example"), {});
  BOOST_TEST(twin.refused == "");
  BOOST_TEST(twin.difference == 0);
  BOOST_TEST(!twin.json.contains("model"));
}

BOOST_AUTO_TEST_CASE(manipulator_path_is_exported_as_bodies_joints_and_table) {
  const ExportTwin twin = export_and_compute_both(load_named_case("circle-inverse-dynamics"), {});
  BOOST_TEST(twin.difference == 0, twin.worst);
  const Json& mechanism = twin.json["export"]["mechanism"];
  const auto at = [&](const char* joint) {
    return Eigen::Vector2d(mechanism["joints"][joint]["position_m"][0].get<double>(),
                           mechanism["joints"][joint]["position_m"][1].get<double>());
  };
  for (const auto& [name, body] : mechanism["bodies"].items()) {  // middle of a uniform link
    if (name == "platform") continue;
    const Eigen::Vector2d center(body["center_m"][0].get<double>(),
                                 body["center_m"][1].get<double>());
    BOOST_TEST((center - (at(name.substr(0, 2).c_str()) + at(name.substr(3).c_str())) / 2).norm() <
               1e-15);
  }
  BOOST_TEST(mechanism["path"]["pose_m_rad"].size() == mechanism["path"]["time_s"].size());
  const ExportTwin vibrating = export_and_compute_both(load_named_case("elastodynamics-order"), {});
  BOOST_TEST(vibrating.difference == 0, vibrating.worst);
  BOOST_TEST(vibrating.json["export"]["mechanism"]["elastic_model"].contains("members"));
}

// The tip displacement of the cantilever follows from the exported matrices alone. The free
// coordinates are K^-1 f, and T maps them to the displacements u.
BOOST_AUTO_TEST_CASE(exported_matrices_reproduce_the_displacement) {
  const Folder folder;
  const Document document = document_of(cantilever());
  write_system_matrices(document, exported_scene(document), folder.path() / "m");
  const Eigen::MatrixXd K = read_matrix(folder.path() / "m/K.mtx");
  const Eigen::MatrixXd T = read_matrix(folder.path() / "m/T.mtx");
  BOOST_TEST((K - K.transpose()).norm() == 0);
  const Eigen::VectorXd u = T * K.ldlt().solve(read_matrix(folder.path() / "m/f.mtx"));
  const std::string table = read_text(folder.path() / "m/coordinates.csv");
  const std::size_t line = table.rfind('\n', table.find(",y_m,\"B\"")) + 1;
  const double tip = only(analyze_json(cantilever()), "displacement_y_m:B");
  BOOST_TEST(u[std::stol(table.substr(line)) - 1] == tip, boost::test_tools::tolerance(1e-10));
  BOOST_TEST(read_matrix(folder.path() / "m/M.mtx").rows() == K.rows());
  BOOST_TEST(!std::filesystem::exists(folder.path() / "m/C.mtx"));
  const std::string mesh = read_text(folder.path() / "m/mesh.vtu");
  BOOST_TEST(contains(mesh, "NumberOfPoints=\"5\" NumberOfCells=\"4\""));
}

BOOST_AUTO_TEST_CASE(trammel_computes_an_exported_case_as_an_adapter) {
  const Folder folder;
  const auto at = [&](const char* name) { return (folder.path() / name).string(); };
  const std::string program = testing::trammel_program();
  BOOST_REQUIRE(std::system((program + " export portal-frame --out " + at("c.json")).c_str()) == 0);
  BOOST_REQUIRE(std::system((program + " solve " + at("c.json") + " " + at("r.json")).c_str()) ==
                0);
  const Json result = read_json(at("r.json"));
  const ExportTwin twin = export_and_compute_both(load_named_case("portal-frame"), {});
  BOOST_TEST(result["status"] == "solved");
  BOOST_TEST(result["quantities"].size() == twin.json["export"]["quantities"].size());
  for (const auto& [name, quantity] : result["quantities"].items()) {
    BOOST_TEST(quantity["unit"] == unit_of(name));
    BOOST_TEST((quantity["values"] == twin.exported.quantities.at(name).values), name);
  }
}

BOOST_AUTO_TEST_SUITE_END()
