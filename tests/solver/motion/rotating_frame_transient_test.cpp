#include "solver/motion/rotating_frame_transient.h"

#include <boost/test/unit_test.hpp>

#include "solver/linear/rotating_frame.h"
#include "solver/motion/transient.h"
#include "tests/support/solver/frames.h"

BOOST_AUTO_TEST_SUITE(rotating_frame_transient)

using namespace trammel::solver;
using namespace trammel::testing;
using Eigen::VectorXd;

namespace {

EquationOfMotion equation_in_rotating_frame(const System& system, const PrescribedRotation& axes) {
  EquationOfMotion equation;
  equation.M = system.M;
  equation.K = system.K;
  BOOST_TEST(add_rotating_frame_terms(system, axes, equation).solved());
  return equation;
}

PrescribedRotation steady(double speed) {
  PrescribedRotation axes;
  axes.speed = [speed](double) { return std::array<double, 2>{speed, 0}; };
  return axes;
}

}  // namespace

BOOST_AUTO_TEST_CASE(constant_speed_has_the_steady_state_of_the_frame) {
  Model model = cantilever(unit_section(), 1, 8);
  model.masses.push_back({1, 0.1, 0, {0, 0.05}});
  const System system = assemble(model);
  EquationOfMotion equation = equation_in_rotating_frame(system, steady(3));
  equation.update(0, equation.M, equation.C, equation.K);
  VectorXd f = VectorXd::Zero(system.K.rows());
  equation.load(0, f);
  RotatingOptions options;
  options.frame.speed = 3;
  options.prestress_at_steady_state = false;
  const RotatingModes rotating = solve_rotating_modes(system, options);
  BOOST_TEST(rotating.outcome.solved());
  // With q of order 1 and K of order 1e6, the residual is round-off error.
  BOOST_TEST((equation.K * rotating.q - f).norm() < 1e-9 * f.norm());
}

BOOST_AUTO_TEST_CASE(loads_that_do_not_rotate_with_the_frame_are_refused) {
  Model model = cantilever(unit_section(), 1, 2);
  model.loads.push_back({1, Vector3d(0, 1, 0)});
  const System system = assemble(model);
  EquationOfMotion equation;
  BOOST_CHECK_THROW(static_cast<void>(add_rotating_frame_terms(system, steady(1), equation)),
                    ModelError);
}

BOOST_AUTO_TEST_SUITE_END()
