#include "harness/scene/case_model.h"

#include <boost/test/unit_test.hpp>

#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(case_model)

using namespace trammel;
using namespace trammel::solver;
using namespace trammel::testing;

namespace {

CaseModel case_model_of(const Json& json) {
  return read_case_model(document_of(json));
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_key_of_a_planar_model_reaches_the_model) {
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
  // The case has two triangles with the same nodes in opposite order. The reader stores both in
  // counterclockwise order.
  BOOST_TEST((built.triangles.at(0).nodes == built.triangles.at(1).nodes));
  BOOST_TEST(built.rigid_bodies.at(0).attached.at(0) == 2);
  BOOST_TEST((built.masses.at(0).mass == 2 && built.masses.at(0).inertia == 3));
  BOOST_TEST((built.masses.at(0).offset == Vector2d(0.1, 0.2)));
  BOOST_TEST((built.springs.at(0).stiffness == Vector3d(4, 5, 6)));
  BOOST_TEST((built.supports.at(1).fixed == std::array<bool, 3>{false, true, false}));
  BOOST_TEST((built.loads.at(0).force == Vector3d(0, 100, 0)));
  BOOST_TEST((built.gravity == Vector2d(0, -9.81)));
}

BOOST_AUTO_TEST_CASE(corner_of_two_supported_edges_has_one_support) {
  Json json = testing::quarter_ring();
  json["model"]["supports"] = {{"inner", {"x", "y"}}, {"bottom", {"y"}}, {"A", {"y"}}};
  const Model model = build_model(case_model_of(json), 0);
  const Index a = model.find_node("A");
  int y = 0;
  for (const Support& support : model.supports) y += support.node == a && support.fixed[1] ? 1 : 0;
  BOOST_TEST(y == 1);
}

BOOST_AUTO_TEST_SUITE_END()
