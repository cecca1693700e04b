#include "solver/linear/second_order.h"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "solver/linear/statics.h"
#include "solver/manipulator/manipulator.h"
#include "tests/support/solver/frames.h"
#include "tests/support/solver/table_1.h"

BOOST_AUTO_TEST_SUITE(second_order)

using namespace trammel::solver;
using namespace trammel::testing;
using boost::test_tools::tolerance;

namespace {

/// EI = 1, clamped at the foot, 1 m long, a force of 1e-3 N across its tip.
StaticSolution column(double share_of_buckling_load) {
  const double critical = std::numbers::pi * std::numbers::pi / 4;
  Model model = cantilever(unit_section(), 1, 16);
  model.loads = {{1, {-share_of_buckling_load * critical, 1e-3, 0}}};
  return solve_statics(assemble(model), {.second_order = true});
}

/// The centred manipulator, rigid platform and hinged elbows, pulled along x.
StaticSolution manipulator(double force) {
  ManipulatorDesign design = table_1_design();
  design.elbow.fill({ElbowKind::hinged});
  design.platform.kind = PlatformKind::rigid;
  Model model = build_manipulator(design, centred_pose());
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    if (model.nodes[i].name == "P") model.loads = {{static_cast<Index>(i), {force, 0, 0}}};
  }
  BOOST_REQUIRE(!model.loads.empty());
  return solve_statics(assemble(model), {.second_order = true});
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_column_deflects_as_theory_says_however_near_its_buckling_load) {
  for (const double share : {0.1, 0.5, 0.6, 0.8, 0.98, 0.999}) {
    const double P = share * std::numbers::pi * std::numbers::pi / 4;
    const double k = std::sqrt(P);
    const StaticSolution found = column(share);
    BOOST_REQUIRE(found.outcome.solved());
    // (k h)^4 / 720 in the critical load, amplified
    BOOST_TEST(found.displacement(1, 1) == 1e-3 / P * (std::tan(k) / k - 1),
               tolerance(2e-7 / (1 - share)));
    BOOST_TEST(found.moment_residual < 1e-9);
  }
  for (const double share : {1.001, 1.5, 3.0}) BOOST_TEST(!column(share).outcome.solved());
}

BOOST_AUTO_TEST_CASE(beyond_its_limit_a_manipulator_has_no_second_order_equilibrium) {
  double last = 0;
  for (const double force : {10.0, 20.0, 28.0, 28.5}) {
    const StaticSolution found = manipulator(force);
    BOOST_REQUIRE(found.outcome.solved());
    BOOST_TEST(found.displacement.col(0).maxCoeff() > last);
    BOOST_TEST(found.equilibrium_residual < 1e-6);
    last = found.displacement.col(0).maxCoeff();
  }
  for (const double force : {30.0, 30.5, 31.5, 32.5, 33.5, 36.0, 40.0, 50.0, 60.0, 66.0, 100.0})
    BOOST_TEST(!manipulator(force).outcome.solved());
}

BOOST_AUTO_TEST_SUITE_END()
