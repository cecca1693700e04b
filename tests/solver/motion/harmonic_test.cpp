#include "solver/motion/harmonic.h"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "solver/linear/statics.h"
#include "tests/support/solver/frames.h"
#include "tests/support/solver/table_1.h"

BOOST_AUTO_TEST_SUITE(harmonic)

using namespace trammel::solver;
using namespace trammel::testing;
using boost::test_tools::tolerance;

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

Model oscillator() {
  Model model;
  model.nodes = {{"m", {0, 0}}};
  model.masses = {{0, 2, 0, {0, 0}}};
  model.springs = {{"k", {0, -1}, {50, 1000, 0}}};
  model.loads = {{0, {3, 0, 0}}};
  return model;
}

/// Returns two welded members, clamped at one end, under a line load.
Model frame() {
  Model model = cantilever(unit_section(), 1, 4, 0.5);
  model.nodes.push_back({"C", {1.4, 0.9}});
  model.members.push_back(member("BC", 1, 2, unit_section(), 3));
  model.members[0].load = {0.3, 1};
  return model;
}

}  // namespace

BOOST_AUTO_TEST_CASE(response_at_zero_frequency_is_statics) {
  const System system = assemble(frame());
  const StaticSolution statics = solve_statics(system);
  for (const std::size_t damped : {0, 3}) {
    const HarmonicSolver response(system, {{}, std::vector<double>(damped, 0.02)});
    const Eigen::VectorXcd q = response.at(0);
    BOOST_TEST((q.real() - statics.q).norm() < 1e-9 * statics.q.norm());
    const HarmonicAmplitudes a = response.amplitudes(q, 0);
    BOOST_TEST(a.resultant_start(0, 2) == std::abs(statics.resultant_start(0, 2)), tolerance(1e-9));
    BOOST_TEST(a.member_stress[0] == statics.member_stress[0], tolerance(1e-9));
  }
}

BOOST_AUTO_TEST_CASE(modal_superposition_equals_the_direct_solution) {
  // With Rayleigh damping, superposition of all modes equals the direct solution.
  const System system = assemble(frame());
  const HarmonicSolver direct(system, {{1.0, 1e-4}, {}});
  const HarmonicSolver superposed(system, {{1.0, 1e-4}, std::vector<double>(6, 0.0)});
  for (const double f : {0.2, 0.7, 3.0})
    BOOST_TEST((direct.at(f) - superposed.at(f)).norm() < 1e-9 * direct.at(f).norm());
}

// Two free masses of 2 and 3 kg on a spring of 50 N/m. The load displaces both by F / (m w^2), and
// the spring adds a relative displacement. At 1e-5 Hz K and w^2 M differ by a factor of 1e-9.
BOOST_AUTO_TEST_CASE(slowly_shaken_free_body_moves_by_its_mass) {
  Model model;
  model.nodes = {{"A", {0, 0}}, {"B", {1, 0}}};
  model.masses = {{0, 2, 0, {0, 0}}, {1, 3, 0, {0, 0}}};
  model.supports = {{"A", 0, {false, true, false}}, {"B", 1, {false, true, false}}};
  model.springs = {{"k", {0, 1}, {50, 0, 0}}};
  model.loads = {{1, {7, 0, 0}}};
  const System system = assemble(model);
  for (const std::size_t damped : {0, 1}) {
    const HarmonicSolver response(system, {{}, std::vector<double>(damped, 0.0)});
    BOOST_REQUIRE(response.outcome().solved());
    BOOST_TEST(response.at(0).size() == 0);
    for (const double f : {1e-7, 1e-5, 1e-3, 0.1, 0.7}) {
      const double w2 = std::pow(kTurn * f, 2);
      // The amplitudes a and b of the masses satisfy
      //
      //   (50 - 2 w^2) a - 50 b = 0, (50 - 3 w^2) b - 50 a = 7.
      const double determinant = w2 * (6 * w2 - 250);
      const Eigen::VectorXcd u = system.T.cast<std::complex<double>>() * response.at(f);
      BOOST_TEST(u[system.coordinates.node[0][0]].real() == 350 / determinant, tolerance(1e-9));
      BOOST_TEST(u[system.coordinates.node[1][0]].real() == 7 * (50 - 2 * w2) / determinant,
                 tolerance(1e-9));
    }
  }
}

BOOST_AUTO_TEST_CASE(free_part_without_mass_has_no_response) {
  Model model = oscillator();
  model.nodes.push_back({"loose", {1, 0}});
  model.springs.push_back({"y", {1, -1}, {0, 1000, 0}});
  model.loads = {{1, {3, 0, 0}}};
  const System system = assemble(model);
  const HarmonicSolver response(system, {});
  BOOST_TEST((response.outcome().status == Status::singular));
  BOOST_TEST(response.outcome().reason.find("massless") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(reciprocity_holds_with_damping) {
  const auto response = [&](Index loaded, Index observed) {
    Model model = frame();
    model.members[0].load.setZero();
    model.loads = {{loaded, {1, 0, 0}}};
    const System system = assemble(model);
    const HarmonicSolver solver(system, {{0.2, 0.001}, {0.01, 0.02}});
    const Eigen::VectorXcd u = system.T.cast<std::complex<double>>() * solver.at(0.7);
    return u[system.coordinates.node[static_cast<std::size_t>(observed)][0]];
  };
  const std::complex<double> reciprocal = response(2, 1);
  BOOST_TEST(std::abs(response(1, 2) - reciprocal) < 1e-9 * std::abs(reciprocal));
}

BOOST_AUTO_TEST_CASE(damped_thin_links_balance_in_every_row) {
  Model model = build_manipulator(meshed_design(8), centered_pose());
  model.loads.push_back({model.find_node("P"), {10, 0, 0}});
  const System system = assemble(model);
  const HarmonicSolver response(system, {{1, 1e-5}, {}});
  for (const double frequency : {1.0, 12.7, 60.0})
    BOOST_TEST(response.backward_error(response.at(frequency), frequency) < 1e-13);
}

BOOST_AUTO_TEST_CASE(invalid_damping_ratios_are_refused) {
  const System system = assemble(oscillator());
  BOOST_CHECK_THROW(HarmonicSolver(system, {{}, {-0.1}}), ModelError);
  BOOST_CHECK_THROW(HarmonicSolver(system, {{}, {0.1, 0.1, 0.1}}), ModelError);
}

BOOST_AUTO_TEST_SUITE_END()
