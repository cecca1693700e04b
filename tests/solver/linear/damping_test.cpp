#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "solver/linear/row_balance.h"
#include "solver/motion/modal_superposition.h"
#include "tests/support/solver/numerics.h"

BOOST_AUTO_TEST_SUITE(damping)

using namespace trammel::solver;
using std::numbers::pi;

namespace {}  // namespace

BOOST_AUTO_TEST_CASE(the_printed_factors_mean_12_percent_at_13_Hz_and_overdamping_above_106_Hz) {
  const RayleighDamping printed{.mass = 0.02, .stiffness = 0.003};
  BOOST_TEST(std::abs(damping_ratio(printed, 2 * pi * 13) - 0.1226) < 1e-4);
  const double above = overdamped_above(printed);
  BOOST_TEST(std::abs(above / (2 * pi) - 106.1) < 0.05);
  BOOST_TEST(std::abs(damping_ratio(printed, above) - 1) < 1e-12);
}

BOOST_AUTO_TEST_CASE(overdamping_has_its_limits) {
  BOOST_TEST(std::isinf(overdamped_above({.mass = 1, .stiffness = 0})));
  BOOST_TEST(overdamped_above({.mass = 0, .stiffness = 0.5}) == 4);
  BOOST_TEST(overdamped_above({.mass = 3, .stiffness = 1}) == 1);
}

BOOST_AUTO_TEST_CASE(modes_decouple_under_both_dampings) {
  const SparseMatrix M = sparse((Eigen::Matrix3d() << 2, .5, 0, .5, 3, .2, 0, .2, 1).finished());
  const SparseMatrix K =
      sparse((Eigen::Matrix3d() << 50, -20, 0, -20, 60, -30, 0, -30, 45).finished());
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
