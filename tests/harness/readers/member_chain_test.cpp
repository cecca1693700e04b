#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "harness/readers/model_reader.h"
#include "harness/scene/case_model.h"
#include "solver/elements/frame_element.h"
#include "tests/support/harness/analysing.h"

BOOST_AUTO_TEST_SUITE(member_chain)

using namespace trammel;
using namespace trammel::testing;
using boost::test_tools::tolerance;

namespace {

/// Returns a beam along a quarter circle of radius 1 m about the origin from A to B, clamped at A,
/// with a force at B.
Json quarter(Index elements) {
  Json json = testing::cantilever();
  json["model"]["nodes"] = {{"A", {1, 0}}, {"B", {0, 1}}};
  json["model"]["members"]["AB"]["arc_center_m"] = {0, 0};
  json["model"]["elements"] = elements;
  json["model"]["loads"]["tip"]["force_N"] = {0, -1000};
  return json;
}

}  // namespace

BOOST_AUTO_TEST_CASE(arc_is_divided_into_equal_chords) {
  const Model model = build_model(read_case_model(document_of(quarter(6))), 0);
  BOOST_REQUIRE(model.members.size() == 6);
  BOOST_TEST(model.nodes.size() == 7);
  BOOST_TEST(model.members[0].name == "AB.1");
  BOOST_TEST(model.members[5].name == "AB.6");
  for (const Node& node : model.nodes) BOOST_TEST(node.position.norm() == 1, tolerance(1e-14));
  const double chord = 2 * std::sin(std::numbers::pi / 24);
  for (const Member& member : model.members) {
    const Vector2d span = model.nodes[static_cast<std::size_t>(member.nodes[1])].position -
                          model.nodes[static_cast<std::size_t>(member.nodes[0])].position;
    BOOST_TEST(span.norm() == chord, tolerance(1e-12));
  }
}

BOOST_AUTO_TEST_CASE(arc_with_swapped_nodes_is_the_complementary_arc) {
  Json json = quarter(6);
  json["model"]["members"]["AB"]["nodes"] = {"B", "A"};
  const Model model = build_model(read_case_model(document_of(json)), 0);
  bool left = false;
  for (const Node& node : model.nodes) left = left || node.position.x() < -0.5;
  BOOST_TEST(left);
}

BOOST_AUTO_TEST_CASE(intermediate_nodes_have_no_quantities) {
  const AnalysisResult result = analyze_json(quarter(4));
  for (const auto& [name, quantity] : result.quantities) {
    BOOST_TEST(name.back() != ':', name);
    BOOST_TEST(quantity.values.size() == 1, name);
  }
  BOOST_TEST(
      only(result, "bending_moment_N_m:AB.1.start") == -only(result, "reaction_moment_N_m:A"),
      tolerance(1e-9));
}

// Tests the section of a tapered member halfway between two rectangular sections. Area and second
// moment of area were once interpolated linearly. Frequencies of a strip tapered 5 : 1 were wrong
// by up to 178 %.
BOOST_AUTO_TEST_CASE(rectangular_tapers_have_linear_depth_and_width) {
  Json json = testing::cantilever();
  json["model"]["sections"]["thin"] = {{"material", "steel"},
                                       {"rectangle", {{"thickness_m", 0.02}, {"width_m", 0.03}}}};
  json["model"]["members"]["AB"]["end_section"] = "thin";
  const auto half_way = [&] {
    return section_at(build_model(read_case_model(document_of(json)), 0).members[0], 0.5);
  };
  const double E = 2e11, t = 0.06, w = 0.04;
  BOOST_TEST(half_way().area == w * t, tolerance(1e-14));
  BOOST_TEST(half_way().EI == E * w * t * t * t / 12, tolerance(1e-14));
  BOOST_TEST(half_way().section_modulus == w * t * t / 6, tolerance(1e-14));
  BOOST_TEST(half_way().inertia_per_length == 7800 * w * t * t * t / 12, tolerance(1e-14));
  json["model"]["members"]["AB"]["taper"] = "linear-area-and-inertia";
  BOOST_TEST(half_way().area == (0.1 * 0.05 + 0.02 * 0.03) / 2, tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(parts_with_one_name_are_refused_with_their_pointer) {
  for (const char* name : {"AB.1", "AB.6", "AB.start", "AB.end", "total", "at-B"}) {
    Json json = quarter(6);
    json["model"]["point_masses"]["m"] = {{"node", "B"}, {"mass_kg", 1}};
    json["model"]["members"][name] = {{"nodes", {"A", "B"}},
                                      {"section", json["model"]["members"]["AB"]["section"]}};
    const auto read = [&] { return read_case_model(document_of(json)); };
    BOOST_TEST(contains(input_error_message(read), "/model/members/"), name);
    BOOST_TEST(contains(input_error_message(read), "two parts have the name"), name);
  }
}

BOOST_AUTO_TEST_CASE(similar_names_of_different_parts_are_accepted) {
  for (const char* name : {"AB.7", "AB.0", "AB.01", "AB1", "at-B", "A.1"}) {
    Json json = quarter(6);
    json["model"]["members"][name] = {{"nodes", {"A", "B"}},
                                      {"section", json["model"]["members"]["AB"]["section"]}};
    BOOST_CHECK_NO_THROW(static_cast<void>(read_case_model(document_of(json))));
  }
}

BOOST_AUTO_TEST_SUITE_END()
