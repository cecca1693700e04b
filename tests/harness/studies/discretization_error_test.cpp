#include "harness/studies/discretization_error.h"

#include <boost/test/unit_test.hpp>

#include "harness/input/catalogue.h"
#include "harness/studies/accuracy_search.h"
#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(discretization_error)

using namespace trammel;
using namespace trammel::harness;
using testing::cantilever;
using testing::contains;
using testing::document_of;
using testing::Folder;
using testing::input_error_message;

namespace {

struct Estimated {
  AnalysisResult result;
  results::ErrorEstimates errors;

  [[nodiscard]] const results::ErrorEstimate& of(const std::string& quantity) const {
    const auto found =
        std::ranges::find(errors.quantities, quantity, &results::ErrorEstimate::quantity);
    BOOST_TEST_REQUIRE((found != errors.quantities.end()), quantity << ": " << errors.reason);
    return *found;
  }
  [[nodiscard]] const std::vector<double>& values(const std::string& quantity) const {
    return result.quantities.at(quantity).values;
  }
};

Estimated estimate(const Json& json) {
  const References references;
  const Document document = document_of(json);
  Estimated found{analyze(document, references, {}), {}};
  BOOST_TEST_REQUIRE(found.result.outcome.solved());
  found.errors = estimate_errors(document, found.result, references);
  return found;
}

/// Returns a manipulator without a specified mesh, as a new user writes it.
Json user_manipulator() {
  return Json::parse(R"({
    "id": "own-manipulator", "title": "Own 3-RRR",
    "model": {
      "manipulator": {
        "base_side_m": 0.8,
        "links": {"proximal_length_m": 0.35, "distal_length_m": 0.3, "thickness_m": 0.003,
                  "width_m": 0.025},
        "platform": {"kind": "rigid", "side_m": 0.2, "thickness_m": 0.005},
        "material": {"E_Pa": 2.1e11, "rho_kg_m3": 7850, "nu": 0.3},
        "joints": {"active": "locked", "elbow": "hinged", "platform": "hinged"}
      },
      "pose": {"x_m": 0.4, "y_m": 0.23, "phi_rad": 0}
    },
    "analysis": {"modes": {"count": 6}}
  })");
}

Json with_links(Json json, int elements) {
  json["model"]["manipulator"]["links"]["elements"] = elements;
  return json;
}

Json vibrating_cantilever() {
  Json json = cantilever();
  json["analysis"] = Json::parse(R"({"transient": {"duration_s": 0.1, "step_s": 1e-3,
    "samples": 50, "outputs": ["displacement_y_m:B"]}})");
  return json;
}

}  // namespace

BOOST_AUTO_TEST_CASE(error_bands_of_frequencies_contain_converged_values) {
  const std::vector<double> converged =
      estimate(with_links(user_manipulator(), 32)).values("frequency_Hz");
  for (const Json& json : {user_manipulator(), with_links(user_manipulator(), 1),
                           with_links(user_manipulator(), 2), with_links(user_manipulator(), 6)}) {
    const Estimated found = estimate(json);
    const results::ErrorEstimate& error = found.of("frequency_Hz");
    for (std::size_t mode = 0; mode < converged.size(); ++mode) {
      const double computed = found.values("frequency_Hz")[mode];
      BOOST_TEST(std::abs(computed - converged[mode]) <= *error.error_half_width(mode, computed),
                 "mode " << mode << ": " << computed << " against " << converged[mode]);
    }
  }
}

BOOST_AUTO_TEST_CASE(default_mesh_is_accurate_and_a_coarse_one_warns) {
  const std::vector<double> converged =
      estimate(with_links(user_manipulator(), 32)).values("frequency_Hz");
  const Estimated by_default = estimate(user_manipulator());
  for (std::size_t mode = 0; mode < converged.size(); ++mode)
    BOOST_TEST(by_default.values("frequency_Hz")[mode] == converged[mode],
               boost::test_tools::tolerance(1e-3));
  BOOST_TEST(error_warnings(by_default.errors, 0.01).empty());
  const auto warnings = error_warnings(estimate(with_links(user_manipulator(), 1)).errors, 0.01);
  BOOST_TEST_REQUIRE(!warnings.empty());
  BOOST_TEST(contains(warnings.front(), "frequency_Hz[3, 4 and 5]"));
  BOOST_TEST(contains(warnings.front(), "/model/manipulator/links/elements"));
}

// The error estimate compares four elements with two elements: 1.3 elements per half wave of mode
// 2.
BOOST_AUTO_TEST_CASE(mode_with_few_elements_per_half_wave_has_order_two) {
  Json json = cantilever();
  json["analysis"] = {{"modes", {{"count", 2}}}};
  for (const int elements : {4, 8}) {
    json["model"]["elements"] = elements;
    BOOST_TEST(*estimate(json).of("frequency_Hz").order == (elements == 4 ? 2 : 4));
  }
}

BOOST_AUTO_TEST_CASE(motion_without_a_given_step_controls_its_error) {
  Json json = vibrating_cantilever();
  json["analysis"]["transient"].erase("step_s");
  const Folder folder;
  const auto motion = [&] {
    return patched(load_case(folder.write(json)), kBaseVariant).value()["analysis"]["transient"];
  };
  BOOST_TEST(motion()["error_control"]["relative"] == 1e-4);
  BOOST_TEST(motion()["step_s"] == 1e-4);
  json["analysis"]["transient"]["step_s"] = 1e-3;
  BOOST_TEST(!motion().contains("error_control"));
}

BOOST_AUTO_TEST_CASE(nodal_values_of_linear_statics_are_exact) {
  const Estimated found = estimate(cantilever());
  BOOST_TEST(!found.of("displacement_y_m:B").order.has_value());
  BOOST_TEST(*found.of("displacement_y_m:B").relative.front() < 1e-10);
}

// Beck's column stays straight: its displacements and rotations are round-off.
BOOST_AUTO_TEST_CASE(round_off_of_a_straight_member_gives_no_warning) {
  Json json = cantilever();
  Json& model = json["model"];
  const double c = std::cos(0.7), s = std::sin(0.7), force_N = 8e-4;  // near EI/L^2 = 8.3e-4 N
  json["analysis"] = {{"large-statics", {{"load_factors", {10, 19, 20, 25}}}}};
  model["sections"]["bar"]["rectangle"]["thickness_m"] = 1e-4;
  model["members"]["AB"]["axial"] = "inextensible";
  model["nodes"]["B"] = {c, s};
  model["elements"] = 16;
  model.erase("loads");
  model["follower_loads"]["tip"] = {{"node", "B"}, {"force_N", {-force_N * c, -force_N * s}}};
  BOOST_TEST(error_warnings(estimate(json).errors, 0.01).empty());
}

BOOST_AUTO_TEST_CASE(error_of_odd_element_count_uses_twice_the_elements) {
  Json json = cantilever();
  json["analysis"] = {{"modes", {{"count", 3}}}};
  json["model"]["elements"] = 3;
  const Estimated found = estimate(json);
  BOOST_TEST(found.errors.companions == "twice the elements");
  json["model"]["elements"] = 24;
  const std::vector<double> converged = estimate(json).values("frequency_Hz");
  for (std::size_t mode = 0; mode < 3; ++mode) {
    const double computed = found.values("frequency_Hz")[mode];
    BOOST_TEST(std::abs(computed - converged[mode]) <=
               *found.of("frequency_Hz").error_half_width(mode, computed));
  }
}

BOOST_AUTO_TEST_CASE(relative_errors_do_not_depend_on_units) {
  Json json = cantilever();
  json["analysis"] = {{"modes", {{"count", 3}}}};
  const Estimated meters = estimate(json);
  constexpr double kLength = 1e3, kMass = 1e-3;  // units mm and t instead of m and kg
  Json& model = json["model"];
  model["materials"]["steel"]["E_Pa"] = 2e11 * kMass / kLength;
  model["materials"]["steel"]["rho_kg_m3"] = 7800 * kMass / (kLength * kLength * kLength);
  model["sections"]["bar"]["rectangle"] = {{"thickness_m", 100}, {"width_m", 50}};
  model["nodes"]["B"] = {2000, 0};
  const Estimated millimeters = estimate(json);
  for (std::size_t mode = 0; mode < 3; ++mode)
    BOOST_TEST(
        *millimeters.of("frequency_Hz").relative[mode] == *meters.of("frequency_Hz").relative[mode],
        boost::test_tools::tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(error_bands_of_time_steps_contain_the_exact_motion) {
  Json exact = vibrating_cantilever();
  exact["analysis"]["transient"]["method"] = "modal-superposition";
  exact["model"]["elements"] = 16;
  const std::vector<double> truth = estimate(exact).values("displacement_y_m:B");
  for (const double step_s : {1e-3, 5e-4, 1e-4, -1e-3}) {  // negative: maximum step
    Json json = vibrating_cantilever();
    json["analysis"]["transient"]["step_s"] = std::abs(step_s);
    if (step_s < 0) json["analysis"]["transient"]["error_control"]["relative"] = 10;
    const Estimated found = estimate(json);
    const std::vector<double>& computed = found.values("displacement_y_m:B");
    const double allowed = *found.of("displacement_y_m:B").error_half_width(0, 0);
    for (std::size_t i = 0; i < truth.size(); ++i)
      BOOST_TEST_REQUIRE(std::abs(computed[i] - truth[i]) <= allowed,
                         "step " << step_s << " s, sample " << i);
  }
}

/// Tests the error estimate of a motion whose time steps have the length of the sampling interval,
/// because the tolerance of the error control permits longer steps.
BOOST_AUTO_TEST_CASE(time_steps_limited_by_samples_have_an_error) {
  const std::string name = "displacement_x_m:P";
  Json json = user_manipulator();
  json.merge_patch(Json::parse(R"({"model": {"pose": null, "trajectory": {"circle": {"points": 41,
    "center_m": [0.4, 0.23], "radius_m": 0.02, "step_s": 0.005, "angular_speed_rad_s": 31.4}}},
    "analysis": {"modes": null, "elastodynamics": {"initial_state": "quasi-static",
                                                   "error_control": {"relative": 10}}}})"));
  const Estimated limited = estimate(json);
  const AccuracySearch search = search_accuracy(document_of(json), {1e-3, {name}, 60}, {});
  json["analysis"]["elastodynamics"] = {{"initial_state", "quasi-static"}, {"step_s", 2e-5}};
  const std::vector<double> truth = estimate(with_links(json, 16)).values(name);
  const double allowed = *limited.of(name).error_half_width(0, 0), size = std::ranges::max(truth);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    BOOST_TEST(std::abs(limited.values(name)[i] - truth[i]) <= allowed);
    BOOST_TEST(std::abs(search.result.quantities.at(name).values[i] - truth[i]) <= 1e-3 * size);
  }
}

BOOST_AUTO_TEST_CASE(accuracy_search_reaches_the_requested_error) {
  const References references;
  const std::vector<double> converged =
      estimate(with_links(user_manipulator(), 64)).values("frequency_Hz");
  for (const double accuracy : {1e-2, 1e-4, 1e-6}) {
    const AccuracySearch search =
        search_accuracy(document_of(user_manipulator()), {accuracy, {}, 60}, references);
    BOOST_TEST(*search.errors.search.back().error <= accuracy);
    const std::vector<double>& found = search.result.quantities.at("frequency_Hz").values;
    double largest = 0;
    for (std::size_t mode = 0; mode < converged.size(); ++mode)
      largest = std::max(largest, std::abs(found[mode] / converged[mode] - 1));
    BOOST_TEST(largest <= accuracy);
    // Three levels confirm the order of convergence, so that the safety factor is 1.25.
    if (accuracy < 1e-2) BOOST_TEST(*search.errors.search.back().error <= 1.5 * largest);
  }
}

BOOST_AUTO_TEST_CASE(accuracy_search_refines_mesh_and_time_step) {
  const References references;
  const AccuracySearch search =
      search_accuracy(document_of(vibrating_cantilever()), {1e-3, {}, 60}, references);
  BOOST_TEST(search.reached);
  BOOST_TEST(search.tried.size() > 3U);
}

BOOST_AUTO_TEST_CASE(unreachable_accuracy_and_invalid_search_are_reported) {
  const References references;
  const AccuracySearch search =
      search_accuracy(document_of(user_manipulator()), {1e-14, {}, 60}, references);
  BOOST_TEST(!search.reached);
  BOOST_TEST(!search.errors.reason.empty());
  const auto refusal = [&](const Json& json, const std::string& quantity) {
    return input_error_message([&] {
      (void)search_accuracy(document_of(json), {1e-3, {quantity}, 60}, references);
    });
  };
  BOOST_TEST(contains(refusal(user_manipulator(), "frequncy_Hz"), "did you mean 'frequency_Hz'"));
  BOOST_TEST(contains(refusal(user_manipulator(), "degrees_of_freedom"), "an estimated error"));
  Json rigid = user_manipulator();
  rigid["analysis"] = {{"kinematics", Json::object()}};
  BOOST_TEST(contains(refusal(rigid, "time_s"), "no mesh and no time step"));
}

BOOST_AUTO_TEST_CASE(default_element_count_depends_on_analysis_and_member) {
  Json json = cantilever();
  json["model"].erase("elements");
  BOOST_TEST(element_count_of(document_of(json), "AB") == 1);
  json["analysis"] = {{"modes", {{"count", 1}}}};
  BOOST_TEST(element_count_of(document_of(json), "AB") == 4);
  json["model"]["sections"]["tip"] = json["model"]["sections"]["bar"];
  json["model"]["members"]["AB"]["end_section"] = "tip";
  BOOST_TEST(element_count_of(document_of(json), "AB") == 8);
  json["model"]["members"]["AB"].erase("end_section");
  json["model"]["nodes"]["B"] = {0, 2};
  json["model"]["members"]["AB"]["arc_center_m"] = {0, 1};
  BOOST_TEST(element_count_of(document_of(json), "AB") == 24);  // the member is a half circle
  json["model"]["elements"] = 3;
  BOOST_TEST(element_count_of(document_of(json), "AB") == 3);
}

BOOST_AUTO_TEST_CASE(numbers_in_a_wrong_unit_cause_a_warning) {
  Json json = user_manipulator();
  json["model"]["pose"]["phi_rad"] = 30;
  BOOST_TEST(contains(unit_warnings(document_of(json)).at(0), "/model/pose/phi_rad is 30 rad"));
  json = user_manipulator();
  json["model"]["manipulator"]["links"]["distal_length_m"] = 300;
  BOOST_TEST(contains(unit_warnings(document_of(json)).at(0),
                      "/model/manipulator/links/distal_length_m is 300 m"));
  json = user_manipulator();
  json["model"]["manipulator"]["links"]["thickness_m"] = 3;
  BOOST_TEST(
      contains(unit_warnings(document_of(json)).at(0), "links/thickness_m exceeds a length"));
  json = cantilever();
  json["model"]["nodes"]["C"] = {1500, 0};
  json["model"]["members"]["BC"] = {{"nodes", {"B", "C"}}, {"section", "bar"}};
  BOOST_TEST(contains(unit_warnings(document_of(json)).at(0), "/model/nodes/C is 1500 m"));
}

BOOST_AUTO_TEST_CASE(catalogue_has_no_numbers_in_a_wrong_unit) {
  for (const Case& given : Catalogue().load())
    for (const std::string& variant : given.variants())
      for (const std::string& warning : unit_warnings(patched(given, variant)))
        BOOST_TEST(warning.empty(), given.id() << ":" << variant << ": " << warning);
}

BOOST_AUTO_TEST_CASE(unknown_check_key_entries_suggests_the_key_index) {
  Json json = cantilever();
  json["checks"] = {{"tip",
                     {{"quantity", "displacement_y_m:B"},
                      {"entries", {0}},
                      {"bound", {{"at_most", 1}, {"why", "made up"}}}}}};
  const Folder folder;
  BOOST_TEST(contains(input_error_message([&] { (void)load_case(folder.write(json)); }),
                      "did you mean 'index'"));
}

BOOST_AUTO_TEST_SUITE_END()
