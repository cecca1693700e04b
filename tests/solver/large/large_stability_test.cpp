#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "solver/large/state_results.h"
#include "solver/large/static_path.h"
#include "tests/support/solver/large_models.h"

BOOST_AUTO_TEST_SUITE(large_stability)

namespace {

using namespace trammel::solver;
using namespace trammel::solver::large_motion;
using namespace trammel::testing;

constexpr double kPi = std::numbers::pi;

/// Returns a column along x under a compressive end load of 1, so that load factors are loads.
Model column(Index elements) {
  Model model = elastica(elements);
  model.loads = {{1, {-1, 0, 0}}};
  return model;
}

/// Returns a shallow arch of eight straight members between two hinged supports. The load at its
/// crown has the small horizontal component `across`.
Model shallow_arch(double across) {
  Model model;
  Section section = unit_section(1e4);
  section.EI = 1e4 / 12;
  for (Index i = 0; i <= 8; ++i) {
    const double angle = std::asin(50 / 252.5) * static_cast<double>(i - 4) / 4;
    model.nodes.push_back({"n", {252.5 * std::sin(angle), 252.5 * std::cos(angle) - 247.5}});
    if (i == 0) continue;
    model.members.push_back(member("piece", i - 1, i, section));
    model.members.back().elements = 2;
  }
  model.supports = {pin(0), pin(8)};
  model.loads = {{4, {across, -1, 0}}};
  return model;
}

}  // namespace

BOOST_AUTO_TEST_CASE(equilibrium_path_ends_at_its_target_load) {
  // The path of equilibria must end at the target load. If Newton's method does not converge from a
  // state far from the target, the load step must be reduced.
  const GeometricallyExactSystem system(column(24));
  StaticPathOptions options;
  options.target = kPi * kPi / 2;
  options.switch_branch = true;
  const StaticPath path = follow_static_path(system, options);
  BOOST_REQUIRE(path.outcome.solved());
  BOOST_TEST(path.points.back().state.load == options.target);
}

BOOST_AUTO_TEST_CASE(path_does_not_jump_to_a_near_branch) {
  for (const double across : {0.05, 0.01, 0.002}) {
    const GeometricallyExactSystem system(shallow_arch(across));
    StaticPathOptions options;
    options.target = 0.8;
    options.first_step = 0.05;
    const StaticPath path = follow_static_path(system, options);
    BOOST_REQUIRE(path.outcome.solved());
    BOOST_REQUIRE(path.events.size() == 2U);
    BOOST_TEST((path.events[0].kind == PathEvent::Kind::limit_point));
    BOOST_TEST((path.events[1].kind == PathEvent::Kind::limit_point));
    BOOST_TEST(path.points.back().unstable_directions == 0);  // the inverted arch is stable
    BOOST_TEST(node_motion(system, path.points.back().state.q)(4, 1) < -10);
  }
}

BOOST_AUTO_TEST_CASE(path_that_stops_reports_load_and_residual) {
  const GeometricallyExactSystem system(column(8));
  StaticPathOptions options;
  options.target = 100;
  options.max_points = 5;
  const StaticPath path = follow_static_path(system, options);
  BOOST_TEST((path.outcome.status == Status::not_converged));
  BOOST_TEST(path.outcome.reason.find("load factor") != std::string::npos);
  BOOST_TEST(path.outcome.reason.find("residual") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
