// ctest: labels=verification
// Derivation programs with their own characteristic equation, compared with independently computed
// values of 15 or more digits and with known limiting cases.
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>

#include "references/programs/program.h"
#include "tests/support/references/frames.h"

BOOST_AUTO_TEST_SUITE(characteristic_equations)

using namespace trammel::references;
using namespace trammel::testing;
using boost::test_tools::tolerance;

BOOST_AUTO_TEST_CASE(clamped_corner_has_the_known_exponent) {
  // Szabo and Babuska (1991), Finite Element Analysis, state the exponent 0.71117 for the corner of
  // a square with nu = 0.3.
  const auto square = run("wedge-exponent", R"({"clamped_side": [0, -1], "free_side": [1, 0],
                                                "nu": 0.3, "plane": "strain"})");
  BOOST_TEST(std::abs(square.at(0) - 0.71117) < 1e-5);
  // For nu = 0, the clamped side does not constrain uniaxial tension normal to this side. The
  // exponent of a right-angled corner is therefore 1.
  for (const char* plane : {"stress", "strain"}) {
    const std::string arguments =
        R"({"clamped_side": [3, 0], "free_side": [0, 2], "nu": 0, "plane": ")" +
        std::string(plane) + "\"}";
    check_equality(run("wedge-exponent", arguments.c_str()), {1}, 1e-15);
  }
}

BOOST_AUTO_TEST_CASE(elastica_output_column_is_scaled_by_the_length) {
  const auto all = run("elastica-tip-force", R"({"load_parameter": [1, 10]})");
  check_equality(run("elastica-tip-force",
                     R"({"load_parameter": [1, 10], "output": "shortening", "length_m": 3})"),
                 {3 * all[1], 3 * all[4]}, 4e-16);
  check_equality(run("elastica-tip-force", R"({"load_parameter": [1, 10], "output": "angle"})"),
                 {all[2], all[5]}, 4e-16);
  const auto column = run("elastica-column", R"({"tip_angle_deg": [60, 120]})");
  check_equality(
      run("elastica-column", R"({"tip_angle_deg": [60, 120], "output": "axial", "length_m": 2})"),
      {2 * column[2], 2 * column[5]}, 4e-16);
}

BOOST_AUTO_TEST_CASE(deep_beam_under_load_agrees_with_closed_forms) {
  const auto response = [](const char* rest) {
    Json arguments = Json::parse(R"({"length_m": 10, "thickness_m": 2, "width_m": 2, "E_Pa": 2e11,
      "rho_kg_m3": 8000, "nu": 0.3, "shear_coefficient": 0.8496732026143791,
      "load_N_per_m": 1e6})");
    arguments.merge_patch(Json::parse(rest));
    return derive_values("deep-beam-response", arguments);
  };
  const double bending = 5 * 1e6 * 1e4 / (384 * 2e11 * 4 / 3);
  const double shear = 1e6 * 100 / (8 * 0.8496732026143791 * 2e11 / 2.6 * 4);
  check_equality(response(R"({"response": "static", "outputs": ["displacement_m", "stress_Pa"]})"),
                 {bending + shear, 9.375e6}, 1e-10);
  check_equality(response(R"({"response": "harmonic-peak", "damping_ratio": 0.02,
                           "outputs": ["displacement_m", "stress_Pa", "frequency_Hz"]})"),
                 {13.489e-3, 242.55e6, 42.628}, 4e-5);
  check_equality(response(R"({"response": "step-peak", "damping_ratio": 0.02,
                           "outputs": ["displacement_m", "time_s"]})"),
                 {1.04188e-3, 0.01156}, 8e-4);
  const double undamped =
      response(R"({"response": "step-peak", "outputs": ["displacement_m"]})")[0];
  BOOST_TEST(undamped > 1.95 * (bending + shear));
  BOOST_TEST(undamped < 2.05 * (bending + shear));
}

BOOST_AUTO_TEST_SUITE_END()
