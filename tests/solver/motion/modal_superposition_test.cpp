#include "solver/motion/modal_superposition.h"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "solver/linear/row_balance.h"
#include "tests/support/solver/numerics.h"

BOOST_AUTO_TEST_SUITE(modal_superposition)

using namespace trammel::solver;
using boost::test_tools::tolerance;
using std::numbers::pi;

namespace {

using Big = boost::multiprecision::cpp_bin_float_100;

/// Returns the impulse response by Taylor series with 100 digits in sufficiently short intervals.
ImpulseResponse response_with_100_digits(double omega, double decay, double t) {
  const int pieces = 1 + static_cast<int>(std::max(omega, decay) * t / 4);
  const Big w2 = Big(omega) * Big(omega);
  const Big dt = Big(t) / pieces;
  // The displacement y of an oscillator under a unit load is h1. Its derivatives are h and h', and
  // its integral is h2.
  Big y = 0;
  Big v = 0;
  Big sum = 0;
  for (int p = 0; p < pieces; ++p) {
    Big a = y;
    Big b = v * dt;
    Big next_y = a + b;
    Big next_v = v;
    Big integral = a * dt + b * dt / 2;
    for (int k = 2; k < 120; ++k) {
      const Big load = k == 2 ? Big(1) : Big(0);
      const Big c = ((load - w2 * a) * dt * dt - 2 * Big(decay) * (k - 1) * b * dt) / (k * (k - 1));
      next_y += c;
      next_v += c * k / dt;
      integral += c * dt / (k + 1);
      a = b;
      b = c;
    }
    sum += integral;
    y = next_y;
    v = next_v;
  }
  const Big dh = 1 - w2 * y - 2 * Big(decay) * v;
  return {.dh = static_cast<double>(dh),
          .h = static_cast<double>(v),
          .h1 = static_cast<double>(y),
          .h2 = static_cast<double>(sum)};
}

}  // namespace

BOOST_AUTO_TEST_CASE(impulse_response_is_accurate_for_any_damping) {
  double worst = 0;
  for (const double omega : {0.0, 1e-6, 1e-2, 0.9, 3.0, 50.0})
    for (const double ratio :
         {0.0, 1e-3, 0.1, 0.9, 1 - 1e-9, 1.0, 1 + 1e-9, 1.05, 1.16, 3.0, 1e4}) {
      const double decay = omega > 0 ? omega * ratio : ratio;
      for (const double t : {1e-5, 0.01, 0.3, 1.1, 7.0}) {
        if (decay * t > 500) continue;
        const ImpulseResponse r = impulse_response(omega, decay, t);
        const ImpulseResponse exact = response_with_100_digits(omega, decay, t);
        // Errors are relative to the largest amplitudes of an undamped motion. The factor 1 + w t
        // allows for the round-off error of the phase w t.
        const double phase = 1 + omega * t, h_size = std::min(t, 1 / std::max(omega, 1e-300));
        worst = std::max({worst, std::abs(r.h - exact.h) / (h_size * phase),
                          std::abs(r.dh - exact.dh) / phase,
                          std::abs(r.h1 - exact.h1) / std::max(exact.h1, h_size * h_size) / phase,
                          std::abs(r.h2 / exact.h2 - 1) / phase});
      }
    }
  BOOST_TEST(worst < 2e-14);
}

BOOST_AUTO_TEST_CASE(modes_omit_massless_coordinates_and_are_orthogonal) {
  const SparseMatrix M = sparse(Eigen::Vector4d(1, 2, 0, 3).asDiagonal());
  const SparseMatrix K = sparse(
      (Eigen::Matrix4d() << 2, -1, -1, 0, -1, 4, -2, -1, -1, -2, 5, -2, 0, -1, -2, 3).finished());
  const ModalBasis basis = all_modes(M, K);
  BOOST_TEST(basis.omega.size() == 3);
  const Eigen::MatrixXd mass = basis.shape.transpose() * (M * basis.shape);
  const Eigen::MatrixXd stiffness = basis.shape.transpose() * (K * basis.shape);
  BOOST_TEST((mass - Eigen::Matrix3d::Identity()).norm() < 1e-12);
  BOOST_TEST(
      (stiffness - Eigen::MatrixXd(basis.omega.array().square().matrix().asDiagonal())).norm() <
      1e-12);
  BOOST_TEST(basis.omega[0] == 0);  // rigid-body mode: the rows of K have zero sums
}

BOOST_AUTO_TEST_CASE(load_at_the_time_of_a_jump_has_the_later_value) {
  PiecewiseLinearLoad load;
  load.pattern = Eigen::MatrixXd::Identity(1, 1);
  load.time = {0, 1, 1, 3};
  load.factor = (Eigen::MatrixXd(1, 4) << 2, 4, 10, 0).finished();
  Eigen::VectorXd f(1);
  const auto at = [&](double t) {
    load.at(t, f);
    return f[0];
  };
  BOOST_TEST(at(-1) == 2);
  BOOST_TEST(at(0.5) == 3);
  BOOST_TEST(at(std::nextafter(1, 0)) == 4, tolerance(1e-12));
  BOOST_TEST(at(1) == 10);
  BOOST_TEST(at(2) == 5);
  BOOST_TEST(at(9) == 0);
}

BOOST_AUTO_TEST_CASE(coordinate_without_stiffness_and_mass_is_named) {
  const SparseMatrix one = sparse(Eigen::Vector2d(1, 0).asDiagonal());
  const ModalBasis basis = all_modes(one, one);
  BOOST_TEST((basis.outcome.status == Status::singular));
  BOOST_TEST(basis.outcome.reason == "a coordinate has neither stiffness nor mass");
  BOOST_TEST(basis.omega.size() == 0);
}

BOOST_AUTO_TEST_CASE(overflowing_numbers_have_no_modes) {
  const SparseMatrix M = sparse(Eigen::Vector2d(1e300, 1e300).asDiagonal());
  const SparseMatrix K = sparse(Eigen::Vector2d(1e308, 1e308).asDiagonal());
  BOOST_TEST(!all_modes(M, K).outcome.solved());
}

BOOST_AUTO_TEST_CASE(overdamping_frequency_agrees_with_closed_form) {
  const RayleighDamping printed{.mass = 0.02, .stiffness = 0.003};
  BOOST_TEST(damping_ratio(printed, overdamping_frequency(printed)) == 1, tolerance(1e-12));
  BOOST_TEST(std::isinf(overdamping_frequency({.mass = 1, .stiffness = 0})));
  BOOST_TEST(overdamping_frequency({.mass = 0, .stiffness = 0.5}) == 4);
  BOOST_TEST(overdamping_frequency({.mass = 3, .stiffness = 1}) == 1);
}

BOOST_AUTO_TEST_CASE(modes_decouple_with_rayleigh_and_modal_damping) {
  const SparseMatrix M = sparse(Eigen::Matrix3d{{2, .5, 0}, {.5, 3, .2}, {0, .2, 1}});
  const SparseMatrix K = sparse(Eigen::Matrix3d{{50, -20, 0}, {-20, 60, -30}, {0, -30, 45}});
  const ModalBasis basis = all_modes(M, K);
  const auto modal = [&basis](const SparseMatrix& C) -> Eigen::MatrixXd {
    return basis.shape.transpose() * (C * basis.shape);
  };
  const RayleighDamping rayleigh{.mass = 0.3, .stiffness = 0.01};
  const Eigen::MatrixXd expected = 2 * decay_rates(rayleigh, basis.omega).asDiagonal();
  BOOST_TEST((modal(damping_matrix(rayleigh, M, K)) - expected).norm() < 1e-12);
  const Eigen::Vector3d ratio(0.02, 0.1, 1.5);
  const Eigen::MatrixXd chosen = (2 * ratio.cwiseProduct(basis.omega)).asDiagonal();
  BOOST_TEST((modal(modal_damping_matrix(M, basis.omega, basis.shape, ratio)) - chosen).norm() <
             1e-12);
}

BOOST_AUTO_TEST_SUITE_END()
