#include "harness/scene/case_model.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(case_model)

using namespace trammel;
using namespace trammel::solver;
using namespace trammel::harness;
using testing::complaint;
using testing::contains;
using testing::Folder;

namespace {

CaseModel case_model_of(const Json& json) {
  const Folder folder;
  return read_case_model(patched(testing::read(folder, json), "base"));
}

std::string fault(Json json, const std::string& pointer, const Json& value) {
  json[JsonPointer(pointer)] = value;
  return complaint([&] { (void)case_model_of(json); });
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_rectangle_has_the_stiffness_and_mass_of_a_rectangle) {
  const Section section =
      build_model(case_model_of(testing::cantilever()), 0).members.at(0).section;
  BOOST_TEST(section.EA == 2e11 * 0.1 * 0.05, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(section.EI == 2e11 * 0.05 * 1e-3 / 12, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(section.kappa_GA == 5.0 / 6 * 2e11 / 2.6 * 0.005, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(section.mass_per_length == 7800 * 0.005, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(section.section_modulus == 0.05 * 0.01 / 6, boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(a_circle_and_plain_numbers_are_sections_too) {
  Json json = testing::cantilever();
  json["model"]["sections"]["bar"] = {{"material", "steel"}, {"circle", {{"diameter_m", 0.1}}}};
  const Section round = build_model(case_model_of(json), 0).members.at(0).section;
  BOOST_TEST(round.EI == 2e11 * std::numbers::pi * 1e-4 / 64, boost::test_tools::tolerance(1e-14));
  json["model"]["sections"]["bar"] = {
      {"material", "steel"}, {"area_m2", 0.01}, {"second_moment_m4", 1e-6}};
  const Section plain = build_model(case_model_of(json), 0).members.at(0).section;
  BOOST_TEST(plain.EI == 2e5, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(contains(fault(json, "/model/sections/bar/circle/diameter_m", 0.1),
                      "/model/sections/bar: expected exactly one of 'rectangle', 'circle'"));
}

BOOST_AUTO_TEST_CASE(every_word_of_a_planar_model_reaches_the_model) {
  Json json = testing::cantilever();
  Json& model = json["model"];
  model["nodes"]["C"] = {2, 1};
  model["members"]["BC"] = {{"nodes", {"B", "C"}},
                            {"section", "bar"},
                            {"beam", "timoshenko"},
                            {"mass_matrix", "lumped"},
                            {"axial", "inextensible"},
                            {"elements", 3},
                            {"ends", {"hinged", {{"spring_N_m_per_rad", 7}}}},
                            {"load_N_per_m", {1, -2}}};
  model["plates"]["web"] = {{"material", "steel"},
                            {"thickness_m", 0.01},
                            {"triangles", {{"A", "B", "C"}, {"A", "C", "B"}}}};
  model["rigid_bodies"]["hub"] = {{"reference", "B"}, {"nodes", {"C"}}};
  model["point_masses"]["m"] = {
      {"node", "C"}, {"mass_kg", 2}, {"inertia_kg_m2", 3}, {"offset_m", {0.1, 0.2}}};
  model["springs"]["k"] = {{"nodes", {"A", "C"}},
                           {"stiffness_N_per_m", {4, 5}},
                           {"rotational_stiffness_N_m_per_rad", 6}};
  model["supports"]["C"] = {"y"};
  model["gravity_m_s2"] = {0, -9.81};
  const Model built = build_model(case_model_of(json), 0);
  const Member& member = built.members.at(1);
  BOOST_TEST((member.theory == BeamTheory::timoshenko && member.mass == MassMatrix::lumped));
  BOOST_TEST(!member.axially_flexible);
  BOOST_TEST(member.elements == 3);
  BOOST_TEST((member.ends[0].fixity == EndFixity::hinged));
  BOOST_TEST((member.ends[1].fixity == EndFixity::sprung && member.ends[1].stiffness == 7));
  BOOST_TEST((member.load == Vector2d(1, -2)));
  BOOST_TEST(built.members.at(0).elements == 4);  // the model's default
  // Triangles run counterclockwise however they are written.
  BOOST_TEST((built.triangles.at(0).nodes == built.triangles.at(1).nodes));
  BOOST_TEST(built.rigid_bodies.at(0).attached.at(0) == 2);
  BOOST_TEST((built.masses.at(0).mass == 2 && built.masses.at(0).inertia == 3));
  BOOST_TEST((built.masses.at(0).offset == Vector2d(0.1, 0.2)));
  BOOST_TEST((built.springs.at(0).stiffness == Vector3d(4, 5, 6)));
  BOOST_TEST((built.supports.at(1).fixed == std::array<bool, 3>{false, true, false}));
  BOOST_TEST((built.loads.at(0).force == Vector3d(0, 100, 0)));
  BOOST_TEST((built.gravity == Vector2d(0, -9.81)));
}

BOOST_AUTO_TEST_CASE(a_name_that_leads_nowhere_is_answered_with_the_nearest_one) {
  BOOST_TEST(contains(fault(testing::cantilever(), "/model/members/AB/section", "bra"),
                      "/model/members/AB/section: expected the name of a section (got 'bra'); did "
                      "you mean 'bar'?"));
  BOOST_TEST(contains(fault(testing::cantilever(), "/model/members/AB/nodes", {"A", "Q"}),
                      "/model/members/AB/nodes/1: expected the name of a node (got 'Q')"));
  BOOST_TEST(contains(fault(testing::cantilever(), "/model/supports/Z", {"x"}),
                      "/model/supports/Z: expected the name of a node"));
}

BOOST_AUTO_TEST_CASE(impossible_geometry_is_refused_where_it_stands) {
  BOOST_TEST(contains(fault(testing::cantilever(), "/model/nodes/B", {0, 0}),
                      "/model/members/AB/nodes: expected two nodes apart"));
  Json json = testing::cantilever();
  json["model"]["nodes"]["C"] = {4, 0};
  json["model"]["plates"]["p"] = {
      {"material", "steel"}, {"thickness_m", 1}, {"triangles", {{"A", "B", "C"}}}};
  BOOST_TEST(contains(complaint([&] { (void)case_model_of(json); }),
                      "/model/plates/p/triangles/0: expected a triangle with an area"));
}

BOOST_AUTO_TEST_CASE(blocks_become_triangles_joined_to_the_named_nodes) {
  const Model model = build_model(case_model_of(testing::quarter_ring()), 0);
  BOOST_TEST(model.nodes.size() == 5U * 9);  // six-node triangles of 2 x 4 cells
  BOOST_TEST(model.triangles.size() == 16U);
  for (const char* name : {"A", "B", "C", "D", "M"}) {
    const Index node = model.find_node(name);
    const auto uses = std::count_if(
        model.triangles.begin(), model.triangles.end(), [&](const Triangle& triangle) {
          return std::find(triangle.nodes.begin(), triangle.nodes.end(), node) !=
                 triangle.nodes.end();
        });
    BOOST_TEST(uses >= 1, name);
  }
  for (const Triangle& triangle : model.triangles) BOOST_TEST(triangle.quadratic());
  // Every node on the inner edge keeps its radius, middles too.
  int inner = 0;
  for (const Node& node : model.nodes) {
    if (node.position.norm() < 1.01) {
      BOOST_TEST(node.position.norm() == 1, boost::test_tools::tolerance(1e-14));
      ++inner;
    }
  }
  BOOST_TEST(inner == 9);
  BOOST_TEST(model.supports.size() == 10U);
  BOOST_TEST(model.edge_loads.size() == 4U);
  BOOST_TEST(model.edge_loads.at(0).normal == -3e5);
}

BOOST_AUTO_TEST_CASE(two_supported_edges_take_a_motion_of_their_corner_away_once) {
  Json json = testing::quarter_ring();
  json["model"]["supports"] = {{"inner", {"x", "y"}}, {"bottom", {"y"}}, {"A", {"y"}}};
  const Model model = build_model(case_model_of(json), 0);
  const Index a = model.find_node("A");
  int y = 0;
  for (const Support& support : model.supports) y += support.node == a && support.fixed[1] ? 1 : 0;
  BOOST_TEST(y == 1);
}

BOOST_AUTO_TEST_CASE(an_edge_that_cannot_be_is_refused_where_it_stands) {
  const Json ring = testing::quarter_ring();
  BOOST_TEST(contains(fault(ring, "/model/nodes/B", {2.1, 0}),
                      "/model/edges/outer/nodes/0: expected a node on the edge's curve (got (2.1, "
                      "0) m, 1.05 times as far from its centre)"));
  BOOST_TEST(contains(fault(ring, "/model/edges/bottom/nodes", {"A", "C"}),
                      "/model/edges/bottom/nodes/1: expected the other end of a block's side"));
  BOOST_TEST(contains(fault(ring, "/model/edges/again", {{"nodes", {"B", "C"}}}),
                      "expected a piece that no edge has had before"));
  BOOST_TEST(contains(fault(ring, "/model/edges/A", {{"nodes", {"C", "D"}}}),
                      "/model/edges/A: expected another name: there is a node of that name"));
  BOOST_TEST(contains(fault(ring, "/model/edges/bottom/nodes", {"A", "A"}),
                      "/model/edges/bottom/nodes/1: expected another node than the one before"));
  BOOST_TEST(contains(
      fault(ring, "/model/edges/outer/ellipse", {{"center_m", {0, 0}}, {"semi_axes_m", {2, 2}}}),
      "/model/edges/outer: expected at most one of 'ellipse' and 'circle'"));
  BOOST_TEST(
      contains(fault(ring, "/model/supports/innner", {"x"}),
               "/model/supports/innner: expected the name of a node or edge (got 'innner')"));
  BOOST_TEST(contains(fault(ring, "/model/supports/left", {"rotation"}),
                      "/model/supports/left: expected x and y alone"));
}

BOOST_AUTO_TEST_CASE(a_block_that_cannot_be_is_refused_where_it_stands) {
  const Json ring = testing::quarter_ring();
  BOOST_TEST(contains(fault(ring, "/model/plates/ring/blocks/b/corners", {"A", "D", "C", "B"}),
                      "/model/plates/ring/blocks/b/corners: expected a convex quadrilateral"));
  BOOST_TEST(contains(fault(ring, "/model/plates/ring/triangles", {{"A", "B", "C"}}),
                      "/model/plates/ring: expected exactly one of 'triangles' and 'blocks'"));
  BOOST_TEST(
      contains(fault(ring, "/model/nodes/M", {1.4, 1.4}),
               "/model/nodes/M: expected a place where the mesh has a node (got (1.4, 1.4)"));
  Json two = ring;
  two["model"]["nodes"]["E"] = {3, 0};
  two["model"]["nodes"]["F"] = {3, 3};
  two["model"]["plates"]["ring"]["blocks"]["c"] = {{"corners", {"B", "E", "F", "C"}},
                                                   {"cells", {1, 3}}};
  BOOST_TEST(contains(complaint([&] { (void)case_model_of(two); }),
                      "/model/plates/ring/blocks/c: expected the same mesh on both sides"));
  BOOST_TEST(contains(fault(two, "/model/plates/ring/blocks/c/cells", {1, 2}),
                      "/model/loads/p/edge: expected an edge with a plate on one side"));
}

BOOST_AUTO_TEST_CASE(a_load_is_on_a_node_or_on_an_edge) {
  const Json ring = testing::quarter_ring();
  BOOST_TEST(contains(fault(ring, "/model/loads/p/node", "A"),
                      "/model/loads/p: expected exactly one of 'node' and 'edge'"));
  BOOST_TEST(contains(fault(ring, "/model/loads/p/force_N", {1, 2}),
                      "/model/loads/p/force_N: expected it beside 'node' only"));
  BOOST_TEST(contains(fault(ring, "/model/loads/q", {{"node", "A"}, {"normal_Pa", 2}}),
                      "/model/loads/q/normal_Pa: expected it beside 'edge' only"));
  BOOST_TEST(contains(fault(ring, "/model/loads/p/edge", "outr"),
                      "/model/loads/p/edge: expected the name of an edge (got 'outr'); did you "
                      "mean 'outer'?"));
}

BOOST_AUTO_TEST_CASE(an_unreachable_pose_is_refused_with_the_limb_and_the_distance) {
  const std::string line = fault(testing::manipulator(), "/model/pose/x_m", 1);
  BOOST_TEST(contains(line, "/model/pose: expected a pose within reach (limb 1"));
  Json json = testing::manipulator();
  json["model"].erase("pose");
  json["model"]["trajectory"]["circle"] = {
      {"center_m", {0.25, 0.144}}, {"radius_m", 0.3}, {"points", 10}, {"step_s", 0.6}};
  BOOST_TEST(contains(complaint([&] { (void)case_model_of(json); }),
                      "/model/trajectory: expected a pose within reach at point 0"));
}

BOOST_AUTO_TEST_CASE(links_may_differ_in_length_and_in_section) {
  Json json = testing::manipulator();
  Json& robot = json["model"]["manipulator"];
  robot["links"]["proximal_length_m"] = {0.19, 0.2, 0.21};
  robot["links"]["distal_length_m"] = 0.22;
  robot["links"]["proximal"] = {{"thickness_m", 0.003}, {"mass_kg", 0.05}};
  robot["working_mode"] = {1, -1, 1};
  robot["joints"]["elbow"] = {"hinged", "welded", {{"spring_N_m_per_rad", 3}}};
  robot["base_m"] = {{0, 0}, {0.5, 0.01}, {0.26, 0.43}};
  robot.erase("base_side_m");
  const CaseModel case_model = case_model_of(json);
  const ManipulatorDesign& design = *case_model.manipulator;
  BOOST_TEST((design.geometry.proximal == std::array<double, 3>{0.19, 0.2, 0.21}));
  BOOST_TEST((design.geometry.distal == std::array<double, 3>{0.22, 0.22, 0.22}));
  BOOST_TEST(design.proximal[0].thickness == 0.003);
  BOOST_TEST(design.distal[0].thickness == 0.0015);
  BOOST_TEST(design.proximal[2].mass.value() == 0.05);
  BOOST_TEST(!design.distal[2].mass.has_value());
  BOOST_TEST((design.geometry.working_mode == std::array<int, 3>{1, -1, 1}));
  BOOST_TEST((design.geometry.base[1] == Vector2d(0.5, 0.01)));
  BOOST_TEST((design.elbow[2].kind == ElbowKind::sprung && design.elbow[2].stiffness == 3));
  const Model model = build_model(case_model, 0);
  const auto length = [&](Index a, Index b) {
    return (model.nodes[static_cast<std::size_t>(a)].position -
            model.nodes[static_cast<std::size_t>(b)].position)
        .norm();
  };
  BOOST_TEST(length(0, 3) == 0.19, boost::test_tools::tolerance(1e-13));
  BOOST_TEST(length(3, 6) == 0.22, boost::test_tools::tolerance(1e-13));
}

BOOST_AUTO_TEST_CASE(a_combination_without_meaning_is_refused) {
  Json json = testing::manipulator();
  json["model"]["manipulator"]["platform"]["kind"] = "triangles";
  const std::string line = fault(json, "/model/manipulator/joints/platform", "welded");
  BOOST_TEST(contains(line, "/model/manipulator: expected a model that has a meaning: "), line);
  BOOST_TEST(
      contains(fault(testing::manipulator(), "/model/manipulator/base_m", {{0, 0}, {1, 0}, {0, 1}}),
               "/model/manipulator: expected either 'base_side_m' or 'base_m' (got both"));
  BOOST_TEST(contains(
      fault(testing::cantilever(), "/model/pose", {{"x_m", 0}, {"y_m", 0}, {"phi_rad", 0}}),
      "/model/pose: expected a manipulator beside it"));
}

BOOST_AUTO_TEST_CASE(a_circle_runs_through_its_points_in_time) {
  Json json = testing::manipulator();
  json["model"].erase("pose");
  json["model"]["trajectory"]["circle"] = {{"center_m", {0.25, 0.144}},
                                           {"radius_m", 0.01},
                                           {"points", 631},
                                           {"step_s", 0.01},
                                           {"phi_rad", 0.1}};
  const CaseModel case_model = case_model_of(json);
  BOOST_REQUIRE(case_model.steps() == 631);
  BOOST_TEST(case_model.motion.back().time == 6.3, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(case_model.motion[0].pose.x == 0.26, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(case_model.motion[157].pose.y == 0.144 + 0.01 * std::sin(1.57),
             boost::test_tools::tolerance(1e-14));
  BOOST_TEST(case_model.motion[630].pose.phi == 0.1);
}

BOOST_AUTO_TEST_CASE(a_line_a_motion_from_rest_to_rest_and_a_spline_are_paths_too) {
  Json json = testing::manipulator();
  json["model"].erase("pose");
  const Json from = {{"x_m", 0.25}, {"y_m", 0.144}, {"phi_rad", 0}};
  const Json to = {{"x_m", 0.27}, {"y_m", 0.144}, {"phi_rad", 0.2}};
  const Json path = {
      {"from", from}, {"to", to}, {"duration_s", 2}, {"points", 21}, {"step_s", 0.1}};
  json["model"]["trajectory"] = {{"line", path}};
  TrajectoryPoint middle = case_model_of(json).motion[10];
  BOOST_TEST(middle.pose.x == 0.26, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(middle.velocity.z() == 0.1, boost::test_tools::tolerance(1e-14));
  json["model"]["trajectory"] = {{"rest_to_rest", path}};
  middle = case_model_of(json).motion[10];
  BOOST_TEST(middle.pose.phi == 0.1, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(middle.velocity.x() == 1.875 * 0.01, boost::test_tools::tolerance(1e-13));
  const auto knot = [](double time, Json pose) {
    pose["time_s"] = time;
    return pose;
  };
  json["model"]["trajectory"] = {{"spline",
                                  {{"knots", {knot(0, from), knot(1, to), knot(2, from)}},
                                   {"ends", "periodic"},
                                   {"points", 21},
                                   {"step_s", 0.1}}}};
  const CaseModel case_model = case_model_of(json);
  BOOST_TEST(case_model.motion[10].pose.x == 0.27, boost::test_tools::tolerance(1e-14));
  BOOST_TEST((case_model.motion[0].velocity - case_model.motion[20].velocity).norm() < 1e-14);

  Json& trajectory = json["model"]["trajectory"];
  trajectory["spline"]["points"] = 22;
  BOOST_TEST(contains(complaint([&] { (void)case_model_of(json); }),
                      "/model/trajectory/spline: expected a path that has a meaning: the time"));
  trajectory["spline"]["points"] = 21;
  trajectory["spline"]["knots"][0]["time_s"] = 0.5;
  BOOST_TEST(contains(complaint([&] { (void)case_model_of(json); }),
                      "/model/trajectory/spline/knots/0: expected the first knot at 0 s"));
  trajectory = {{"line", path}, {"rest_to_rest", path}};
  BOOST_TEST(contains(complaint([&] { (void)case_model_of(json); }), "/model/trajectory"));
}

BOOST_AUTO_TEST_CASE(a_manipulator_carries_what_stands_beside_it) {
  Json json = testing::manipulator();
  json["model"]["nodes"]["G"] = {0.25, 0.3};
  json["model"]["springs"]["k"] = {{"nodes", {"P", "G"}}, {"stiffness_N_per_m", {10, 10}}};
  json["model"]["supports"]["G"] = {"x", "y"};
  json["model"]["point_masses"]["payload"] = {{"node", "P"}, {"mass_kg", 0.5}};
  const Model model = build_model(case_model_of(json), 0);
  BOOST_TEST(model.nodes.at(static_cast<std::size_t>(model.springs.at(0).nodes[0])).name == "P");
  BOOST_TEST(model.nodes.at(static_cast<std::size_t>(model.springs.at(0).nodes[1])).name == "G");
  BOOST_TEST(model.masses.back().mass == 0.5);
  BOOST_TEST(contains(fault(testing::manipulator(), "/model/nodes/P", {0, 0}),
                      "/model/nodes/P: expected another name"));
}

BOOST_AUTO_TEST_SUITE_END()
