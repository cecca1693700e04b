// ctest: labels=verification
#include "references/frames/wittrick_williams.h"

#include <boost/test/unit_test.hpp>
#include <string>

#include "references/frames/dynamic_stiffness.h"
#include "tests/support/references/frames.h"

BOOST_AUTO_TEST_SUITE(wittrick_williams)

using namespace trammel::references;
using namespace trammel::testing;

namespace {

/// Returns a frame of eight arms with a common joint. The tips of the arms are pinned.
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

BOOST_AUTO_TEST_CASE(frequency_count_rises_by_the_root_multiplicity) {
  const Frame frame = frame_from_arguments(Arguments({{"model", double_cross()}}, ""));
  const auto found = frame_frequencies(frame, 8);
  BOOST_TEST(found.rigid_motions == 0);
  BOOST_TEST(count_frequencies_below(frame, found.frequencies[3] * (1 - Real(1e-13))) == 3);
  BOOST_TEST(count_frequencies_below(frame, found.frequencies[3] * (1 + Real(1e-13))) == 8);
}

BOOST_AUTO_TEST_CASE(stiff_spring_is_a_weld_and_soft_one_a_hinge) {
  const auto with = [](const char* end) {
    return frequencies(
        beam_model((std::string(R"({"supports": {"A": ["x", "y", "rotation"], "B": ["x", "y"]},
          "members": {"AB": {"ends": [)") +
                    end + R"(, "welded"]}}})")
                       .c_str()),
        4);
  };
  check_equality(with(R"({"spring_N_m_per_rad": 1e16})"), with(R"("welded")"), 1e-10);
  check_equality(with(R"({"spring_N_m_per_rad": 1e-9})"), with(R"("hinged")"), 1e-10);
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
  check_equality(frequencies(model(3e5), 6), frequencies(inextensible, 6), 1e-11);
  BOOST_TEST(frequencies(model(3e-4), 6)[5] < frequencies(inextensible, 6)[5]);
}

BOOST_AUTO_TEST_SUITE_END()
