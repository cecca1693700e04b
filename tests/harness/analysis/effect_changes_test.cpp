#include "harness/analysis/effect_changes.h"

#include <boost/test/unit_test.hpp>
#include <limits>

BOOST_AUTO_TEST_SUITE(effect_changes)

using namespace trammel::harness;

BOOST_AUTO_TEST_CASE(missing_quantity_or_mode_is_an_infinite_change) {
  Quantities whole;
  whole["frequency_Hz"] = {{1, 2}, {}};
  whole["displacement_y_m:B"] = {{0.1}, {}};
  Quantities without = whole;
  BOOST_TEST(max_change(result_changes(whole, without, {.length = 1})).value == 0);
  without.erase("displacement_y_m:B");  // a simplified model may lack a quantity
  BOOST_TEST(max_change(result_changes(whole, without, {.length = 1})).value == 0);
  without.erase("frequency_Hz");
  BOOST_TEST(max_change(result_changes(whole, without, {.length = 1})).value ==
             std::numeric_limits<double>::infinity());
}

BOOST_AUTO_TEST_SUITE_END()
