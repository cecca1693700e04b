// ctest: timeout=300
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "solver/large/consistent_initialization.h"
#include "solver/large/integrate_large_motion.h"
#include "tests/support/solver/callable_system.h"

BOOST_AUTO_TEST_SUITE(slider_crank)

/// The slider-crank with a flexible connecting rod of the IVP test set (B. Simeon; F. Mazzia,
/// C. Magherini, problem "crank"): equations that are not a model of ours and try the integrator
/// alone. The rod has two bending shapes, q1 and q2, and a quadratic longitudinal one, q3 and q4;
/// the crank turns at 150 rad/s; there is no damping.
namespace {

using namespace trammel::solver;
using namespace trammel::solver::large_motion;
using Eigen::Matrix4d;
using Eigen::MatrixXd;
using Eigen::Vector4d;
using trammel::testing::CallableEquations;
using trammel::testing::CallableSystem;

constexpr double kPi = std::numbers::pi;
constexpr double kM1 = 0.36, kM2 = 0.151104, kM3 = 0.075552, kL1 = 0.15, kL2 = 0.30;
constexpr double kJ1 = 0.002727, kJ2 = 0.0045339259, kE = 2e11, kThick = 0.008, kRho = 7870;
constexpr double kSpeed = 150;

/// Matrices of the rod, as printed.
struct Rod {
  Matrix4d M = Matrix4d::Zero(), K = Matrix4d::Zero(), B = Matrix4d::Zero();
  Vector4d c1, c2, c12, c21;

  Rod() {
    const double m = kRho * kThick * kThick * kL2, k = kE * kThick * kThick / kL2;
    const double b = kThick * kThick * kL2, slender = (kThick / kL2) * (kThick / kL2);
    M.diagonal() << 0.5 * m, 0.5 * m, 8 * m, 2 * m;
    M(2, 3) = M(3, 2) = m;
    const double pi4 = std::pow(kPi, 4), pi3 = std::pow(kPi, 3);
    K.diagonal() << k * pi4 / 24 * slender, k * 2 * pi4 / 3 * slender, k * 16 / 3, k * 7 / 3;
    K(2, 3) = K(3, 2) = -k * 8 / 3;
    B(0, 2) = -b * 16 / pi3;
    B(0, 3) = b * (8 / pi3 - 1 / kPi);
    B(1, 3) = b * 0.5 / kPi;
    B -= B.transpose().eval();
    c1 = b * Vector4d(0, 0, 2.0 / 3, 1.0 / 6);
    c2 = b * Vector4d(2 / kPi, 0, 0, 0);
    c12 = kL2 * b * Vector4d(0, 0, 1.0 / 3, 1.0 / 6);
    c21 = kL2 * b * Vector4d(1 / kPi, -0.5 / kPi, 0, 0);
  }
};

const Rod& rod() {
  static const Rod one;
  return one;
}

MatrixXd mass(const VectorXd& p) {
  const Rod& r = rod();
  const Vector4d q = p.tail<4>();
  const double s = std::sin(p[0] - p[1]), c = std::cos(p[0] - p[1]);
  MatrixXd M = MatrixXd::Zero(7, 7);
  M(0, 0) = kJ1 + kM2 * kL1 * kL1;
  M(0, 1) = M(1, 0) = 0.5 * kL1 * kL2 * kM2 * c + kRho * kL1 * (s * r.c2.dot(q) + c * r.c1.dot(q));
  M(1, 1) = kJ2 + q.dot(r.M * q) + 2 * kRho * r.c12.dot(q);
  M(2, 2) = kM3;
  M.block<1, 4>(0, 3) = (kRho * kL1 * (-s * r.c1 + c * r.c2)).transpose();
  M.block<1, 4>(1, 3) = (kRho * r.c21 + kRho * r.B.transpose() * q).transpose();
  M.block<4, 1>(3, 0) = M.block<1, 4>(0, 3).transpose();
  M.block<4, 1>(3, 1) = M.block<1, 4>(1, 3).transpose();
  M.bottomRightCorner<4, 4>() = r.M;
  return M;
}

VectorXd force(double, const VectorXd& p, const VectorXd& v) {
  const Rod& r = rod();
  const Vector4d q = p.tail<4>(), u = v.tail<4>();
  const double s = std::sin(p[0] - p[1]), c = std::cos(p[0] - p[1]);
  const double v1 = v[0], v2 = v[1];
  VectorXd f = VectorXd::Zero(7);
  f[0] = -0.5 * kL1 * kL2 * kM2 * v2 * v2 * s +
         kRho * kL1 * v2 * v2 * (-s * r.c1.dot(q) + c * r.c2.dot(q)) -
         2 * kRho * kL1 * v2 * (c * r.c1.dot(u) + s * r.c2.dot(u));
  f[1] = 0.5 * kL1 * kL2 * kM2 * v1 * v1 * s +
         kRho * kL1 * v1 * v1 * (s * r.c1.dot(q) - c * r.c2.dot(q)) - 2 * kRho * v2 * r.c12.dot(u) -
         2 * v2 * u.dot(r.M * q) - kRho * u.dot(r.B.transpose() * u);
  f.tail<4>() =
      v2 * v2 * (r.M * q) +
      kRho * (v2 * v2 * r.c12 + kL1 * v1 * v1 * (c * r.c1 + s * r.c2) + 2 * v2 * (r.B * u)) -
      r.K * q;
  return f;
}

VectorXd constraint_residual(double t, const VectorXd& p) {
  const double length = kL2 + p[6];
  return Eigen::Vector3d(kL1 * std::sin(p[0]) + length * std::sin(p[1]),
                         p[2] - kL1 * std::cos(p[0]) - length * std::cos(p[1]), p[0] - kSpeed * t);
}

MatrixXd jacobian(double, const VectorXd& p) {
  const double length = kL2 + p[6];
  MatrixXd G = MatrixXd::Zero(3, 7);
  G(0, 0) = kL1 * std::cos(p[0]);
  G(0, 1) = length * std::cos(p[1]);
  G(0, 6) = std::sin(p[1]);
  G(1, 0) = kL1 * std::sin(p[0]);
  G(1, 1) = length * std::sin(p[1]);
  G(1, 2) = 1;
  G(1, 6) = -std::cos(p[1]);
  G(2, 0) = 1;
  return G;
}

CallableSystem slider_crank() {
  CallableEquations equations;
  equations.coordinates = 7;
  equations.constraints = 3;
  equations.mass = mass;
  equations.force = force;
  equations.constraint_residual = constraint_residual;
  equations.jacobian = jacobian;
  equations.constraint_time_derivative = [](double, const VectorXd&) -> VectorXd {
    return Eigen::Vector3d(0, 0, -kSpeed);
  };
  equations.scale = VectorXd::Ones(7);
  equations.scale[2] = 0.3;
  equations.scale.tail<4>().setConstant(1e-3);
  return CallableSystem(equations);
}

/// The state at 0.1 s with equal steps; the start is the printed one, put onto the constraints,
/// which it misses by 2e-10 m.
State at_the_end(double step, IntegrationSummary& summary) {
  const CallableSystem system = slider_crank();
  State state;
  state.q = VectorXd::Zero(7);
  state.q << 0, 0, 0.450016933, 0, 0, 0.103339863e-4, 0.169327969e-4;
  const Outcome start = make_consistent(
      system, state,
      {{3, 0.444896105}, {4, 0.463434311e-2}, {5, -0.178591076e-5}, {6, -0.268938672e-5}}, step);
  BOOST_REQUIRE_MESSAGE(start.solved(), start.reason);
  TransientOptions options;
  options.scheme = generalized_alpha(0.9);
  options.step = step;
  options.end = 0.1;
  options.sample_times = {0.1};
  summary = integrate(system, state, options);
  BOOST_REQUIRE_MESSAGE(summary.outcome.solved(), summary.outcome.reason);
  return state;
}

/// The same at two steps combined to what their common error of order 2 leaves.
VectorXd extrapolated(const VectorXd& coarse, const VectorXd& fine) {
  return (4 * fine - coarse) / 3;
}

VectorXd reference_places() {
  VectorXd p(7);
  p << 15.00000000000104, -.3311734988256260, .1697373328427860, 1.893192899613509e-4,
      2.375751249879174e-5, -5.323896770569702e-6, -8.363313279112129e-6;
  return p;
}

VectorXd reference_speeds() {
  VectorXd v(7);
  v << 150, 60.25346755138369, -8.753116326670527, -.03005541400289738, -.005500431812571696,
      4.974111734266989e-4, 1.105560003626645e-3;
  return v;
}

VectorXd reference_multipliers() {
  return Eigen::Vector3d(-62.32935833287916, -163.7920993367306, 25.29857947066878);
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_flexible_slider_crank_of_the_ivp_test_set_agrees_to_seven_digits) {
  IntegrationSummary summary;
  const State coarse = at_the_end(2e-6, summary);
  const State fine = at_the_end(1e-6, summary);
  const VectorXd p = extrapolated(coarse.q, fine.q) - reference_places();
  const VectorXd v = extrapolated(coarse.v, fine.v) - reference_speeds();
  const VectorXd lambda = extrapolated(coarse.lambda, fine.lambda) - reference_multipliers();
  // The printed start, and with it the reference, misses the slider's constraint by 2e-10 m.
  BOOST_TEST(p.head<3>().cwiseAbs().maxCoeff() < 5e-10);
  BOOST_TEST(p.tail<4>().cwiseAbs().maxCoeff() < 2e-10);
  // Longitudinal vibration at 3 kHz and more, of 1e-10 m, is what speeds and forces still feel.
  BOOST_TEST(v.head<3>().cwiseAbs().maxCoeff() < 4e-6);
  BOOST_TEST(v.tail<4>().cwiseAbs().maxCoeff() < 4e-6);
  BOOST_TEST(lambda.norm() < 5e-5 * reference_multipliers().norm());
}

BOOST_AUTO_TEST_CASE(its_joints_hold_in_place_and_in_speed) {
  IntegrationSummary summary;
  static_cast<void>(at_the_end(1e-5, summary));
  BOOST_TEST(summary.constraints.position < 1e-14);
  BOOST_TEST(summary.constraints.rate < 1e-11);  // round-off of 150 rad/s and 0.15 m
}

BOOST_AUTO_TEST_CASE(a_mass_starts_with_the_acceleration_that_its_drive_has_at_that_time) {
  const CallableSystem driven(
      {.coordinates = 1,
       .constraints = 1,
       .mass = [](const VectorXd&) -> MatrixXd { return MatrixXd::Constant(1, 1, 2); },
       .force = [](double, const VectorXd&, const VectorXd&) { return VectorXd::Zero(1).eval(); },
       .constraint_residual = [](double t, const VectorXd& q) -> VectorXd {
         return q - VectorXd::Constant(1, 1.5 * t * t);
       },
       .jacobian = [](double, const VectorXd&) -> MatrixXd { return MatrixXd::Ones(1, 1); },
       .constraint_time_derivative = [](double t, const VectorXd&) -> VectorXd {
         return VectorXd::Constant(1, -3 * t);
       },
       .scale = VectorXd::Ones(1)});
  State state;
  state.t = 0.2;
  state.q = VectorXd::Zero(1);
  BOOST_TEST_REQUIRE(make_consistent(driven, state, {}, 1e-3).solved());
  BOOST_TEST(std::abs(state.v[0] - 0.6) < 1e-12);
  BOOST_TEST(std::abs(state.a[0] - 3) < 1e-6);  // by differences
}

BOOST_AUTO_TEST_SUITE_END()
