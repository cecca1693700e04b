#include <boost/test/unit_test.hpp>

#include "solver/linalg/eigenpairs.h"

BOOST_AUTO_TEST_SUITE(lanczos)

using namespace trammel::solver;
using Eigen::VectorXd;

// The library Spectra throws an exception if values overflow or the start vector is zero. The
// program once reported this exception as an internal error.
BOOST_AUTO_TEST_CASE(overflow_and_zero_start_have_no_eigenpairs) {
  const auto overflowing = [](const VectorXd& x) -> VectorXd { return 1e300 * (1e300 * x); };
  const auto identity = [](const VectorXd& x) { return x; };
  for (const LanczosPairs& none : {largest_eigenpairs(overflowing, VectorXd::Ones(30), {3, 12}),
                                   largest_eigenpairs(identity, VectorXd::Zero(30), {3, 12})}) {
    BOOST_TEST(none.value.size() == 0);
    BOOST_TEST(none.vector.rows() == 30);
    BOOST_TEST(none.vector.cols() == 0);
  }
}

// Spectra's convergence threshold is absolute for eigenvalues below eps^(2/3). In small units,
// eigenvectors once did not converge.
BOOST_AUTO_TEST_CASE(vectors_of_small_eigenvalues_are_accurate) {
  constexpr Index kSize = 200;
  const VectorXd start = start_vectors(kSize, 1);
  for (const double unit : {1.0, 1e-18}) {
    const VectorXd values = unit * VectorXd::LinSpaced(kSize, 1, kSize).cwiseInverse();
    const auto apply = [&](const VectorXd& x) -> VectorXd { return values.cwiseProduct(x); };
    const LanczosPairs pairs = largest_eigenpairs(apply, start, {4, 24});
    BOOST_TEST_REQUIRE(pairs.value.size() == 4);
    for (Index j = 0; j < 4; ++j) {
      const VectorXd x = pairs.vector.col(j);
      BOOST_TEST((apply(x) - pairs.value[j] * x).norm() < 2e-9 * pairs.value[j]);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
