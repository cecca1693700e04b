// ctest: labels=verification
// Programs with a characteristic equation of their own, against values computed elsewhere with 15
// and more digits, and against the limits that physics knows.
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "references/programs/program.h"
#include "tests/support/references/frames.h"

BOOST_AUTO_TEST_SUITE(characteristic_equations)

using namespace trammel::references;
using namespace trammel::testing;
using boost::test_tools::tolerance;

BOOST_AUTO_TEST_CASE(a_clamped_corner_is_as_singular_as_is_known) {
  // B. A. Szabo, I. Babuska, Finite Element Analysis, 1991: 0.71117 for a square, nu = 0.3.
  const auto square = run("wedge-exponent", R"({"clamped_side": [0, -1], "free_side": [1, 0],
                                                "nu": 0.3, "plane": "strain"})");
  BOOST_TEST(std::abs(square.at(0) - 0.71117) < 1e-5);
  // Without Poisson's ratio there is nothing to hold back, turned and mirrored or not.
  for (const char* plane : {"stress", "strain"}) {
    const std::string arguments =
        R"({"clamped_side": [3, 0], "free_side": [0, 2], "nu": 0, "plane": ")" +
        std::string(plane) + "\"}";
    check_equal(run("wedge-exponent", arguments.c_str()), {1}, 1e-15);
  }
}

BOOST_AUTO_TEST_CASE(the_elastica_agrees_with_values_computed_elsewhere) {
  check_equal(run("elastica-tip-force", R"({"load_parameter": [1, 10]})"),
              {0.301720773799814, 0.0564332362833769, 0.461351949711879, 0.810609024880296,
               0.554995597753751, 1.43028553880386},
              4e-15);
  check_equal(run("elastica-column", R"({"tip_angle_deg": [60, 120]})"),
              {1.15171962047, 0.593207646165, -0.258980393924, 1.88480086898, 0.803170990007,
               -0.876840027595},
              1e-11);
}

BOOST_AUTO_TEST_CASE(shooting_along_a_chain_finds_the_elastica) {
  const std::string chain = R"({"nodes_m": [[0, 0], [0.5, 0], [1, 0]], "EI_N_m2": 1,
      "start": ["rotation"], "end": ["free"], "loads": [[2, 0, 1, 0]], "load_factors": [1, 3],
      "outputs": ["displacement_y_m:2", "displacement_x_m:2", "rotation_rad:2"]})";
  const auto exact = run("elastica-tip-force", R"({"load_parameter": [1, 3]})");
  const auto shot = run("elastic-chain", chain.c_str());
  BOOST_REQUIRE(shot.size() == exact.size());
  for (std::size_t i = 0; i < shot.size(); ++i)
    BOOST_TEST(std::abs(shot[i] + (i % 3 == 1 ? exact[i] : -exact[i])) < 1e-12);
}

BOOST_AUTO_TEST_CASE(loads_that_follow_a_column_make_it_flutter_where_bolotin_says) {
  check_equal(run("becks-column", R"({"output": "flutter-load"})"), {20.050953618973761}, 1e-14);
  BOOST_TEST(std::abs(run("becks-column", R"({"output": "flutter-load", "load": "spread"})")[0] -
                      40.054) < 5e-4);
}

BOOST_AUTO_TEST_CASE(one_column_of_the_elastica_table_comes_with_its_length) {
  const auto all = run("elastica-tip-force", R"({"load_parameter": [1, 10]})");
  check_equal(run("elastica-tip-force",
                  R"({"load_parameter": [1, 10], "output": "shortening", "length_m": 3})"),
              {3 * all[1], 3 * all[4]}, 4e-16);
  check_equal(run("elastica-tip-force", R"({"load_parameter": [1, 10], "output": "angle"})"),
              {all[2], all[5]}, 4e-16);
  const auto column = run("elastica-column", R"({"tip_angle_deg": [60, 120]})");
  check_equal(
      run("elastica-column", R"({"tip_angle_deg": [60, 120], "output": "axial", "length_m": 2})"),
      {2 * column[2], 2 * column[5]}, 4e-16);
}

BOOST_AUTO_TEST_CASE(a_small_load_bends_the_elastica_like_the_linear_beam) {
  const auto small = run("elastica-tip-force", R"({"load_parameter": [1e-6]})");
  check_equal({small[0], small[2]}, {1e-6 / 3, 1e-6 / 2}, 1e-11);
  const double load = run("elastica-column", R"({"tip_angle_deg": [1e-6]})")[0];
  BOOST_TEST(load == 1.0, tolerance(1e-15));
}

BOOST_AUTO_TEST_CASE(the_pendulum_agrees_with_values_computed_elsewhere) {
  check_equal(run("pendulum", R"({"length_m": 1, "gravity_m_s2": 9.81, "start_angle_deg": -90,
                                  "output": "position", "times_s": [1, 10]})"),
              {0.986291751131875, -0.165010853125541, -0.275087462576117, -0.961419205099125},
              4e-15);
  const double small = run("pendulum", R"({"length_m": 1, "gravity_m_s2": 9.81,
                                           "start_angle_deg": 1e-4, "output": "period"})")[0];
  BOOST_TEST(small == 2 * std::acos(-1.0) / std::sqrt(9.81), tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(the_chain_of_four_bars_agrees_with_values_computed_elsewhere) {
  const auto chain = [](const char* output) {
    return derive("parallelogram-chain", {{"loops", 40},
                                          {"length_m", 1},
                                          {"gravity_m_s2", 9.81},
                                          {"start_speed_m_s", 1},
                                          {"times_s", {1, 10, 20}},
                                          {"output", output}});
  };
  check_equal(chain("position"),
              {-0.11535688063211, -0.99332411130045, 0.18051222668673, 0.98357274058231,
               0.41090115376295, 0.91167990097198},
              5e-13);
  check_equal(chain("velocity"),
              {-6.6699875239418, 0.77460009866234, 1.1484412774694, -0.21077006677942,
               1.5667853719091, -0.70616223559384},
              5e-13);
}

BOOST_AUTO_TEST_CASE(the_exponential_beam_agrees_with_values_computed_elsewhere) {
  check_equal(run("exponential-beam", R"({"length_m": 0.6, "thickness_m": 0.01,
                  "width_rate_1_m": 2, "E_Pa": 2e11, "rho_kg_m3": 7800, "count": 5})"),
              {145.877073, 400.295106, 783.231892, 1293.57216, 1931.44663}, 5e-9);
  // code_aster's Timoshenko elements, to all their digits
  check_equal(run("exponential-beam", R"({"length_m": 0.6, "thickness_m": 0.01,
                  "width_rate_1_m": 2, "E_Pa": 2e11, "rho_kg_m3": 7800, "count": 4,
                  "beam": "timoshenko", "nu": 0.3, "shear_coefficient": 0.833333333333})"),
              {145.592, 398.511, 777.115, 1278.01}, 1e-5);
}

BOOST_AUTO_TEST_CASE(without_taper_the_exponential_beam_is_the_uniform_one) {
  const auto uniform = derive("beam-frequencies", {{"ends", "clamped-clamped"},
                                                   {"count", 3},
                                                   {"length_m", 1},
                                                   {"E_Pa", 6.9e10},
                                                   {"rho_kg_m3", 2700},
                                                   {"thickness_m", 0.01},
                                                   {"width_m", 0.03}});
  check_equal(run("exponential-beam", R"({"length_m": 1, "thickness_m": 0.01, "width_rate_1_m": 0,
                  "E_Pa": 6.9e10, "rho_kg_m3": 2700, "count": 3})"),
              uniform, 1e-14);
  const Json timoshenko = beam_model(R"({"members": {"AB": {"beam": "timoshenko"}},
    "sections": {"bar": {"shear_coefficient": 0.8}},
    "supports": {"A": ["x", "y", "rotation"], "B": ["x", "y", "rotation"]}})");
  check_equal(run("exponential-beam", R"({"length_m": 1, "thickness_m": 0.01, "width_rate_1_m": 0,
                  "E_Pa": 6.9e10, "rho_kg_m3": 2700, "count": 3, "beam": "timoshenko",
                  "nu": 0.33, "shear_coefficient": 0.8})"),
              frequencies(timoshenko, 3), 1e-14);
}

BOOST_AUTO_TEST_CASE(the_annulus_agrees_with_values_computed_elsewhere) {
  check_equal(
      run("annular-membrane", R"({"inner_radius_m": 1.8, "outer_radius_m": 6,
                  "E_Pa": 2e11, "rho_kg_m3": 8000, "nu": 0.3,
                  "modes": [[2, 1], [0, 1], [1, 1], [3, 1], [2, 2], [4, 1], [0, 2]]})"),
      {125.6989658, 224.2039408, 232.8686569, 262.7577989, 335.2854689, 375.2882926, 449.9438792},
      3e-10);
}

BOOST_AUTO_TEST_CASE(a_thin_annulus_is_a_ring_in_extension) {
  const double E = 2e11;
  const double rho = 8000;
  const auto f = run("annular-membrane", R"({"inner_radius_m": 0.9995, "outer_radius_m": 1.0005,
                     "E_Pa": 2e11, "rho_kg_m3": 8000, "nu": 0.3, "modes": [[0, 1]]})");
  check_equal(f, {std::sqrt(E / rho) / (2 * std::acos(-1.0))}, 1e-6);
}

BOOST_AUTO_TEST_CASE(the_deep_beam_under_load_has_its_static_closed_form_and_twice_it_undamped) {
  const auto response = [](const char* rest) {
    Json arguments = Json::parse(R"({"length_m": 10, "thickness_m": 2, "width_m": 2, "E_Pa": 2e11,
      "rho_kg_m3": 8000, "nu": 0.3, "shear_coefficient": 0.8496732026143791,
      "load_N_per_m": 1e6})");
    arguments.merge_patch(Json::parse(rest));
    return derive("deep-beam-response", arguments);
  };
  const double bending = 5 * 1e6 * 1e4 / (384 * 2e11 * 4 / 3);
  const double shear = 1e6 * 100 / (8 * 0.8496732026143791 * 2e11 / 2.6 * 4);
  check_equal(response(R"({"response": "static", "outputs": ["displacement_m", "stress_Pa"]})"),
              {bending + shear, 9.375e6}, 1e-10);
  check_equal(response(R"({"response": "harmonic-peak", "damping_ratio": 0.02,
                           "outputs": ["displacement_m", "stress_Pa", "frequency_Hz"]})"),
              {13.489e-3, 242.55e6, 42.628}, 4e-5);
  check_equal(response(R"({"response": "step-peak", "damping_ratio": 0.02,
                           "outputs": ["displacement_m", "time_s"]})"),
              {1.04188e-3, 0.01156}, 8e-4);
  const double undamped =
      response(R"({"response": "step-peak", "outputs": ["displacement_m"]})")[0];
  BOOST_TEST(undamped > 1.95 * (bending + shear));
  BOOST_TEST(undamped < 2.05 * (bending + shear));
}

BOOST_AUTO_TEST_SUITE_END()
