#include "solver/linear/constraints.h"

#include <boost/test/unit_test.hpp>

#include "solver/linear/statics.h"
#include "solver/linear/system.h"
#include "tests/support/solver/frames.h"

BOOST_AUTO_TEST_SUITE(constraints)

using namespace trammel::solver;
using namespace trammel::testing;
using boost::test_tools::tolerance;

namespace {

/// Returns the largest |C T|. The free motions T must satisfy all rows of the constraint matrix C,
/// including redundant rows that were dropped.
double constraint_violation(const System& system) {
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

BOOST_AUTO_TEST_CASE(rigid_body_has_three_motions) {
  const System system = assemble(rigid_triangle());
  BOOST_TEST(system.T.cols() == 3);
  BOOST_TEST(constraint_violation(system) < 1e-15);
}

BOOST_AUTO_TEST_CASE(redundant_constraints_are_dropped) {
  Model model = rigid_triangle();
  model.rigid_bodies.push_back({"again", 1, {2, 3, 0}});  // the same nodes, another reference node
  model.supports = {pin(1), {"", 1, {true, false, false}}};
  const System system = assemble(model);
  BOOST_TEST(system.T.cols() == 1);
  BOOST_TEST(dropped(system) > 0);
  BOOST_TEST(constraint_violation(system) < 1e-14);
}

BOOST_AUTO_TEST_CASE(inextensible_parallel_links_leave_one_motion) {
  Model model;
  model.nodes = {{"A", {0, 0}}, {"B", {0.3, 0.7}}, {"C", {2.3, 0.7}},
                 {"D", {2, 0}}, {"E", {1, 0}},     {"F", {1.3, 0.7}}};
  const auto link = [](Index a, Index b) {
    Member m = hinged("", a, b, {0, 0, 0, 1, 0, 1, 1});
    m.axially_flexible = false;
    return m;
  };
  model.rigid_bodies = {{"coupler", 1, {2, 5}}};
  model.members = {link(0, 1), link(3, 2), link(4, 5)};  // the third link is redundant
  model.supports = {pin(0), pin(3), pin(4)};
  const System system = assemble(model);
  BOOST_TEST(system.T.cols() == 1);
  BOOST_TEST(dropped(system) == 1);
  BOOST_TEST(constraint_violation(system) < 1e-13);
}

BOOST_AUTO_TEST_CASE(unit_of_length_does_not_change_the_pivots) {
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

BOOST_AUTO_TEST_CASE(clamp_and_moment_may_act_on_any_rigid_body_node) {
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
    BOOST_TEST(r.reaction(0, 2) == -1, tolerance(1e-12));
    return r.displacement(1, 2);
  };
  const double turned = tip_under_moment(0, 1);
  BOOST_TEST(std::abs(turned) > 0);
  BOOST_TEST(tip_under_moment(2, 1) == turned, tolerance(1e-12));
  BOOST_TEST(tip_under_moment(0, 3) == turned, tolerance(1e-12));
}

BOOST_AUTO_TEST_SUITE_END()
