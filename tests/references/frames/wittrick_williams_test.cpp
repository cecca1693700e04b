// ctest: labels=verification
#include "references/frames/wittrick_williams.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <string>
#include <vector>

#include "references/frames/dynamic_stiffness.h"
#include "references/frames/programs.h"
#include "tests/support/references/frames.h"

BOOST_AUTO_TEST_SUITE(wittrick_williams)

using namespace trammel::references;
using namespace trammel::testing;

namespace {

std::vector<double> single_beam(const char* ends, int count) {
  return derive("beam-frequencies", {{"ends", ends},
                                     {"count", count},
                                     {"length_m", 1},
                                     {"E_Pa", 6.9e10},
                                     {"rho_kg_m3", 2700},
                                     {"thickness_m", 0.01},
                                     {"width_m", 0.03}});
}

/// Eight arms about a common joint, pinned at their tips.
Json double_cross() {
  Json model = Json::parse(R"({
    "materials": {"steel": {"E_Pa": 2e11, "rho_kg_m3": 8000}},
    "sections": {"arm": {"material": "steel",
                         "rectangle": {"thickness_m": 0.125, "width_m": 0.125}}},
    "nodes": {"O": [0, 0]}})");
  for (int i = 0; i < 8; ++i) {
    const std::string tip = std::string("P").append(std::to_string(i));
    const double angle = i * std::acos(-1.0) / 4;
    model["nodes"][tip] = {5 * std::cos(angle), 5 * std::sin(angle)};
    model["members"]["O" + tip] = {{"nodes", {"O", tip}}, {"section", "arm"}};
    model["supports"][tip] = {"x", "y"};
  }
  return model;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_frame_of_one_member_has_the_frequencies_of_its_characteristic_equation) {
  const std::vector<std::pair<const char*, const char*>> beams = {
      {"clamped-free", R"({"supports": {"A": ["x", "y", "rotation"]}})"},
      {"clamped-clamped",
       R"({"supports": {"A": ["x", "y", "rotation"], "B": ["x", "y", "rotation"]}})"},
      {"clamped-pinned", R"({"supports": {"A": ["x", "y", "rotation"], "B": ["x", "y"]}})"},
      {"pinned-pinned", R"({"supports": {"A": ["x", "y"], "B": ["x", "y"]}})"},
      {"free-free", R"({"supports": {"A": ["x"]}})"},
      {"clamped-guided", R"({"supports": {"A": ["x", "y", "rotation"], "B": ["x", "rotation"]}})"}};
  for (const auto& [ends, supports] : beams) {
    BOOST_TEST_CONTEXT(ends) {
      check_equal(frequencies(beam_model(supports), 6), single_beam(ends, 6), 4e-16);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_tip_mass_on_a_node_is_that_of_the_characteristic_equation) {
  const Json model = beam_model(R"({"supports": {"A": ["x", "y", "rotation"]},
    "point_masses": {"tip": {"node": "B", "mass_kg": 0.81, "inertia_kg_m2": 0.0081}}})");
  const auto expected = derive("beam-frequencies", {{"ends", "clamped-free"},
                                                    {"count", 4},
                                                    {"tip_mass_ratio", 1},
                                                    {"tip_inertia_ratio", 0.01},
                                                    {"length_m", 1},
                                                    {"E_Pa", 6.9e10},
                                                    {"rho_kg_m3", 2700},
                                                    {"thickness_m", 0.01},
                                                    {"width_m", 0.03}});
  check_equal(frequencies(model, 4), expected, 4e-16);
}

BOOST_AUTO_TEST_CASE(a_cut_member_has_the_frequencies_of_the_whole) {
  const char* const cut = R"({
    "nodes": {"A": [0, 0], "M": [0.3, 0], "B": [1, 0]},
    "members": {"AB": null, "AM": {"nodes": ["A", "M"], "section": "bar"},
                "MB": {"nodes": ["M", "B"], "section": "bar"}},
    "supports": {"A": ["x", "y", "rotation"], "B": ["y"]}})";
  const char* const whole = R"({"supports": {"A": ["x", "y", "rotation"], "B": ["y"]}})";
  check_equal(frequencies(beam_model(cut), 8), frequencies(beam_model(whole), 8), 4e-16);
  const auto stout = [](const char* patch) {
    Json model = beam_model(patch);
    model["sections"]["bar"]["rectangle"]["thickness_m"] = 0.3;
    for (auto& member : model["members"]) member["beam"] = "timoshenko";
    return model;
  };
  check_equal(frequencies(stout(cut), 12), frequencies(stout(whole), 12), 4e-16);
}

BOOST_AUTO_TEST_CASE(the_double_cross_has_all_its_repeated_frequencies) {
  const std::vector<double> expected = {11.33625, 17.68077, 17.68077, 17.70938, 17.70938, 17.70938,
                                        17.70938, 17.70938, 45.34498, 57.07456, 57.07456, 57.38973,
                                        57.38973, 57.38973, 57.38973, 57.38973};
  const auto found = frequencies(double_cross(), 16);
  check_equal(found, expected, 4e-7);
  BOOST_TEST(std::abs(found[7] - found[3]) < 1e-13);
}

BOOST_AUTO_TEST_CASE(a_deep_beam_agrees_with_the_timoshenko_values_computed_elsewhere) {
  Json model = beam_model(R"({"supports": {"A": ["x", "y"], "B": ["y"]}, "nodes": {"B": [10, 0]},
    "materials": {"aluminium": {"E_Pa": 2e11, "rho_kg_m3": 8000, "nu": 0.3}},
    "sections": {"bar": {"rectangle": {"thickness_m": 2, "width_m": 2}}},
    "members": {"AB": {"beam": "timoshenko"}}})");
  check_equal(frequencies(model, 4), {42.608717, 125.0, 147.78601, 282.36338}, 2e-8);
  model["sections"]["bar"]["shear_coefficient"] = 13 / 15.3;  // Cowper, square
  check_equal(frequencies(model, 4), {42.644909, 125.0, 148.14934, 283.46839}, 4e-8);
}

BOOST_AUTO_TEST_CASE(shear_waves_above_their_cut_on_are_counted) {
  // Pinned ends: every frequency of both branches is known in closed form.
  const Json model = beam_model(R"({"supports": {"A": ["x", "y"], "B": ["x", "y"]},
    "sections": {"bar": {"rectangle": {"thickness_m": 0.3}}},
    "members": {"AB": {"beam": "timoshenko", "axial": "flexible"}}})");
  const double E = 6.9e10;
  const double rho = 2700;
  const double kG = 5.0 / 6 * E / (2 * 1.33);
  const double i2 = 0.3 * 0.3 / 12;
  std::vector<double> expected = {std::sqrt(kG / rho / i2)};  // rotation alone
  for (int n = 1; n <= 40; ++n) {
    const double a2 = std::pow(n * std::acos(-1.0), 2);
    const double b = kG / rho * (a2 + 1 / i2) + E / rho * a2;
    const double c = kG * E / rho / rho * a2 * a2;
    const double upper = (b + std::sqrt(b * b - 4 * c)) / 2;
    expected.push_back(std::sqrt(upper));
    expected.push_back(std::sqrt(c / upper));
    expected.push_back(std::sqrt(E / rho * a2));
  }
  std::sort(expected.begin(), expected.end());
  expected.resize(30);
  for (double& w : expected) w /= 2 * std::acos(-1.0);
  check_equal(frequencies(model, 30), expected, 1e-13);
}

BOOST_AUTO_TEST_CASE(the_folded_cantilever_has_the_frequencies_computed_elsewhere) {
  const Json model = beam_model(R"({"nodes": {"B": [0.5, 0], "C": [0, 0]},
    "materials": {"aluminium": {"E_Pa": 2.1e11, "rho_kg_m3": 7800}},
    "sections": {"bar": {"rectangle": {"thickness_m": 0.005, "width_m": 0.05}}},
    "members": {"BC": {"nodes": ["B", "C"], "section": "bar"}},
    "supports": {"A": ["x", "y", "rotation"]}})");
  check_equal(frequencies(model, 1), {11.764178}, 4e-8);
}

BOOST_AUTO_TEST_CASE(the_count_steps_by_the_multiplicity_at_each_frequency) {
  const Frame frame = read_frame(double_cross(), "");
  const auto found = frame_frequencies(frame, 8);
  BOOST_TEST(found.rigid_motions == 0);
  BOOST_TEST(frequencies_below(frame, found.frequencies[3] * (1 - Real(1e-13))) == 3);
  BOOST_TEST(frequencies_below(frame, found.frequencies[3] * (1 + Real(1e-13))) == 8);
}

BOOST_AUTO_TEST_CASE(a_rigid_body_carries_its_member_as_an_offset_mass_is_carried) {
  const Json body = beam_model(R"({"nodes": {"P": [1.1, 0.2]},
    "supports": {"A": ["x", "y", "rotation"]},
    "rigid_bodies": {"tip": {"reference": "P", "nodes": ["B"]}},
    "point_masses": {"m": {"node": "P", "mass_kg": 0.5, "inertia_kg_m2": 0.004}}})");
  const Json offset = beam_model(R"({"supports": {"A": ["x", "y", "rotation"]},
    "point_masses": {"m": {"node": "B", "mass_kg": 0.5, "inertia_kg_m2": 0.004,
                           "offset_m": [0.1, 0.2]}}})");
  check_equal(frequencies(body, 8), frequencies(offset, 8), 4e-16);
}

BOOST_AUTO_TEST_CASE(a_stiff_spring_is_a_weld_and_a_soft_one_a_hinge) {
  const auto with = [](const char* end) {
    return frequencies(
        beam_model((std::string(R"({"supports": {"A": ["x", "y", "rotation"], "B": ["x", "y"]},
          "members": {"AB": {"ends": [)") +
                    end + R"(, "welded"]}}})")
                       .c_str()),
        4);
  };
  check_equal(with(R"({"spring_N_m_per_rad": 1e16})"), with(R"("welded")"), 1e-10);
  check_equal(with(R"({"spring_N_m_per_rad": 1e-9})"), with(R"("hinged")"), 1e-10);
}

BOOST_AUTO_TEST_CASE(turning_the_whole_frame_changes_no_frequency) {
  const Json turned = beam_model(R"({"nodes": {"B": [0.6, 0.8]},
    "supports": {"A": ["x", "y", "rotation"]}})");
  check_equal(frequencies(turned, 8),
              frequencies(beam_model(R"({"supports": {"A": ["x", "y", "rotation"]}})"), 8), 4e-16);
}

BOOST_AUTO_TEST_CASE(inextensible_members_are_the_limit_of_stiff_ones) {
  const auto model = [](double area) {
    Json m = beam_model(R"({"sections": {"bar": {"rectangle": null}},
      "nodes": {"B": [0, 1], "C": [1, 1]}, "supports": {"A": ["x", "y", "rotation"]},
      "members": {"BC": {"nodes": ["B", "C"], "section": "bar"}}})");
    m["sections"]["bar"]["area_m2"] = area;
    m["sections"]["bar"]["second_moment_m4"] = 2.5e-9;
    m["materials"]["aluminium"]["rho_kg_m3"] = 0.81 / area;
    return m;
  };
  Json inextensible = model(3e-4);
  for (auto& member : inextensible["members"]) member["axial"] = "inextensible";
  check_equal(frequencies(model(3e5), 6), frequencies(inextensible, 6), 1e-11);
  BOOST_TEST(frequencies(model(3e-4), 6)[5] < frequencies(inextensible, 6)[5]);
}

BOOST_AUTO_TEST_SUITE_END()
