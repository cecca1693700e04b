#include "harness/studies/roofline.h"

#include <boost/test/unit_test.hpp>
#include <set>

BOOST_AUTO_TEST_SUITE(roofline)

/// Loops with memory or functions between their operations stay below one that has neither.
BOOST_AUTO_TEST_CASE(loops_are_counted_timed_and_below_the_peak) {
  const trammel::results::Roofline found = trammel::harness::measure_roofline();
  BOOST_TEST(found.bandwidth_B_per_s > 0);
  BOOST_TEST(found.loops.size() == 3U);
  std::set<std::string> titles;
  for (const auto& loop : found.loops) {
    titles.insert(loop.title);
    BOOST_TEST(loop.bytes > 0);
    BOOST_TEST(loop.operations > 0);
    BOOST_TEST(loop.operations / loop.cpu_s < found.peak_flop_per_s, loop.title);
  }
  BOOST_TEST(titles.size() == found.loops.size());
}

BOOST_AUTO_TEST_SUITE_END()
