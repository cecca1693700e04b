#include "solver/linear/constraints.h"

#include <boost/test/unit_test.hpp>

#include "solver/linear/statics.h"
#include "solver/linear/system.h"
#include "tests/support/solver/frames.h"

BOOST_AUTO_TEST_SUITE(constraints)

using namespace trammel::solver;
using namespace trammel::testing;

namespace {

/// Largest |C T|: every free motion satisfies every row, the dropped ones included.
double violation(const System& system) {
  double largest = 0;
  for (const ConstraintRow& row : system.constraints.rows) {
    Eigen::VectorXd c = Eigen::VectorXd::Zero(system.T.rows());
    for (const auto& [u, value] : row.terms) c[u] += value;
    const Eigen::VectorXd product = system.T.transpose() * c;
    if (product.size() > 0) largest = std::max(largest, product.cwiseAbs().maxCoeff());
  }
  return largest;
}

Index dropped(const System& system) {
  return std::count(system.constraints.pivot.begin(), system.constraints.pivot.end(), Index{-1});
}

Model rigid_triangle() {
  Model model;
  model.nodes = {{"P", {0.2, 0.1}}, {"C1", {0, 0}}, {"C2", {0.4, 0}}, {"C3", {0.2, 0.3}}};
  model.rigid_bodies = {{"platform", 0, {1, 2, 3}}};
  return model;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_model_without_constraints_pays_nothing_for_them) {
  const System system = assemble(beam(unit_section(), 1, 5));
  BOOST_TEST(system.T.rows() == system.T.cols());
  BOOST_TEST(system.T.nonZeros() == system.T.cols());
  BOOST_TEST(system.constraints.rows.empty());
}

BOOST_AUTO_TEST_CASE(a_rigid_body_has_three_motions) {
  const System system = assemble(rigid_triangle());
  BOOST_TEST(system.T.cols() == 3);
  BOOST_TEST(violation(system) < 1e-15);
}

BOOST_AUTO_TEST_CASE(member_ends_welded_to_a_rigid_body_turn_with_it) {
  Model model = rigid_triangle();
  model.nodes.push_back({"B", {1, 0}});
  model.members = {member("CB", 2, 4, unit_section())};
  const System system = assemble(model);
  BOOST_TEST(system.T.cols() == 6);
  BOOST_TEST(violation(system) < 1e-15);
}

BOOST_AUTO_TEST_CASE(redundant_constraints_are_dropped) {
  Model model = rigid_triangle();
  model.rigid_bodies.push_back({"again", 1, {2, 3, 0}});  // the same body told from another node
  model.supports = {pin(1), {"", 1, {true, false, false}}};
  const System system = assemble(model);
  BOOST_TEST(system.T.cols() == 1);
  BOOST_TEST(dropped(system) > 0);
  BOOST_TEST(violation(system) < 1e-14);
}

BOOST_AUTO_TEST_CASE(inextensible_parallel_links_leave_one_motion) {
  Model model;
  model.nodes = {{"A", {0, 0}}, {"B", {0.3, 0.7}}, {"C", {2.3, 0.7}},
                 {"D", {2, 0}}, {"E", {1, 0}},     {"F", {1.3, 0.7}}};
  const auto link = [](Index a, Index b) {
    Member m = member("", a, b, {0, 0, 0, 1, 0, 1, 1});
    m.ends[0].fixity = m.ends[1].fixity = EndFixity::hinged;
    m.axially_flexible = false;
    return m;
  };
  model.rigid_bodies = {{"coupler", 1, {2, 5}}};
  model.members = {link(0, 1), link(3, 2), link(4, 5)};  // the third says nothing new
  model.supports = {pin(0), pin(3), pin(4)};
  const System system = assemble(model);
  BOOST_TEST(system.T.cols() == 1);
  BOOST_TEST(dropped(system) == 1);
  BOOST_TEST(violation(system) < 1e-13);
}

BOOST_AUTO_TEST_CASE(the_unit_of_length_does_not_change_which_coordinates_are_eliminated) {
  const auto pivots = [](double unit) {
    Model model = rigid_triangle();
    model.nodes.push_back({"B", {1, 0.2}});
    for (Node& node : model.nodes) node.position *= unit;
    model.members = {member("CB", 2, 4, unit_section(), 3)};
    model.members[0].axially_flexible = false;
    model.supports = {pin(1)};
    return assemble(model).constraints.pivot;
  };
  BOOST_TEST((pivots(1) == pivots(1e3)));
  BOOST_TEST((pivots(1) == pivots(1e-3)));
}

BOOST_AUTO_TEST_CASE(a_linear_constraint_ties_the_mean_of_rotations) {
  // Paper Eq. (25): the platform's rotation is the mean of two link-end rotations.
  Model model = rigid_triangle();
  model.nodes.push_back({"A1", {-1, 0}});
  model.nodes.push_back({"A2", {1, 0}});
  model.members = {member("link1", 4, 1, unit_section()), member("link2", 5, 2, unit_section())};
  for (Member& m : model.members) m.ends[1].fixity = EndFixity::hinged;
  model.supports = {clamp(4), clamp(5)};
  const auto end = [](Index m) { return Coordinate{Coordinate::Kind::end_rotation, -1, m, 1}; };
  model.constraints = {
      {"Eq. 25", {{{Coordinate::Kind::rotation, 0, -1, 0}, 1}, {end(0), -0.5}, {end(1), -0.5}}}};
  model.loads = {{0, {0, 0, 1}}};
  const System system = assemble(model);
  BOOST_TEST(violation(system) < 1e-15);
  const StaticSolution r = solve_statics(system);
  BOOST_REQUIRE(r.outcome.solved());
  BOOST_TEST(r.displacement(0, 2) == (r.end_rotation(0, 1) + r.end_rotation(1, 1)) / 2,
             boost::test_tools::tolerance(1e-13));
  BOOST_TEST(r.moment_residual < 1e-9);
}

BOOST_AUTO_TEST_CASE(a_chain_of_inextensible_elements_stays_in_line_for_any_number) {
  for (const Index elements : {1, 7, 300}) {
    Model model = beam(unit_section(), 1, elements, 0.9);
    model.members[0].axially_flexible = false;
    const System system = assemble(model);
    BOOST_TEST(violation(system) < 1e-13);
    BOOST_TEST(system.T.cols() == 3 * (elements + 1) - elements);
  }
}

BOOST_AUTO_TEST_CASE(what_a_rigid_body_holds_can_be_clamped_and_loaded_by_a_moment) {
  const auto tip_under_moment = [](Index clamped, Index loaded) {
    Model model = beam(unit_section(), 1, 1, 0.9);
    const Vector2d start = model.nodes[0].position, end = model.nodes[1].position;
    model.nodes.push_back({"base", start - Vector2d(0.3, 0.1)});
    model.nodes.push_back({"tip", end + Vector2d(0.1, -0.2)});
    model.rigid_bodies = {{"", 0, {2}}, {"", 1, {3}}};
    model.supports = {{"", clamped, {true, true, true}}};
    model.loads = {{loaded, {0, 0, 1}}};
    const StaticSolution r = solve_statics(assemble(model));
    BOOST_TEST(r.outcome.solved(), r.outcome.reason);
    BOOST_TEST(r.reaction(0, 2) == -1, boost::test_tools::tolerance(1e-12));
    return r.displacement(1, 2);
  };
  const double turned = tip_under_moment(0, 1);
  BOOST_TEST(std::abs(turned) > 0);
  BOOST_TEST(tip_under_moment(2, 1) == turned, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(tip_under_moment(0, 3) == turned, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_SUITE_END()
