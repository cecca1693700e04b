#include "harness/base/timing.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(timing)

using namespace trammel::harness;

BOOST_AUTO_TEST_CASE(quantiles_lie_between_the_sorted_values) {
  BOOST_TEST(quantile({3, 1, 2}, 0.5) == 2);
  BOOST_TEST(quantile({4, 1, 3, 2}, 0.5) == 2.5);
  BOOST_TEST(quantile({5, 1, 3, 2, 4}, 0.25) == 2);
  BOOST_TEST(quantile({5, 1, 3, 2, 4}, 1) == 5);
  BOOST_TEST(quantile({7}, 0.75) == 7);
}

BOOST_AUTO_TEST_CASE(shuffled_order_is_reproducible_for_a_seed) {
  std::uint64_t a = 1, b = 1, c = 2;
  const auto first = shuffle_indices(20, a), second = shuffle_indices(20, a);
  BOOST_TEST((first != second));
  BOOST_TEST((first == shuffle_indices(20, b)));
  BOOST_TEST((first != shuffle_indices(20, c)));
  auto sorted = first;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 0; i < sorted.size(); ++i) BOOST_TEST(sorted[i] == i);
}

BOOST_AUTO_TEST_CASE(each_repeat_runs_all_tasks_before_the_next) {
  std::vector<std::size_t> calls;
  std::vector<std::function<void()>> works;
  for (std::size_t i = 0; i < 3; ++i) works.emplace_back([&calls, i] { calls.push_back(i); });
  std::vector<std::size_t> after;  // total number of calls after each repeat
  TimingOptions options;
  options.shortest_s = 0;
  const auto timings = measure_interleaved(works, options, [&] { after.push_back(calls.size()); });
  BOOST_TEST_REQUIRE(timings.size() == 3U);
  BOOST_TEST_REQUIRE(after.size() == 7U);
  for (std::size_t r = 1; r < after.size(); ++r) {
    const auto from = calls.begin() + static_cast<std::ptrdiff_t>(after[r - 1]);
    const auto to = calls.begin() + static_cast<std::ptrdiff_t>(after[r]);
    for (std::size_t i = 0; i < 3; ++i) BOOST_TEST(std::count(from, to, i) == 1);
  }
  for (const Timing& timing : timings) {
    BOOST_TEST(timing.cpu_s.size() == 7U);
    BOOST_TEST(timing.runs_each == 1);
  }
  // Each of the three tasks has one warm-up call before the first repeat.
  BOOST_TEST(after[0] == 3 * 1U + 3U);
}

BOOST_AUTO_TEST_CASE(short_task_is_repeated_up_to_the_limit) {
  int calls = 0;
  TimingOptions options;
  options.shortest_s = 1;  // an empty task first reaches the maximum number of runs
  const auto timings = measure_interleaved({[&] { ++calls; }}, options, {});
  BOOST_TEST(timings[0].runs_each == 1000);
  BOOST_TEST(calls == 7 * 1000 + 2);
}

BOOST_AUTO_TEST_CASE(common_slowdown_does_not_change_the_time_ratio) {
  Timing baseline, timing;
  baseline.cpu_s = {1, 5, 1, 2, 1, 9, 1};
  for (const double t : baseline.cpu_s) timing.cpu_s.push_back(3 * t);
  timing.cpu_s[0] = 8;
  timing.cpu_s[2] = 0.1;
  const RelativeTime ratio = time_ratio(timing.cpu_s, baseline.cpu_s);
  BOOST_TEST(ratio.median == 3);
  BOOST_TEST(ratio.low == 0.1);
  BOOST_TEST(ratio.high == 8);
  // With 15 repeats, the confidence interval of the time ratio excludes the two smallest and the
  // two largest values.
  for (int i = 0; i < 8; ++i) baseline.cpu_s.push_back(1), timing.cpu_s.push_back(3);
  BOOST_TEST(time_ratio(timing.cpu_s, baseline.cpu_s).low == 3);
  BOOST_TEST(time_ratio(timing.cpu_s, baseline.cpu_s).high == 3);
}

BOOST_AUTO_TEST_SUITE_END()
