#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "tests/support/harness/analysing.h"

BOOST_AUTO_TEST_SUITE(prestress)

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

constexpr double kPi = std::numbers::pi;
/// Of the cantilever in support.h.
constexpr double kEI = 2e11 * 0.05 * 1e-3 / 12;

/// The cantilever of 2 m with a force along itself at its tip.
Json column(double force) {
  Json json = testing::cantilever();
  json["model"]["elements"] = 16;
  json["model"]["loads"]["tip"]["force_N"] = {force, 0};
  json["analysis"] = {{"buckling", {{"count", 2}}}};
  return json;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_column_buckles_at_the_load_of_euler) {
  const AnalysisResult result = result_of(column(-10));
  const double euler = kPi * kPi * kEI / 16;
  BOOST_TEST(values(result, "load_factor")[0] == euler / 10, tolerance(1e-6));
  BOOST_TEST(values(result, "load_factor")[1] == 9 * euler / 10, tolerance(2e-5));
  BOOST_TEST(values(result, "critical_force_N:tip")[0] == euler, tolerance(1e-6));
  BOOST_REQUIRE(result.drawing.has_value());
  BOOST_TEST(result.drawing->shapes.size() == 2);
  BOOST_TEST(contains(result.drawing->shapes[0].label, "times the loads"));
}

BOOST_AUTO_TEST_CASE(tension_buckles_nothing) {
  const AnalysisResult result = result_of(column(10));
  BOOST_TEST(result.outcome.solved());
  BOOST_TEST(result.quantities.count("load_factor") == 0U);
}

BOOST_AUTO_TEST_CASE(buckling_along_a_path_has_one_number_a_point) {
  Json json = testing::manipulator();
  json["model"].erase("pose");
  json["model"]["trajectory"]["circle"] = {
      {"center_m", {0.25, 0.144}}, {"radius_m", 0.01}, {"points", 3}, {"step_s", 0.5}};
  json["analysis"] = {{"buckling", {{"count", 2}}}};
  const AnalysisResult result = result_of(json);
  BOOST_TEST(values(result, "load_factor:1").size() == 3);
  BOOST_TEST(values(result, "load_factor:2").size() == 3);
  BOOST_TEST(values(result, "critical_force_N:P.1")[1] == 10 * values(result, "load_factor:1")[1],
             tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(compression_lowers_the_frequencies_and_at_the_critical_load_none_is_left) {
  const double euler = kPi * kPi * kEI / 16;
  const auto first = [](double force, bool prestressed) {
    Json json = column(force);
    json["analysis"] = {{"modes", {{"count", 1}, {"prestressed", prestressed}}}};
    const AnalysisResult result = result_of(json);
    return result.outcome.solved() ? values(result, "frequency_Hz")[0] : -1.0;
  };
  const double free = first(-0.5 * euler, false);
  BOOST_TEST(first(0, true) == free, tolerance(1e-10));
  BOOST_TEST(first(0.5 * euler, true) > free);
  // f^2 falls almost linearly with the force; buckling and vibration have different shapes.
  const double half = first(-0.5 * euler, true);
  BOOST_TEST(half * half / (free * free) == 0.5, tolerance(0.05));
  BOOST_TEST(first(-1.01 * euler, true) == -1.0);
}

BOOST_AUTO_TEST_CASE(second_order_statics_magnify_a_deflection_as_one_over_one_less_p_over_euler) {
  Json json = testing::cantilever();
  json["model"]["elements"] = 16;
  const double euler = kPi * kPi * kEI / 16;
  json["model"]["loads"]["tip"]["force_N"] = {-0.5 * euler, 100};
  const AnalysisResult linear = result_of(json);
  const double first = values(linear, "displacement_y_m:B")[0];
  json["analysis"] = {{"statics", {{"second_order", true}}}};
  const AnalysisResult of_second_order = result_of(json);
  const double second = values(of_second_order, "displacement_y_m:B")[0];
  const double u = kPi / 2 * std::sqrt(0.5);
  // Timoshenko and Gere: 3 (tan u - u) / u^3.
  BOOST_TEST(second / first == 3 * (std::tan(u) - u) / (u * u * u), tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(counting_below_a_frequency_is_refused_where_it_would_count_other_modes) {
  Json json = column(-10);
  json["analysis"] = {{"modes", {{"count", 1}, {"prestressed", true}, {"count_below_Hz", 10}}}};
  BOOST_TEST(contains(complaint([&] { (void)result_of(json); }),
                      "/analysis/modes/count_below_Hz: expected it without 'prestressed'"));
}

BOOST_AUTO_TEST_SUITE_END()
