#include "solver/linalg/factorization.h"

#include <Eigen/SparseCore>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <thread>
#include <vector>

BOOST_AUTO_TEST_SUITE(factorization)

using namespace trammel::solver;
using Eigen::Index;

namespace {

/// Returns the matrix of the five-point stencil on a square grid of n x n points.
Eigen::SparseMatrix<double> square(Index n) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Index i = 0; i < n * n; ++i) {
    entries.emplace_back(i, i, 4.0);
    for (const Index j : {i + n, (i + 1) % n == 0 ? n * n : i + 1}) {
      if (j >= n * n) continue;
      entries.emplace_back(i, j, -1.0);
      entries.emplace_back(j, i, -1.0);
    }
  }
  Eigen::SparseMatrix<double> A(n * n, n * n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

}  // namespace

BOOST_AUTO_TEST_CASE(parallel_orderings_equal_serial_ones) {
  constexpr std::size_t kThreads = 4;
  const Eigen::SparseMatrix<double> A = square(80);  // large enough for nested dissection
  const Permutation alone = fill_reducing_order(A);
  for (int round = 0; round < 3; ++round) {
    std::vector<Permutation> found(kThreads);
    std::vector<std::thread> threads;
    threads.reserve(kThreads);
    for (Permutation& mine : found)
      threads.emplace_back([&A, &mine] { mine = fill_reducing_order(A); });
    for (std::thread& thread : threads) thread.join();
    for (const Permutation& mine : found) BOOST_TEST(mine.indices() == alone.indices());
  }
}

BOOST_AUTO_TEST_CASE(negative_stiffness_has_a_negative_pivot) {
  SparseMatrix A(1, 1);
  A.insert(0, 0) = -2;
  Factorization factorization;
  factorization.compute(A);
  BOOST_TEST(factorization.smallest_pivot() < 0);
}

BOOST_AUTO_TEST_CASE(matrix_factors_are_reused_for_the_same_matrix_only) {
  SparseMatrix A = square(3);
  SparseLdlt ldlt;
  for (const double last : {4.0, 4.0, -4.0, 4.0}) {
    A.coeffRef(8, 8) = last;
    BOOST_TEST(ldlt.factorize(A));
    BOOST_TEST(ldlt.negative_pivots() == (last > 0 ? 0 : 1));
  }
  A.coeffs().setZero();
  for (int again = 0; again < 2; ++again) BOOST_TEST(!ldlt.factorize(A));
}

BOOST_AUTO_TEST_CASE(last_correction_is_relative_to_the_solution) {
  // Solves 4 x = 8 iteratively with the factorization of the 1 x 1 matrix [5]. Each of eight steps
  // divides the error by 5.
  SparseMatrix A(1, 1);
  A.insert(0, 0) = 5;
  Factorization factorization;
  factorization.compute(A);
  Counters counters;
  const auto product = [](const Eigen::VectorXd& x) -> Eigen::VectorXd { return 4 * x; };
  const RefinedSolution found =
      refined_solve(product, factorization, Eigen::VectorXd::Constant(1, 8),
                    Eigen::VectorXd::Constant(1, 1.9), counters);
  BOOST_TEST(found.correction == 0.08 * std::pow(0.2, 7) / 2, boost::test_tools::tolerance(1e-5));
}

BOOST_AUTO_TEST_SUITE_END()
