#include <boost/test/unit_test.hpp>

#include "tests/support/harness/analysing.h"

BOOST_AUTO_TEST_SUITE(elastodynamics)

using namespace trammel;
using namespace trammel::testing;

namespace {

/// Returns a motion along a trajectory of the manipulator of Table 1 of Varalakshmi and Srinivas
/// (2017). It has a rigid platform and one element per link.
Json motion(const Json& trajectory) {
  Json json = testing::manipulator();
  json["model"].erase("pose");
  json["model"]["manipulator"]["links"]["elements"] = 1;
  json["model"]["loads"]["P"]["force_N"] = {1, 0};
  json["analysis"] = {{"elastodynamics", {{"step_s", 0.001}, {"initial_state", "quasi-static"}}}};
  json["model"]["trajectory"] = trajectory;
  return json;
}

Json between(const char* kind, double way) {
  Json path = Json::parse(R"({"duration_s": 0.1, "points": 6, "step_s": 0.02,
    "from": {"x_m": 0.25, "y_m": 0.144, "phi_rad": 0}, "to": {"y_m": 0.144, "phi_rad": 0}})");
  path["to"]["x_m"] = 0.25 + way;
  return {{kind, path}};
}

Json& options(Json& json) {
  return json["analysis"]["elastodynamics"];
}

}  // namespace

BOOST_AUTO_TEST_CASE(platform_at_constant_speed_is_not_at_rest) {
  // On a line at constant speed, the characteristic frequency of the path is zero. The moving
  // platform was once treated as resting, and an integration error was computed from the modes of a
  // fixed pose.
  Json json = motion(between("line", 0.01));
  options(json)["step_errors"] = true;
  const AnalysisResult moving = analyze_json(json);
  BOOST_TEST(values(moving, "step_change:P").size() == 6U);
  BOOST_TEST(moving.quantities.count("integration_error:P") == 0U);
  json["model"]["trajectory"] = between("line", 0);
  const AnalysisResult still = analyze_json(json);
  BOOST_TEST(values(still, "integration_error:P").size() == 6U);
}

BOOST_AUTO_TEST_CASE(quasi_static_motion_has_no_work_of_its_loads) {
  // Without elastic inertia, the work of the loads is not computed. The program once reported this
  // work as 0 J, so that the reported energy drift contained the actual work.
  Json json = motion(between("line", 0.01));
  options(json)["effects"] = {{"elastic_inertia", false}};
  const AnalysisResult result = analyze_json(json);
  BOOST_TEST(values(result, "strain_energy_J").size() == 6U);
  for (const char* name : {"load_work_J", "dissipated_energy_J", "energy_drift"})
    BOOST_TEST(result.quantities.count(name) == 0U, name);
}

BOOST_AUTO_TEST_SUITE_END()
