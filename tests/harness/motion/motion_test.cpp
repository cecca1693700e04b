#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "tests/support/harness/analysing.h"

BOOST_AUTO_TEST_SUITE(motion)

using namespace trammel;
using namespace trammel::testing;
using boost::test_tools::tolerance;

namespace {

double last(const AnalysisResult& result, const std::string& name) {
  return values(result, name).back();
}

/// Returns a mass of 1 kg on a spring of 100 N/m along x (w = 10 rad/s) under 1 N.
Json oscillator_case() {
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
  Json json = oscillator_case();
  json["analysis"] = Json::parse(
      R"({"harmonic": {"from_Hz": 1, "to_Hz": 2, "points": 11, "outputs": ["displacement_x_m:P"],
                       "damping": {"modal": {"ratio": 0.05, "modes": 1}}}})");
  return json;
}

}  // namespace

BOOST_AUTO_TEST_CASE(resonance_without_damping_has_no_peak) {
  Json json = harmonic();
  json["analysis"]["harmonic"].erase("damping");
  BOOST_TEST(std::isnan(last(analyze_json(json), "peak_displacement_x_m:P")));
  BOOST_TEST(last(analyze_json(json), "peak_frequency_Hz:displacement_x_m:P") ==
                 10 / (2 * std::numbers::pi),
             tolerance(1e-9));
  json["analysis"]["harmonic"]["damping"]["modal"] = {{"ratio", 0}, {"modes", 1}};
  BOOST_TEST(std::isnan(last(analyze_json(json), "peak_displacement_x_m:P")));
  json["analysis"]["harmonic"].erase("damping");
  json["analysis"]["harmonic"]["to_Hz"] = 1.5;  // below the natural frequency of 10 rad/s
  const double w = 2 * std::numbers::pi * 1.5 / 10;
  BOOST_TEST(last(analyze_json(json), "peak_displacement_x_m:P") == 0.01 / (1 - w * w),
             tolerance(1e-10));
}

// At 1, 1.5 and 2 Hz, damping changes the response by 1e-4. At the resonance, 10 rad/s = 1.59 Hz,
// damping determines the response.
BOOST_AUTO_TEST_CASE(automatic_effects_keep_damping_of_a_response) {
  Json json = harmonic();
  json["analysis"]["harmonic"]["points"] = 3;
  json["analysis"]["harmonic"]["damping"]["modal"]["ratio"] = 0.001;
  const double peak = last(analyze_json(json), "peak_displacement_x_m:P");
  json["effects"] = {{"auto", {{"tolerance", 0.05}}}};
  BOOST_TEST(last(analyze_json(json), "peak_displacement_x_m:P") == peak, tolerance(1e-6));
}

BOOST_AUTO_TEST_SUITE_END()
