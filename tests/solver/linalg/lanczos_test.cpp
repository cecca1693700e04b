#include "solver/linalg/lanczos.h"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(lanczos)

using namespace trammel::solver;
using Eigen::VectorXd;

// Spectra throws for both, which was told as our own fault.
BOOST_AUTO_TEST_CASE(an_operator_that_is_no_number_and_a_start_of_zeros_have_no_eigenpairs) {
  const auto overflowing = [](const VectorXd& x) -> VectorXd { return 1e300 * (1e300 * x); };
  const auto identity = [](const VectorXd& x) { return x; };
  for (const LanczosPairs& none : {largest_eigenpairs(overflowing, VectorXd::Ones(30), {3, 12}),
                                   largest_eigenpairs(identity, VectorXd::Zero(30), {3, 12})}) {
    BOOST_TEST(none.value.size() == 0);
    BOOST_TEST(none.vector.rows() == 30);
    BOOST_TEST(none.vector.cols() == 0);
  }
}

BOOST_AUTO_TEST_SUITE_END()
