// ctest: labels=slow;program timeout=1800
#include <boost/test/unit_test.hpp>

#include "tests/support/harness/interruption.h"

BOOST_AUTO_TEST_SUITE(many_interruptions)

BOOST_AUTO_TEST_CASE(two_hundred_kills_lose_and_duplicate_no_result) {
  trammel::testing::interrupt_and_resume(200, 2);
}

BOOST_AUTO_TEST_SUITE_END()
