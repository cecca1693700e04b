#include <boost/test/unit_test.hpp>

#include "solver/large/equilibrium.h"
#include "solver/large/state_results.h"
#include "solver/linear/statics.h"
#include "solver/manipulator/manipulator.h"
#include "tests/support/solver/large_models.h"
#include "tests/support/solver/table_1.h"

BOOST_AUTO_TEST_SUITE(linear_limit)

namespace {

using namespace trammel::solver;
using namespace trammel::solver::large_motion;
using namespace trammel::testing;

/// Largest relative difference between this tier and linear statics under the model's loads times a
/// factor.
double difference_from_linear(Model model, double factor) {
  for (NodalLoad& load : model.loads) load.force *= factor;
  for (Member& member : model.members) member.load *= factor;
  const StaticSolution linear = solve_statics(assemble(model));
  BOOST_REQUIRE(linear.outcome.solved());
  const GeometricallyExactSystem system(model);
  Equilibrium equilibrium(system);
  State state = system.reference_state();
  BOOST_REQUIRE(equilibrium.solve(state, 1).outcome.solved());
  const Eigen::MatrixX3d moved = node_motion(system, state.q);
  const double size = linear.displacement.leftCols(2).cwiseAbs().maxCoeff();
  const double translation = (moved - linear.displacement).leftCols(2).cwiseAbs().maxCoeff() / size;
  const Eigen::MatrixX3d reaction = reactions(system, state);
  const double force = linear.reaction.cwiseAbs().maxCoeff();
  return std::max(translation, (reaction - linear.reaction).cwiseAbs().maxCoeff() / force);
}

/// The difference falls at least in proportion to the load, down to round-off.
void check_linear_limit(const Model& model, double floor) {
  double last = difference_from_linear(model, 1e-2);
  for (const double factor : {1e-3, 1e-4, 1e-5}) {
    const double now = difference_from_linear(model, factor);
    BOOST_TEST(now < std::max(0.11 * last, floor));
    last = now;
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(small_loads_give_linear_statics_of_a_portal_frame) {
  Model model;
  const Section section = rectangle({200e9, 7800, 0.3}, 0.1, 0.05);
  model.nodes = {{"A", {0, 0}}, {"B", {0, 3}}, {"C", {4, 3.5}}, {"D", {4, 0}}};
  model.members = {member("AB", 0, 1, section, 2), member("BC", 1, 2, section, 3),
                   member("CD", 2, 3, section, 1)};
  model.members[1].ends[1] = {EndFixity::sprung, 1e5, 0};
  model.members[2].ends[1] = {EndFixity::hinged, 0, 0};
  model.members[2].theory = BeamTheory::timoshenko;
  model.members[1].load = {200, -3000};
  model.supports = {clamp(0), pin(3)};
  model.loads = {{1, {4000, 0, 500}}};
  check_linear_limit(model, 1e-9);
}

BOOST_AUTO_TEST_CASE(small_loads_give_linear_statics_of_the_manipulator) {
  for (const bool rigid : {false, true}) {
    ManipulatorDesign design = table_1_design();
    if (rigid) design.platform.kind = PlatformDesign::Kind::rigid;
    Model model = build_manipulator(design, centred_pose(0.3));
    const Index p = model.find_node("P");
    model.loads = {{p, {0.5, 0.2, 0}}};
    check_linear_limit(model, 1e-7);
  }
}

BOOST_AUTO_TEST_SUITE_END()
