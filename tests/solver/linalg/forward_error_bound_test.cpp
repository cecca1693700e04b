#include <Eigen/LU>
#include <boost/test/unit_test.hpp>
#include <cfenv>
#include <cmath>
#include <random>

#include "solver/linalg/forward_error.h"

BOOST_AUTO_TEST_SUITE(forward_error_bound)

using namespace trammel::solver;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

FactoredStiffness factors(const MatrixXd& A) {
  return {A.sparseView(), A.cwiseAbs().sparseView(), VectorXd::Ones(A.rows())};
}

/// Solution q of A^T C A q = f with an error bound of all its coordinates.
struct Bounded {
  VectorXd q;
  double bound = 0;
};

Bounded bounded_solution(const FactoredStiffness& K, const VectorXd& f) {
  const AugmentedSystem augmented(K);
  BOOST_TEST_REQUIRE(augmented.is_nonsingular());
  const Operator solve = [&](const VectorXd& b) -> VectorXd { return augmented.solve(b).x; };
  SparseMatrix R(f.size(), f.size());
  R.setIdentity();
  const VectorXd q = solve(f);
  return {q, forward_error(K, R, q, f, solve)};
}

}  // namespace

BOOST_AUTO_TEST_CASE(estimated_norm_is_a_close_lower_bound) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> entry(-1, 1);
  for (int trial = 0; trial < 50; ++trial) {
    const MatrixXd B = MatrixXd::NullaryExpr(9, 6, [&] { return std::pow(entry(random), 5); });
    const double norm = B.cwiseAbs().colwise().sum().maxCoeff();
    const double estimate = estimate_norm(
        6, [&](const VectorXd& x) -> VectorXd { return B * x; },
        [&](const VectorXd& y) -> VectorXd { return B.transpose() * y; });
    BOOST_TEST(estimate <= norm * (1 + 1e-15));
    BOOST_TEST(estimate >= norm / 3);
  }
}

BOOST_AUTO_TEST_CASE(error_bound_follows_condition_of_A_near_a_singularity) {
  // A = [1 1; 1 1 + phi] becomes singular for phi = 0. The exact solution is q = (1 - 1/phi,
  // 1/phi). K = A^T A has a condition number of about 16/phi^2.
  for (int power = 4; power <= 40; power += 4) {
    const double phi = std::ldexp(1.0, -power);
    const FactoredStiffness K = factors(MatrixXd{{1, 1}, {1, 1 + phi}});
    const auto [q, bound] = bounded_solution(K, Eigen::Vector2d(3, 3 + 2 * phi));
    BOOST_TEST(std::abs(q[1] * phi - 1) <= bound);
    BOOST_TEST(bound >= kEps / phi);
    BOOST_TEST(bound <= 30 * kEps / phi);
  }
}

BOOST_AUTO_TEST_CASE(stiff_spring_does_not_increase_the_error_bound) {
  for (const double stiff : {1.0, 1e6, 1e12}) {  // two springs in series; the first spring is stiff
    FactoredStiffness K = factors(MatrixXd{{1, 0}, {-1, 1}});
    K.C = Eigen::Vector2d(stiff, 1);
    const auto [q, bound] = bounded_solution(K, Eigen::Vector2d(0, 1));
    BOOST_TEST(q[1] == 1 + 1 / stiff, boost::test_tools::tolerance(1e-15));
    BOOST_TEST(bound < 20 * kEps);
  }
}

// R selects the coordinate q[1] as the only result. The norm in the error bound is then a sum,
// which the program computes exactly instead of estimating the norm.
BOOST_AUTO_TEST_CASE(error_bound_is_the_sum_of_rounded_strains_and_forces) {
  FactoredStiffness K = factors(MatrixXd{{1, 0}, {-3, 2}, {0.5, 1}});
  K.C = Eigen::Vector3d(2, 5, 0.7);
  const MatrixXd A = K.A;
  const MatrixXd inverse = (A.transpose() * K.C.asDiagonal() * A).inverse();
  const VectorXd f = Eigen::Vector2d(0.3, -4), q = inverse * f;
  SparseMatrix R(1, 2);
  R.insert(0, 1) = 1;
  const VectorXd p = inverse.col(1), s = K.C.cwiseProduct(A * q);
  const VectorXd in_row = Eigen::Vector3d(2, 3, 3).cwiseSqrt();
  const VectorXd in_column = Eigen::Vector2d(4, 3).cwiseSqrt(), size = A.cwiseAbs() * q.cwiseAbs();
  const double of_strains = in_row.cwiseProduct(size).cwiseProduct(K.C).dot((A * p).cwiseAbs());
  const VectorXd force = A.cwiseAbs().transpose() * s.cwiseAbs() + f.cwiseAbs();
  const double of_forces = in_column.cwiseProduct(force).dot(p.cwiseAbs());
  const Operator solve = [&](const VectorXd& b) -> VectorXd { return inverse * b; };
  BOOST_TEST(
      forward_error(K, R, q, f, solve) == kEps / 2 * (of_strains + of_forces) / std::abs(q[1]),
      boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(error_bound_doubles_with_directed_rounding) {
  const FactoredStiffness K = factors(MatrixXd{{1, 0}, {-1, 1}});
  const VectorXd q = Eigen::Vector2d(1, 2), f = Eigen::Vector2d(0, 1);
  const AugmentedSystem augmented(K);
  const Operator solve = [&](const VectorXd& b) -> VectorXd { return augmented.solve(b).x; };
  SparseMatrix R(2, 2);
  R.setIdentity();
  const double nearest = forward_error(K, R, q, f, solve);
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    const double directed = forward_error(K, R, q, f, solve);
    std::fesetround(FE_TONEAREST);
    BOOST_TEST(directed == 2 * nearest, boost::test_tools::tolerance(1e-14));
  }
}

BOOST_AUTO_TEST_SUITE_END()
