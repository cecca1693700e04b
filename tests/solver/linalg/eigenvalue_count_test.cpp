#include <boost/test/unit_test.hpp>

#include "solver/linalg/eigenpairs.h"

BOOST_AUTO_TEST_SUITE(eigenvalue_count)

namespace {

using namespace trammel::solver;
using Eigen::MatrixXd;
using Eigen::VectorXd;

SparseMatrix diagonal(const VectorXd& values) {
  return SparseMatrix(values.asDiagonal());
}

}  // namespace

BOOST_AUTO_TEST_CASE(missing_and_duplicate_eigenvalues_are_counted) {
  const SparseMatrix A = diagonal(VectorXd{{1, 2, 2, 5, 9}}), B = diagonal(VectorXd::Ones(5));
  MatrixXd shapes = MatrixXd::Identity(5, 4);
  BOOST_TEST(eigenvalue_count_error(A, B, VectorXd{{1, 2, 2, 5}}) == 0);
  BOOST_TEST(eigenvalue_count_error(A, B, VectorXd{{2, 2, 5}}) == 1);
  BOOST_TEST(eigenvalue_count_error(A, B, VectorXd{{1, 1, 2, 2, 5}}) == 1);
  BOOST_TEST(eigenvalue_count_error(A, B, VectorXd{{1, 2, 2, 5}}, {}, 7) == 0);
  BOOST_TEST(eigenvalue_count_error(A, B, VectorXd{{2, 2, 5}}, {}, 7) == 1);
  // The last argument, a shift, must lie between the computed eigenvalues and all higher
  // eigenvalues. The next two shifts do not, so that the count below the last clear gap between
  // eigenvalues is used.
  BOOST_TEST(eigenvalue_count_error(A, B, VectorXd{{1, 2, 2, 5}}, {}, 3) == 0);
  BOOST_TEST(eigenvalue_count_error(A, B, VectorXd{{1, 2, 2}}, {}, 7) == 0);
  BOOST_TEST(count_dependent_vectors(B, shapes) == 0);
  // The lowest eigenvalue is missing and another eigenvalue is repeated, so the count is correct.
  BOOST_TEST(eigenvalue_count_error(A, B, VectorXd{{2, 2, 2, 5}}) == 0);
  shapes.col(0) = 0.6 * shapes.col(1) + 0.8 * shapes.col(2);
  BOOST_TEST(count_dependent_vectors(B, shapes) == 1);
  shapes(0, 0) = std::nan("");
  BOOST_TEST(count_dependent_vectors(B, shapes) == 4);
}

BOOST_AUTO_TEST_SUITE_END()
