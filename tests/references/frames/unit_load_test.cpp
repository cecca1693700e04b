// ctest: labels=verification
#include "references/frames/unit_load.h"

#include <boost/test/unit_test.hpp>
#include <string>
#include <vector>

#include "tests/support/references/frames.h"

BOOST_AUTO_TEST_SUITE(unit_load)

using namespace trammel::references;
using namespace trammel::testing;
using boost::test_tools::tolerance;

namespace {

const double EI = 6.9e10 * 0.03 * 1e-6 / 12;
const double EA = 6.9e10 * 3e-4;

std::vector<double> statics(const Json& model, const std::vector<std::string>& outputs) {
  return derive("frame-statics", {{"model", model}, {"outputs", outputs}});
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_cantilever_bends_as_the_closed_forms_say) {
  const Json model = beam_model(R"({"supports": {"A": ["x", "y", "rotation"]},
    "members": {"AB": {"load_N_per_m": [0, -2]}},
    "loads": {"tip": {"node": "B", "force_N": [5, -1], "moment_N_m": 3}}})");
  check_equal(
      statics(model, {"displacement_x_m:B", "displacement_y_m:B", "rotation_rad:B",
                      "reaction_x_N:A", "reaction_y_N:A", "reaction_moment_N_m:A",
                      "bending_moment_N_m:AB.start", "bending_moment_N_m:AB.end"}),
      {5 / EA, (-1.0 / 3 - 2.0 / 8 + 3.0 / 2) / EI, (-1.0 / 2 - 2.0 / 6 + 3) / EI, -5, 3, -1, 1, 3},
      1e-14);
}

BOOST_AUTO_TEST_CASE(an_indeterminate_beam_has_the_textbook_moments) {
  const Json clamped = beam_model(R"({"supports": {"A": ["x", "y", "rotation"],
    "B": ["x", "y", "rotation"]}, "members": {"AB": {"load_N_per_m": [0, -12]}}})");
  check_equal(statics(clamped, {"bending_moment_N_m:AB.start", "reaction_moment_N_m:A",
                                "reaction_moment_N_m:B", "reaction_y_N:B"}),
              {-1, 1, -1, 6}, 1e-14);
  const Json propped = beam_model(R"({"supports": {"A": ["x", "y", "rotation"], "B": ["y"]},
    "members": {"AB": {"load_N_per_m": [0, -8]}}})");
  check_equal(statics(propped, {"reaction_y_N:A", "reaction_y_N:B", "reaction_moment_N_m:A",
                                "rotation_rad:B"}),
              {5, 3, 1, 8 / (48 * EI)}, 1e-14);
}

BOOST_AUTO_TEST_CASE(shear_adds_its_share_to_the_tip_of_a_timoshenko_cantilever) {
  const Json model = beam_model(R"({"supports": {"A": ["x", "y", "rotation"]},
    "members": {"AB": {"beam": "timoshenko"}},
    "loads": {"tip": {"node": "B", "force_N": [0, 1]}}})");
  const double kGA = 5.0 / 6 * EA / (2 * 1.33);
  check_equal(statics(model, {"displacement_y_m:B", "rotation_rad:B"}),
              {1 / (3 * EI) + 1 / kGA, 1 / (2 * EI)}, 1e-14);
}

BOOST_AUTO_TEST_CASE(the_displacement_is_the_same_however_the_frame_is_turned) {
  const Json flat = beam_model(R"({"supports": {"A": ["x", "y", "rotation"]},
    "members": {"AB": {"load_N_per_m": [0, 3]}},
    "loads": {"tip": {"node": "B", "force_N": [2, 1]}}})");
  const Json turned = beam_model(R"({"nodes": {"B": [0.6, 0.8]},
    "supports": {"A": ["x", "y", "rotation"]},
    "members": {"AB": {"load_N_per_m": [-2.4, 1.8]}},
    "loads": {"tip": {"node": "B", "force_N": [0.4, 2.2]}}})");
  const auto u = statics(flat, {"displacement_x_m:B", "displacement_y_m:B", "rotation_rad:B"});
  check_equal(statics(turned, {"displacement_x_m:B", "displacement_y_m:B", "rotation_rad:B"}),
              {0.6 * u[0] - 0.8 * u[1], 0.8 * u[0] + 0.6 * u[1], u[2]}, 1e-13);
}

BOOST_AUTO_TEST_CASE(maxwell_reciprocity_holds_on_the_manipulator) {
  const auto response = [](const char* load, const char* output) {
    Json arguments = manipulator(R"({"pose": {"x_m": 0.26, "phi_rad": 0.2}})");
    arguments["loads"] = {{"one", Json::parse(load)}};
    arguments["outputs"] = {output};
    return derive("frame-statics", arguments)[0];
  };
  BOOST_TEST(response(R"({"node": "P", "force_N": [1, 0]})", "displacement_y_m:B1") ==
                 response(R"({"node": "B1", "force_N": [0, 1]})", "displacement_x_m:P"),
             tolerance(1e-12));
  BOOST_TEST(response(R"({"node": "P", "moment_N_m": 1})", "displacement_y_m:P") ==
                 response(R"({"node": "P", "force_N": [0, 1]})", "rotation_rad:P"),
             tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(the_loaded_manipulator_is_in_equilibrium) {
  const Json arguments = manipulator(R"({
    "loads": {"P": {"node": "P", "force_N": [10, 0]}},
    "outputs": ["reaction_x_N:A1", "reaction_x_N:A2", "reaction_x_N:A3", "reaction_y_N:A1",
                "reaction_y_N:A2", "reaction_y_N:A3"]})");
  const auto r = derive("frame-statics", arguments);
  BOOST_TEST(r[0] + r[1] + r[2] == -10.0, tolerance(1e-14));
  BOOST_TEST(std::abs(r[3] + r[4] + r[5]) < 1e-13);
}

BOOST_AUTO_TEST_CASE(self_weight_bends_like_the_uniform_load_it_is) {
  const Json weight = beam_model(R"({"supports": {"A": ["x", "y", "rotation"]},
    "gravity_m_s2": [0, -10], "point_masses": {"m": {"node": "B", "mass_kg": 0.3}}})");
  const Json load = beam_model(R"({"supports": {"A": ["x", "y", "rotation"]},
    "members": {"AB": {"load_N_per_m": [0, -8.1]}},
    "loads": {"m": {"node": "B", "force_N": [0, -3]}}})");
  check_equal(statics(weight, {"displacement_y_m:B"}), statics(load, {"displacement_y_m:B"}),
              1e-15);
}

BOOST_AUTO_TEST_CASE(springs_and_sprung_ends_give_what_their_stiffness_says) {
  const Json ground = beam_model(R"({"supports": {"A": ["x"]},
    "springs": {"a": {"nodes": ["A"], "stiffness_N_per_m": [0, 100]},
                "b": {"nodes": ["B"], "stiffness_N_per_m": [0, 50]}},
    "loads": {"tip": {"node": "B", "force_N": [0, 1]}}})");
  check_equal(statics(ground, {"displacement_y_m:B"}), {0.02}, 1e-14);
  const Json sprung = beam_model(R"({"supports": {"A": ["x", "y", "rotation"]},
    "members": {"AB": {"ends": [{"spring_N_m_per_rad": 40}, "welded"]}},
    "loads": {"tip": {"node": "B", "force_N": [0, 1]}}})");
  check_equal(
      statics(sprung, {"displacement_y_m:B", "end_rotation_rad:AB.start", "rotation_rad:A"}),
      {1 / (3 * EI) + 1.0 / 40, 1.0 / 40, 0}, 1e-14);
}

BOOST_AUTO_TEST_CASE(a_mechanism_is_an_error_and_not_a_number) {
  const Json model = beam_model(R"({"supports": {"A": ["x", "y"]},
    "loads": {"tip": {"node": "B", "force_N": [0, 1]}}})");
  BOOST_CHECK_THROW(static_cast<void>(statics(model, {"displacement_y_m:B"})), DerivationError);
}

BOOST_AUTO_TEST_SUITE_END()
