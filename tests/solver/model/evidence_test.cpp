#include "solver/model/evidence.h"

#include <boost/test/unit_test.hpp>
#include <limits>

BOOST_AUTO_TEST_SUITE(evidence)

using namespace trammel::solver;

BOOST_AUTO_TEST_CASE(result_without_residuals_is_not_solved) {
  BOOST_TEST(!outcome_by_evidence({}, {}).solved());
  Evidence other;
  other.add(Residual::load, 0);
  BOOST_TEST(outcome_by_evidence({}, other).solved());
  BOOST_TEST(!outcome_by_evidence({}, other, {Residual::equilibrium}).solved());
}

BOOST_AUTO_TEST_CASE(largest_residual_of_a_kind_decides_the_status) {
  Evidence evidence;
  evidence.add(Residual::equilibrium, 1e-16);
  BOOST_TEST(outcome_by_evidence({}, evidence).solved());
  evidence.add(Residual::equilibrium, 1e-6);
  evidence.add(Residual::equilibrium, 1e-16);
  const Outcome outcome = outcome_by_evidence({}, evidence);
  BOOST_TEST((outcome.status == Status::not_converged));
  BOOST_TEST(outcome.reason.find("'equilibrium' is 1e-06") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(residual_that_is_not_a_number_is_infinite) {
  Evidence evidence, sum;
  evidence.add(Residual::energy, std::numeric_limits<double>::quiet_NaN());
  sum.add(Residual::energy, 0);
  sum.add(evidence);
  BOOST_TEST(!outcome_by_evidence({}, sum).solved());
}

BOOST_AUTO_TEST_CASE(failed_solution_keeps_its_status) {
  const Outcome singular{Status::singular, "free motion"};
  BOOST_TEST((outcome_by_evidence(singular, {}).status == Status::singular));
}

BOOST_AUTO_TEST_CASE(one_missed_mode_is_refused) {
  Evidence evidence;
  evidence.add(Residual::mode_count, 1);
  BOOST_TEST(!outcome_by_evidence({}, evidence).solved());
}

BOOST_AUTO_TEST_CASE(load_residual_of_few_digits_is_accepted) {
  Evidence evidence;
  evidence.add(Residual::load, 1e-5);
  BOOST_TEST(outcome_by_evidence({}, evidence).solved());
}

BOOST_AUTO_TEST_SUITE_END()
