#include "solver/linear/validate.h"

#include <boost/test/unit_test.hpp>
#include <functional>

#include "solver/linear/system.h"
#include "tests/support/solver/frames.h"

BOOST_AUTO_TEST_SUITE(validate)

using namespace trammel::solver;
using namespace trammel::testing;

namespace {

/// Returns a valid model with one component of each type.
Model valid_model() {
  Model model = cantilever(unit_section(), 1, 2);
  model.nodes.push_back({"C", {1, 1}});
  model.plates = {{"web", {1e9, 1, 0.3}, 0.1}};
  model.triangles = {{0, {0, 1, 2, -1, -1, -1}}};
  model.masses = {{1, 1, 0, {0, 0}}};
  model.springs = {{"spring", {2, -1}, {1, 0, 0}}};
  model.loads = {{1, {0, 1, 0}}};
  return model;
}

std::string model_error_message(const std::function<void(Model&)>& spoil) {
  Model model = valid_model();
  spoil(model);
  try {
    (void)assemble(model);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

BOOST_AUTO_TEST_CASE(valid_model_is_accepted) {
  BOOST_TEST(model_error_message([](Model&) {}) == "no error");
  const auto thin = [](Model& m) { m.nodes[2].position = {0.5, 3e-12}; };  // area of 1.5e-12 m^2
  BOOST_TEST(model_error_message(thin) == "no error");
}

BOOST_AUTO_TEST_CASE(middle_node_may_not_fold_its_triangle_at_a_corner) {
  // Moves the middle node of side k by fractions of the side and of the distance to the third node.
  const auto moved = [](std::size_t k, double along, double inwards) {
    return model_error_message([&](Model& m) {
      const auto corner = [&](std::size_t i) { return m.nodes[i % 3].position; };
      for (std::size_t i = 0; i < 3; ++i) {
        m.triangles[0].nodes[3 + i] = static_cast<Index>(m.nodes.size());
        m.nodes.push_back({"", (corner(i) + corner(i + 1)) / 2});
      }
      const Vector2d side = corner(k + 1) - corner(k), middle = m.nodes[3 + k].position;
      m.nodes[3 + k].position += along * side + inwards * (corner(k + 2) - middle);
    });
  };
  for (std::size_t k = 0; k < 3; ++k) {
    for (const double sign : {-1, 1}) {
      BOOST_TEST(moved(k, sign * 0.24, 0) == "no error");  // determinant at the ends: 1 -+ 4 along
      BOOST_TEST(moved(k, sign * 0.26, 0) ==
                 "triangle 0 has mid-side nodes that fold it over itself");
    }
    BOOST_TEST(moved(k, 0, 0.45) == "no error");  // determinant on the side: 1 - 2 inwards
    BOOST_TEST(moved(k, 0, 0.55) == "triangle 0 has mid-side nodes that fold it over itself");
  }
}

BOOST_AUTO_TEST_CASE(triangle_folded_at_a_middle_node_is_refused) {
  const auto folded = [](Model& m) {  // Jacobian: corners >= 0.2, a mid-side -0.2
    m.nodes[2].position = {0, 1};
    m.triangles[0].nodes = {0, 1, 2, 3, 4, 5};
    for (const Vector2d& p : {Vector2d(0.9, -0.05), Vector2d(0.5, 0.25), Vector2d(0, 0.5)})
      m.nodes.push_back({"", p});
  };
  BOOST_TEST(model_error_message(folded) ==
             "triangle 0 has mid-side nodes that fold it over itself");
}

BOOST_AUTO_TEST_CASE(invalid_models_are_refused_with_the_reason) {
  const auto says = [](const std::string& expected, const std::function<void(Model&)>& spoil) {
    BOOST_TEST(model_error_message(spoil) == expected);
  };
  says("member AB has no length", [](Model& m) {
    m.nodes[1].position = {0, 0};
    m.triangles = {};
  });
  says("member AB refers to node 9, but the model has 3 nodes",
       [](Model& m) { m.members[0].nodes[1] = 9; });
  says("member AB must have at least one element", [](Model& m) { m.members[0].elements = 0; });
  says("member AB must have a positive axial stiffness E A",
       [](Model& m) { m.members[0].section.EA = m.members[0].end_section.EA = -1; });
  says("member AB must have a positive axial stiffness E A",
       [](Model& m) { m.members[0].section.EA = m.members[0].end_section.EA = kNaN; });
  says("member AB has no bending stiffness E I, so it must be one element hinged at both ends",
       [](Model& m) { m.members[0].section.EI = m.members[0].end_section.EI = 0; });
  says("member AB has shear and must have a positive shear stiffness kappa G A",
       [](Model& m) { m.members[0].theory = BeamTheory::timoshenko; });
  says("triangle 0 (node A, node B, node C) has no area", [](Model& m) {
    m.nodes[2].position = {2, 0};
  });
  says("plate web must have a positive Young's modulus",
       [](Model& m) { m.plates[0].material.E = 0; });
  says("plate web must have a Poisson's ratio between -1 and 1",
       [](Model& m) { m.plates[0].material.nu = 1; });
  says("the point mass at node B has a negative mass", [](Model& m) { m.masses[0].mass = -1; });
  says("spring spring joins a node with itself", [](Model& m) { m.springs[0].nodes[1] = 2; });
  says(
      "the support of node C fixes a rotation that the node does not have: no member end is joined "
      "to the node and no rigid body contains the node",
      [](Model& m) { m.supports.push_back(clamp(2)); });
  says("node C has no rotation: no member end is welded to it, no rigid body contains it",
       [](Model& m) {
         m.loads = {{2, {0, 0, 1}}};
       });
  says("node A has a position that is not a finite number",
       [](Model& m) { m.nodes[0].position.x() = kNaN; });
  says("the load at node B is not a finite number", [](Model& m) { m.loads[0].force[0] = kNaN; });
  says("the model has no nodes", [](Model& m) { m = Model{}; });
}

BOOST_AUTO_TEST_SUITE_END()
