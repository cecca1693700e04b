#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "tests/support/harness/analysing.h"

BOOST_AUTO_TEST_SUITE(motion)

using namespace trammel;
using namespace trammel::references;
using namespace trammel::solver;
using namespace trammel::harness;
using boost::test_tools::tolerance;
using testing::complaint;
using testing::contains;
using testing::result_of;
using testing::values;

namespace {

double last(const AnalysisResult& result, const std::string& name) {
  return values(result, name).back();
}

/// 1 kg on a spring of 100 N/m along x (w = 10 rad/s) under 1 N.
Json oscillator() {
  return Json::parse(R"({
    "id": "oscillator", "title": "A mass on a spring",
    "model": {
      "nodes": {"P": [0, 0]},
      "point_masses": {"m": {"node": "P", "mass_kg": 1}},
      "springs": {"k": {"nodes": ["P"], "stiffness_N_per_m": [100, 0]}},
      "supports": {"P": ["y"]},
      "loads": {"F": {"node": "P", "force_N": [1, 0]}}
    },
    "analysis": {"transient": {"duration_s": 0.5, "step_s": 0.001, "outputs": ["displacement_x_m:P"]}}
  })");
}

Json harmonic() {
  Json json = oscillator();
  json["analysis"] = {{"harmonic",
                       {{"from_Hz", 1},
                        {"to_Hz", 2},
                        {"points", 11},
                        {"damping", {{"modal", {{"ratio", 0.05}, {"modes", 1}}}}},
                        {"outputs", {"displacement_x_m:P"}}}}};
  return json;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_step_swings_to_twice_the_static_displacement) {
  for (const char* method : {"average-acceleration", "linear-acceleration", "central-difference",
                             "modal-superposition"}) {
    Json json = oscillator();
    json["analysis"]["transient"]["method"] = method;
    const AnalysisResult result = result_of(json);
    BOOST_TEST(values(result, "time_s").size() == 501, method);
    BOOST_TEST(last(result, "time_s") == 0.5);
    BOOST_TEST(last(result, "displacement_x_m:P") == 0.01 * (1 - std::cos(5.0)), tolerance(2e-4));
    BOOST_TEST(last(result, "peak_displacement_x_m:P") == 0.02, tolerance(1e-5));
    BOOST_TEST(last(result, "peak_time_s:displacement_x_m:P") == std::numbers::pi / 10,
               tolerance(1e-4));
  }
}

BOOST_AUTO_TEST_CASE(every_method_with_numbers_is_understood) {
  for (const Json& method : {Json{{"newmark", {{"beta", 0.3}, {"gamma", 0.6}}}},
                             Json{{"hht_alpha", -0.1}}, Json{{"spectral_radius", 0.5}}}) {
    Json json = oscillator();
    json["analysis"]["transient"]["method"] = method;
    BOOST_TEST(last(result_of(json), "displacement_x_m:P") == 0.01 * (1 - std::cos(5.0)),
               tolerance(2e-3));
  }
  Json json = oscillator();
  json["analysis"]["transient"]["error_control"] = {{"relative", 1e-5}};
  json["analysis"]["transient"]["step_s"] = 0.1;
  json["analysis"]["transient"]["samples"] = 10;
  const AnalysisResult result = result_of(json);
  BOOST_TEST(values(result, "time_s").size() == 11);
  BOOST_TEST(last(result, "steps") > 50);
  BOOST_TEST(last(result, "displacement_x_m:P") == 0.01 * (1 - std::cos(5.0)), tolerance(1e-4));
}

BOOST_AUTO_TEST_CASE(a_history_multiplies_the_loads) {
  Json json = oscillator();
  Json& transient = json["analysis"]["transient"];
  transient["method"] = "modal-superposition";
  // A pulse of 0.1 s: two steps, the second taken back.
  transient["load_history"] = {{"time_s", {0, 0.1, 0.1}}, {"factor", {1, 1, 0}}};
  BOOST_TEST(last(result_of(json), "displacement_x_m:P") == 0.01 * (std::cos(4.0) - std::cos(5.0)),
             tolerance(1e-10));
  // A ramp up to 0.2 s.
  transient["load_history"] = {{"time_s", {0, 0.2}}, {"factor", {0, 1}}};
  const double ramp = 0.01 * (1 - (std::sin(5.0) - std::sin(3.0)) / 2);
  BOOST_TEST(last(result_of(json), "displacement_x_m:P") == ramp, tolerance(1e-10));
  transient["method"] = "average-acceleration";
  BOOST_TEST(last(result_of(json), "displacement_x_m:P") == ramp, tolerance(1e-4));
}

BOOST_AUTO_TEST_CASE(a_motion_starts_from_rest_from_statics_or_with_a_velocity) {
  Json json = oscillator();
  Json& transient = json["analysis"]["transient"];
  transient["method"] = "modal-superposition";
  transient["initial_state"] = "static-equilibrium";
  BOOST_TEST(last(result_of(json), "displacement_x_m:P") == 0.01, tolerance(1e-10));
  transient["load_history"] = {{"time_s", {0}}, {"factor", {0}}};
  BOOST_TEST(last(result_of(json), "displacement_x_m:P") == 0.01 * std::cos(5.0), tolerance(1e-10));
  transient["initial_state"] = {{"velocity_m_per_s", {2, 7}}};  // held along y
  transient["outputs"] = {"displacement_x_m:P", "velocity_x_m_per_s:P", "acceleration_x_m_per_s2:P",
                          "displacement_y_m:P"};
  const AnalysisResult result = result_of(json);
  BOOST_TEST(last(result, "displacement_x_m:P") == 0.2 * std::sin(5.0), tolerance(1e-10));
  BOOST_TEST(last(result, "velocity_x_m_per_s:P") == 2 * std::cos(5.0), tolerance(1e-10));
  BOOST_TEST(last(result, "acceleration_x_m_per_s2:P") == -20 * std::sin(5.0), tolerance(1e-10));
  BOOST_TEST(last(result, "displacement_y_m:P") == 0);
  BOOST_TEST(last(result, "kinetic_energy_J") + last(result, "strain_energy_J") == 2,
             tolerance(1e-10));
}

BOOST_AUTO_TEST_CASE(damping_by_modes_and_by_rayleigh_are_one_for_one_mode) {
  for (const char* method : {"average-acceleration", "modal-superposition"}) {
    Json json = oscillator();
    Json& transient = json["analysis"]["transient"];
    transient["method"] = method;
    transient["damping"] = {{"modal", {{"ratio", {0.2}}}}};
    const double modal = last(result_of(json), "displacement_x_m:P");
    transient["damping"] = {{"rayleigh", {{"mass_per_s", 2}, {"stiffness_s", 0.02}}}};
    BOOST_TEST(last(result_of(json), "displacement_x_m:P") == modal, tolerance(1e-9));
    const double w = 10 * std::sqrt(1 - 0.04);
    const double exact = 0.01 * (1 - std::exp(-1.0) * (std::cos(w / 2) + 2 / w * std::sin(w / 2)));
    BOOST_TEST(modal == exact, tolerance(2e-5));
  }
}

BOOST_AUTO_TEST_CASE(what_has_no_mass_follows_its_load_at_once) {
  Json json = oscillator();
  json["model"]["nodes"]["Q"] = {1, 0};
  json["model"]["springs"]["l"] = {{"nodes", {"P", "Q"}}, {"stiffness_N_per_m", {50, 0}}};
  json["model"]["supports"]["Q"] = {"y"};
  json["model"]["loads"]["F"]["node"] = "Q";
  json["analysis"]["transient"]["method"] = "modal-superposition";
  json["analysis"]["transient"]["outputs"] = {"displacement_x_m:P", "displacement_x_m:Q"};
  const AnalysisResult result = result_of(json);
  BOOST_TEST(last(result, "displacement_x_m:P") == 0.01 * (1 - std::cos(5.0)), tolerance(1e-9));
  BOOST_TEST(last(result, "displacement_x_m:Q") - last(result, "displacement_x_m:P") == 0.02,
             tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(section_forces_hold_the_inertia_of_what_they_move) {
  // A bar set in motion by 1000 N at its tip: at the support sum of forces and inertia.
  Json json = testing::cantilever();
  json["model"]["loads"]["tip"]["force_N"] = {1000, 0};
  json["analysis"] = {{"transient",
                       {{"duration_s", 2e-3},
                        {"step_s", 1e-6},
                        {"outputs",
                         {"axial_force_N:AB.end", "axial_force_N:AB.start",
                          "bending_stress_Pa:AB.start", "stress_Pa:AB"}}}}};
  const AnalysisResult result = result_of(json);
  for (const double N : values(result, "axial_force_N:AB.end")) {
    BOOST_TEST(N == 1000, tolerance(1e-6));
  }
  double largest = 0;
  for (const double N : values(result, "axial_force_N:AB.start")) largest = std::max(largest, N);
  // The step is doubled where it is reflected; four elements overshoot.
  BOOST_TEST(largest > 1900);
  BOOST_TEST(largest < 3000);
  BOOST_TEST(last(result, "peak_stress_Pa:AB") >= largest / 0.005 * (1 - 1e-9));
}

BOOST_AUTO_TEST_CASE(at_its_peak_a_damped_oscillator_is_magnified) {
  const AnalysisResult result = result_of(harmonic());
  const double ratio = 0.05;
  BOOST_TEST(values(result, "frequency_Hz").size() == 11);
  BOOST_TEST(values(result, "displacement_x_m:P").size() == 11);
  BOOST_TEST(
      last(result, "peak_displacement_x_m:P") == 0.01 / (2 * ratio * std::sqrt(1 - ratio * ratio)),
      tolerance(1e-10));
  BOOST_TEST(last(result, "peak_frequency_Hz:displacement_x_m:P") ==
                 10 * std::sqrt(1 - 2 * ratio * ratio) / (2 * std::numbers::pi),
             tolerance(1e-6));
  BOOST_TEST(last(result, "natural_frequency_Hz") == 10 / (2 * std::numbers::pi), tolerance(1e-12));
  const double w = 2 * std::numbers::pi * 2 / 10;
  BOOST_TEST(last(result, "displacement_x_m:P") == 0.01 / std::hypot(1 - w * w, 2 * ratio * w),
             tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(a_resonance_without_damping_has_no_peak) {
  Json json = harmonic();
  json["analysis"]["harmonic"].erase("damping");
  BOOST_TEST(std::isnan(last(result_of(json), "peak_displacement_x_m:P")));
  BOOST_TEST(
      last(result_of(json), "peak_frequency_Hz:displacement_x_m:P") == 10 / (2 * std::numbers::pi),
      tolerance(1e-9));
  json["analysis"]["harmonic"]["damping"]["modal"] = {{"ratio", 0}, {"modes", 1}};
  BOOST_TEST(std::isnan(last(result_of(json), "peak_displacement_x_m:P")));
  json["analysis"]["harmonic"].erase("damping");
  json["analysis"]["harmonic"]["to_Hz"] = 1.5;  // below 10 rad/s
  const double w = 2 * std::numbers::pi * 1.5 / 10;
  BOOST_TEST(last(result_of(json), "peak_displacement_x_m:P") == 0.01 / (1 - w * w),
             tolerance(1e-10));
}

// At 1, 1.5 and 2 Hz it changes a ten-thousandth, at 10 rad/s everything.
BOOST_AUTO_TEST_CASE(automatic_effects_keep_the_damping_of_a_harmonic_response) {
  Json json = harmonic();
  json["analysis"]["harmonic"]["points"] = 3;
  json["analysis"]["harmonic"]["damping"]["modal"]["ratio"] = 0.001;
  const double peak = last(result_of(json), "peak_displacement_x_m:P");
  json["effects"] = {{"auto", {{"tolerance", 0.05}}}};
  BOOST_TEST(last(result_of(json), "peak_displacement_x_m:P") == peak, tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(a_wrong_output_is_answered_with_the_right_one) {
  Json json = oscillator();
  Json& outputs = json["analysis"]["transient"]["outputs"];
  const auto answer = [&] { return complaint([&] { (void)result_of(json); }); };
  outputs = {"displacment_x_m:P"};
  BOOST_TEST(contains(answer(), "/analysis/transient/outputs/0: expected a quantity"));
  BOOST_TEST(contains(answer(), "did you mean 'displacement_x_m'?"));
  outputs = {"displacement_x_m:Q"};
  BOOST_TEST(contains(answer(), "expected the name of a node after the colon (got 'Q')"));
  outputs = {"displacement_x_m"};
  BOOST_TEST(contains(answer(), "expected the name of a node after the colon (got '')"));
  outputs = {"bending_moment_N_m:AB"};
  BOOST_TEST(contains(answer(), "expected an end of the member"));
  outputs = {"stress_Pa:AB"};
  BOOST_TEST(contains(answer(), "expected the name of a member"));
}

BOOST_AUTO_TEST_CASE(a_bending_stress_needs_the_depth_of_the_section) {
  Json json = testing::cantilever();
  json["model"]["sections"]["bar"] = {
      {"material", "steel"}, {"area_m2", 5e-3}, {"second_moment_m4", 4e-6}};
  const auto answer = [&](const char* output) {
    json["analysis"] = {
        {"transient", {{"duration_s", 0.01}, {"step_s", 0.001}, {"outputs", {output}}}}};
    return complaint([&] { (void)result_of(json); });
  };
  BOOST_TEST(answer("bending_moment_N_m:AB.start") == "");
  BOOST_TEST(contains(answer("bending_stress_Pa:AB.start"),
                      "/outputs/0: expected a member whose sections have a depth"));
}

BOOST_AUTO_TEST_CASE(a_response_without_meaning_is_refused_where_it_stands) {
  const auto answer = [](const Json& json) { return complaint([&] { (void)result_of(json); }); };
  Json json = oscillator();
  Json& transient = json["analysis"]["transient"];
  transient["load_history"] = {{"time_s", {0, 1}}, {"factor", {1}}};
  BOOST_TEST(contains(answer(json), "/load_history/factor: expected 2 numbers"));
  transient["load_history"] = {{"time_s", {1, 0}}, {"factor", {1, 1}}};
  BOOST_TEST(contains(answer(json), "/load_history/time_s/1: expected times that ascend"));
  transient.erase("load_history");
  transient["damping"] = {{"modal", {{"ratio", 0.1}, {"modes", 2}}}};
  BOOST_TEST(contains(answer(json), "/damping/modal: expected at most 1 modes (got 2)"));
  transient["damping"] = {{"modal", {{"ratio", 0.1}}}};
  BOOST_TEST(contains(answer(json), "/damping/modal: expected the key 'modes'"));
  transient["damping"] = {{"modal", {{"ratio", {0.1}}, {"modes", 1}}}};
  BOOST_TEST(contains(answer(json), "/damping/modal/modes: expected it beside one ratio only"));
  transient["damping"] = {{"modal", {{"ratio", 0.1}, {"modes", "all"}}}};
  BOOST_TEST(contains(answer(json), "/damping/modal/modes: expected a number"));
  transient["method"] = "modal-superposition";
  BOOST_TEST(answer(json).empty());
  transient["error_control"] = {{"relative", 1e-4}};
  BOOST_TEST(contains(answer(json), "/error_control: expected it without 'modal-superposition'"));
  json = oscillator();
  json["analysis"]["transient"]["step_s"] = 1e-12;
  BOOST_TEST(contains(answer(json), "/step_s: expected at most ten million steps"));
  json = harmonic();
  json["analysis"]["harmonic"]["to_Hz"] = 1;
  BOOST_TEST(contains(answer(json), "/to_Hz: expected more than 'from_Hz'"));
  json = harmonic();
  json["analysis"]["harmonic"]["damping"]["modal"]["modes"] = 3;
  BOOST_TEST(contains(answer(json), "/analysis/harmonic/damping: there are 3 damping ratios"));
}

BOOST_AUTO_TEST_CASE(section_forces_in_a_rotating_frame_are_refused) {
  Json json = testing::cantilever();
  json["analysis"] = {
      {"transient",
       {{"duration_s", 0.1},
        {"step_s", 0.01},
        {"rotating_frame", {{"law", {{"spin_up", {{"speed_per_s", 5}, {"duration_s", 0.1}}}}}}},
        {"outputs", {"displacement_x_m:B"}}}}};
  json["model"].erase("loads");
  BOOST_TEST(testing::result_of(json).outcome.solved());
  json["analysis"]["transient"]["outputs"] = {"axial_force_N:AB.start"};
  BOOST_TEST(contains(complaint([&] { (void)testing::result_of(json); }),
                      "/analysis/transient/outputs: expected motions alone"));
}

BOOST_AUTO_TEST_SUITE_END()
