#include <boost/test/unit_test.hpp>
#include <cfenv>

#include "solver/linear/row_balance.h"
#include "solver/linear/statics.h"
#include "solver/manipulator/manipulator.h"
#include "tests/support/solver/frames.h"
#include "tests/support/solver/table_1.h"

BOOST_AUTO_TEST_SUITE(unbalanced_forces)

using namespace trammel::solver;
using namespace trammel::testing;

namespace {

struct Solved {
  System system;
  StaticSolution solution;
  ElasticState state;

  [[nodiscard]] double unbalanced() const {
    RowBalance<double> rows(system);
    rows.add_elastic_forces(state.u);
    rows.add_load(-system.load);
    return trammel::solver::largest_relative_imbalance(system, state, solution, rows.magnitudes());
  }
};

/// Returns the statics of the manipulator of Table 1 of Varalakshmi and Srinivas (2017) with welded
/// elbows, under gravity and a force at A1.
Solved manipulator() {
  Model model = build_manipulator(table_1_design(), centered_pose(0.1));
  model.gravity = {0.5, -9.81};
  model.loads = {{0, {3, -2, 0}}};
  Solved s{assemble(model), {}, {}};
  s.solution = solve_statics(s.system);
  BOOST_REQUIRE(s.solution.outcome.solved());
  s.state.u = s.system.T * s.solution.q;
  return s;
}

}  // namespace

BOOST_AUTO_TEST_CASE(reported_forces_balance_at_every_node) {
  BOOST_TEST(manipulator().unbalanced() < 1e-14);
}

BOOST_AUTO_TEST_CASE(unbalanced_forces_are_relative_to_constraint_forces) {
  // Along the girder of this portal, only the constraint forces of inextensible members act. The
  // program once divided the unbalanced force, which is round-off, by a scale of zero.
  Model model;
  model.nodes = {{"A", {0, 0}},
                 {"B", {0, 10.16}},
                 {"G", {10.16, 10.16}},
                 {"C", {20.32, 10.16}},
                 {"D", {20.32, 0}}};
  for (Index i = 0; i < 4; ++i) {
    model.members.push_back(member("", i, i + 1, rectangle({2e11, 1, 0.3}, 1.7, 0.019)));
    model.members.back().axially_flexible = false;
    if (i == 1 || i == 2) model.members.back().load = {0, -87563.41762323819};
  }
  model.supports = {clamp(0), clamp(4)};
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TONEAREST}) {
    std::fesetround(mode);
    const Outcome outcome = solve_statics(assemble(model)).outcome;
    std::fesetround(FE_TONEAREST);
    BOOST_TEST(outcome.solved(), outcome.reason);
  }
}

BOOST_AUTO_TEST_CASE(wrong_sign_or_place_of_a_force_is_detected) {
  for (const Index column : {0, 1, 2}) {
    Solved sign = manipulator();
    sign.solution.resultant_start.col(column) *= -1;
    BOOST_TEST(sign.unbalanced() > 1e-9);
    Solved end = manipulator();
    end.solution.resultant_end.col(column) *= -1;
    BOOST_TEST(end.unbalanced() > 1e-9);
  }
  Solved swapped = manipulator();
  std::swap(swapped.solution.resultant_start, swapped.solution.resultant_end);
  BOOST_TEST(swapped.unbalanced() > 1e-9);
  Solved reaction = manipulator();
  reaction.solution.reaction *= -1;
  BOOST_TEST(reaction.unbalanced() > 1e-9);
}

BOOST_AUTO_TEST_CASE(load_changed_after_the_solution_unbalances_rows) {
  Solved s = manipulator();
  s.system.load *= 1.0001;
  RowBalance<double> rows(s.system);
  rows.add_elastic_forces(s.state.u);
  rows.add_load(-s.system.load);
  BOOST_TEST(rows.backward_error() > 1e-9);
}

BOOST_AUTO_TEST_SUITE_END()
