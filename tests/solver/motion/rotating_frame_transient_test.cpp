#include "solver/motion/rotating_frame_transient.h"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "solver/linear/rotating_frame.h"
#include "solver/motion/transient.h"
#include "tests/support/solver/frames.h"

BOOST_AUTO_TEST_SUITE(rotating_frame_transient)

using namespace trammel::solver;
using namespace trammel::testing;
using Eigen::VectorXd;

namespace {

EquationOfMotion equation_of(const System& system, const PrescribedRotation& axes) {
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

BOOST_AUTO_TEST_CASE(at_a_steady_speed_it_has_the_steady_state_of_the_rotating_frame) {
  Model model = cantilever(unit_section(), 1, 8);
  model.masses.push_back({1, 0.1, 0, {0, 0.05}});
  const System system = assemble(model);
  EquationOfMotion equation = equation_of(system, steady(3));
  equation.update(0, equation.M, equation.C, equation.K);
  VectorXd f = VectorXd::Zero(system.K.rows());
  equation.load(0, f);
  RotatingOptions options;
  options.frame.speed = 3;
  options.prestress_at_steady_state = false;
  const RotatingModes rotating = solve_rotating_modes(system, options);
  BOOST_TEST(rotating.outcome.solved());
  // q of size 1 under a K of 1e6: the residual is round-off of that.
  BOOST_TEST((equation.K * rotating.q - f).norm() < 1e-9 * f.norm());
}

BOOST_AUTO_TEST_CASE(a_mass_on_a_soft_spring_moves_as_it_does_seen_from_the_ground) {
  // Fixed to the axes at the centre by equal springs in x and y, k = 4 and m = 1: seen from the
  // ground it swings as cos 2 t about the centre, whatever the axes do.
  Model model;
  model.nodes = {{"P", {1, 0}}};
  model.masses.push_back({0, 1, 0, {0, 0}});
  Spring spring;
  spring.name = "s";
  spring.nodes = {0, -1};
  spring.stiffness = {4, 4, 0};
  model.springs.push_back(spring);
  const System system = assemble(model);
  PrescribedRotation axes;
  axes.speed = [](double t) { return std::array<double, 2>{0.3 * t * t, 0.6 * t}; };
  axes.stiffening = false;
  const EquationOfMotion equation = equation_of(system, axes);
  TransientOptions options;
  options.end = 2;
  options.step = 1e-3;
  const TransientHistory found = solve_transient(equation, options);
  BOOST_TEST(found.summary.outcome.solved());
  // The spring pulls towards where the axes hold it, (cos a, sin a) on the ground, a = 0.1 t^3. The
  // same motion on the ground by the classical method of Runge and Kutta.
  using State = Eigen::Vector4d;
  const auto rate = [](double t, const State& z) -> State {
    const double a = 0.1 * t * t * t;
    return {z[2], z[3], -4 * (z[0] - std::cos(a)), -4 * (z[1] - std::sin(a))};
  };
  State z(1, 0, 0, 0);
  constexpr double h = 1e-3;
  for (int i = 0; i < 2000; ++i) {
    const double t = i * h;
    const State k1 = rate(t, z), k2 = rate(t + h / 2, z + h / 2 * k1),
                k3 = rate(t + h / 2, z + h / 2 * k2), k4 = rate(t + h, z + h * k3);
    z += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  const double a = 0.8;
  const double x = std::cos(a) * z[0] + std::sin(a) * z[1] - 1;
  const double y = std::cos(a) * z[1] - std::sin(a) * z[0];
  const VectorXd q = found.q.col(found.q.cols() - 1);
  BOOST_TEST(std::hypot(q[0] - x, q[1] - y) < 1e-6);  // order 2 at 1 ms
}

BOOST_AUTO_TEST_CASE(loads_that_would_not_turn_are_refused) {
  Model model = cantilever(unit_section(), 1, 2);
  model.loads.push_back({1, Vector3d(0, 1, 0)});
  const System system = assemble(model);
  EquationOfMotion equation;
  BOOST_CHECK_THROW(static_cast<void>(add_rotating_frame_terms(system, steady(1), equation)),
                    ModelError);
}

BOOST_AUTO_TEST_SUITE_END()
