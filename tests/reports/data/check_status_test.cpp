#include <boost/test/unit_test.hpp>

#include "reports/data/check_text.h"

BOOST_AUTO_TEST_SUITE(check_status)

using namespace trammel::reports;

BOOST_AUTO_TEST_CASE(failure_and_error_are_no_pass) {
  BOOST_TEST(all_checks_pass({{CheckStatus::passes, 3}, {CheckStatus::known_discrepancy, 1}}));
  BOOST_TEST(!all_checks_pass({{CheckStatus::passes, 3}, {CheckStatus::fails, 1}}));
  BOOST_TEST(!all_checks_pass({{CheckStatus::passes, 3}, {CheckStatus::error, 1}}));
}

BOOST_AUTO_TEST_CASE(check_group_has_the_verdict_of_its_worst_entry) {
  std::array<Check, 3> checks;
  for (Check& check : checks) check.verdict = Verdict::pass;
  checks[1].verdict = Verdict::fail;
  const CheckGroup group{{&checks[0], &checks[1], &checks[2]}};
  BOOST_TEST(&group.worst() == &checks[1]);
}

BOOST_AUTO_TEST_SUITE_END()
