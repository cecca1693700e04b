#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "tests/support/harness/analysing.h"

BOOST_AUTO_TEST_SUITE(rotating_state)

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

/// A mass of 1 kg at 1 m along y on springs of 100 and 400 N/m.
Json mass_on_springs() {
  return Json::parse(R"({
    "id": "mass", "title": "A mass on springs",
    "model": {
      "nodes": {"P": [0, 1]},
      "point_masses": {"m": {"node": "P", "mass_kg": 1}},
      "springs": {"k": {"nodes": ["P"], "stiffness_N_per_m": [100, 400]}}
    },
    "analysis": {"modes": {"count": 2, "rotating": {"angular_speed_rad_s": 5}}}
  })");
}

}  // namespace

BOOST_AUTO_TEST_CASE(one_speed_gives_the_modes_of_that_speed) {
  const AnalysisResult result = result_of(mass_on_springs());
  // (100 - 25 - w^2)(400 - 25 - w^2) = 4 * 25 w^2
  const double sum = 75 + 375 + 100;
  const double root = std::sqrt(sum * sum - 4 * 75.0 * 375.0);
  for (const int i : {0, 1}) {
    const double square = (sum + (i == 0 ? -root : root)) / 2;
    BOOST_TEST(values(result, "frequency_Hz")[static_cast<std::size_t>(i)] ==
                   std::sqrt(square) / (2 * std::numbers::pi),
               tolerance(1e-12));
  }
  BOOST_TEST(values(result, "steady_displacement_y_m:P")[0] == 25.0 / (400 - 25), tolerance(1e-12));
  BOOST_TEST(values(result, "stable")[0] == 1);
}

BOOST_AUTO_TEST_CASE(several_speeds_give_one_number_each) {
  Json json = mass_on_springs();
  json["analysis"]["modes"]["rotating"]["angular_speed_rad_s"] = {0, 5, 9.99, 10.01};
  const AnalysisResult result = result_of(json);
  for (const auto& [name, quantity] : result.quantities) {
    if (name != "degrees_of_freedom") BOOST_TEST(quantity.values.size() == 4, name);
  }
  BOOST_TEST(values(result, "angular_speed_rad_s")[2] == 9.99);
  BOOST_TEST(values(result, "frequency_Hz:1")[0] == 10 / (2 * std::numbers::pi), tolerance(1e-12));
  BOOST_TEST(values(result, "stable")[2] == 1);
  BOOST_TEST(values(result, "stable")[3] == 0);
  BOOST_TEST(values(result, "growth_rate_per_s:1")[3] > 0);
  BOOST_TEST(values(result, "growth_rate_per_s:1")[2] == 0);
  BOOST_TEST(unit_of("growth_rate_per_s:1") == "1/s");
}

BOOST_AUTO_TEST_CASE(the_words_of_the_rotation_are_understood) {
  Json json = mass_on_springs();
  Json& rotating = json["analysis"]["modes"]["rotating"];
  rotating["coriolis"] = false;
  const auto squares = [&] {
    const AnalysisResult result = result_of(json);
    std::vector<double> all;
    for (const double f : values(result, "frequency_Hz")) {
      all.push_back(std::pow(2 * std::numbers::pi * f, 2));
    }
    return all;
  };
  const auto near = tolerance(1e-12);
  BOOST_TEST(squares()[0] == 75, near);
  BOOST_TEST(squares()[1] == 375, near);
  rotating["axis"] = "x";  // pulls along y alone
  BOOST_TEST(squares()[0] == 100, near);
  BOOST_TEST(squares()[1] == 375, near);
  rotating["axis"] = "y";
  BOOST_TEST(squares()[0] == 75, near);
  BOOST_TEST(squares()[1] == 400, near);
  rotating["axis"] = "normal";
  rotating["center_m"] = {0, 2};
  const AnalysisResult other = result_of(json);
  BOOST_TEST(values(other, "steady_displacement_y_m:P")[0] == -25.0 / 375, near);
}

BOOST_AUTO_TEST_CASE(the_tension_of_a_stretched_blade_exceeds_that_of_a_stiff_one) {
  Json json = testing::cantilever();
  json["model"].erase("loads");
  json["model"]["materials"]["steel"]["E_Pa"] = 2e8;
  const auto first = [&](const char* tension) {
    json["analysis"] = {
        {"modes",
         {{"count", 1},
          {"rotating",
           {{"angular_speed_rad_s", 20}, {"axis", "y"}, {"prestress_configuration", tension}}}}}};
    const AnalysisResult result = result_of(json);
    return values(result, "frequency_Hz")[0];
  };
  const double undeformed = first("undeformed");
  const double deformed = first("deformed");
  BOOST_TEST(deformed > undeformed);
  // The strain is about rho W^2 L^2 / 2E = 0.03.
  BOOST_TEST(deformed == undeformed, tolerance(0.03));
}

BOOST_AUTO_TEST_CASE(what_cannot_stand_beside_a_rotation_is_refused) {
  Json json = mass_on_springs();
  json["analysis"]["modes"]["prestressed"] = true;
  BOOST_TEST(contains(complaint([&] { (void)result_of(json); }),
                      "/analysis/modes/prestressed: expected it without 'rotating'"));
  json["analysis"]["modes"]["prestressed"] = false;
  BOOST_TEST(complaint([&] { (void)result_of(json); }).empty());
  json["analysis"]["modes"]["count_below_Hz"] = 10;
  BOOST_TEST(contains(complaint([&] { (void)result_of(json); }),
                      "/analysis/modes/count_below_Hz: expected it without 'rotating'"));
  Json robot = testing::manipulator();
  robot["model"].erase("pose");
  robot["model"]["trajectory"]["circle"] = {
      {"center_m", {0.25, 0.144}}, {"radius_m", 0.01}, {"points", 3}, {"step_s", 0.5}};
  robot["analysis"]["modes"]["rotating"]["angular_speed_rad_s"] = 1;
  BOOST_TEST(contains(complaint([&] { (void)result_of(robot); }),
                      "/analysis/modes/rotating: expected a model at one place"));
}

BOOST_AUTO_TEST_SUITE_END()
