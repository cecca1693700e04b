#include <boost/test/unit_test.hpp>
#include <fstream>

#include "harness/base/errors.h"
#include "harness/run/results.h"
#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(history)

using namespace trammel;
using namespace trammel::testing;

namespace {

/// Returns the results of a call of the program with one check that has this value and verdict.
results::Results call(const std::string& commit, double value,
                      results::Verdict verdict = results::Verdict::pass, std::size_t work = 10) {
  results::Results made;
  made.environment.commit = commit;
  results::Run run;
  run.case_id = "a";
  run.variant = "base";
  run.cost.cpu_s = 1;
  run.cost.counters = {{"solves", work}};
  results::Check check;
  check.name = "c";
  check.quantity = "frequency_Hz";
  check.index = 2;
  check.computed = value;
  check.verdict = verdict;
  run.checks = {check};
  made.runs = {run};
  return made;
}

History kept(const Folder& folder, const std::vector<results::Results>& calls) {
  const auto file = folder.path() / "history.db";
  for (const results::Results& one : calls) append_history(file, one);
  return read_history(file);
}

}  // namespace

BOOST_AUTO_TEST_CASE(first_commit_of_a_changed_value_is_named) {
  const Folder folder;
  const History found = kept(folder, {call("one", 10), call("two", 10 + 1e-10), call("three", 11),
                                      call("four", 11, results::Verdict::fail),
                                      call("five", 11.5, results::Verdict::fail)});
  BOOST_TEST(found.calls.size() == 5U);
  BOOST_TEST(found.since == 3);
  BOOST_REQUIRE(found.changes.size() == 1U);
  BOOST_TEST(found.changes[0].name == "a:base c frequency_Hz");
  BOOST_TEST(found.changes[0].commit == "four");
  BOOST_TEST(found.changes[0].verdict_before == "pass");
  BOOST_TEST(found.changes[0].verdict == "fail");
}

BOOST_AUTO_TEST_CASE(round_off_and_reverted_values_are_no_change) {
  const Folder folder;
  BOOST_TEST(kept(folder, {call("one", 10), call("two", 10 * (1 + 1e-12))}).changes.empty());
  const History back = kept(folder, {call("three", 12, results::Verdict::fail), call("four", 10)});
  BOOST_TEST(back.since == 2);
  BOOST_TEST(back.changes.empty());
}

BOOST_AUTO_TEST_CASE(change_by_a_millionth_of_tolerance_is_round_off) {
  const auto tolerated = [](const std::string& commit, double value) {
    results::Results made = call(commit, value);
    made.runs[0].checks[0].tolerance = results::Tolerance{-1.0, 1.0, true};
    return made;
  };
  const Folder folder, other;
  BOOST_TEST(kept(folder, {tolerated("one", 10), tolerated("two", 10 + 5e-7)}).changes.empty());
  BOOST_TEST(kept(other, {tolerated("one", 10), tolerated("two", 10.001)}).changes.size() == 1U);
}

BOOST_AUTO_TEST_CASE(small_changes_in_one_direction_are_a_drift) {
  const Folder folder, other;
  const History found =
      kept(folder, {call("1", 10), call("2", 10.01), call("3", 10.02), call("4", 10.03)});
  BOOST_REQUIRE(found.drifts.size() == 1U);
  BOOST_TEST(found.drifts[0].steps == 3U);
  BOOST_TEST(kept(other, {call("1", 10), call("2", 10.01), call("3", 10), call("4", 10.03)})
                 .drifts.empty());
}

BOOST_AUTO_TEST_CASE(work_counters_are_compared_exactly) {
  const Folder folder;
  results::Results without = call("two", 10, results::Verdict::pass, 11);
  without.runs[0].checks.clear();
  const History found = kept(folder, {call("one", 10), without});
  BOOST_REQUIRE(found.work.size() == 1U);
  BOOST_TEST(*found.work[0].after == 11);
  BOOST_REQUIRE(found.changes.size() == 1U);
  BOOST_TEST(found.changes[0].verdict == "gone");
}

BOOST_AUTO_TEST_CASE(unchanged_values_are_not_written_again) {
  const Folder folder;
  results::Results many = call("same", 10);
  std::vector<results::Check>& checks = many.runs[0].checks;
  for (int i = 3; i < 200; ++i) checks.push_back(checks[0]), checks.back().index = i;
  std::vector<results::Results> calls(50, many);
  (void)kept(folder, {calls[0]});
  const auto before = std::filesystem::file_size(folder.path() / "history.db");
  (void)kept(folder, calls);
  BOOST_TEST(std::filesystem::file_size(folder.path() / "history.db") <= before + 8192);
}

BOOST_AUTO_TEST_CASE(file_that_is_no_history_is_not_changed) {
  const Folder folder;
  (void)folder.write("history.db", "not a database, but long enough to be read as one");
  BOOST_CHECK_THROW(append_history(folder.path() / "history.db", call("one", 10)), InputError);
  BOOST_CHECK_THROW((void)read_history(folder.path() / "none.db"), InputError);
}

BOOST_AUTO_TEST_CASE(history_of_a_later_format_is_refused) {
  const Folder folder;
  const auto file = folder.path() / "history.db";
  (void)kept(folder, {call("one", 10)});
  std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
  bytes.seekp(63);  // the user_version in SQLite's header ends at this byte
  bytes.put(2);
  bytes.close();
  BOOST_CHECK_THROW(append_history(file, call("two", 10)), InputError);
  BOOST_CHECK_THROW((void)read_history(file), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
