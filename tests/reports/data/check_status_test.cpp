#include "reports/data/check_status.h"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(check_status)

using namespace trammel::reports;

BOOST_AUTO_TEST_CASE(a_failure_or_an_error_is_no_pass) {
  BOOST_TEST(all_checks_pass({{CheckStatus::passes, 3}, {CheckStatus::known_discrepancy, 1}}));
  BOOST_TEST(!all_checks_pass({{CheckStatus::passes, 3}, {CheckStatus::fails, 1}}));
  BOOST_TEST(!all_checks_pass({{CheckStatus::passes, 3}, {CheckStatus::error, 1}}));
}

BOOST_AUTO_TEST_SUITE_END()
