#include <boost/test/unit_test.hpp>

#include "reports/data/check_text.h"
#include "reports/page/report.h"
#include "tests/support/reports/markup.h"
#include "tests/support/reports/workspace.h"

BOOST_AUTO_TEST_SUITE(junit)

using namespace trammel::testing;
using namespace trammel::results;

namespace {

std::string to_junit(const Results& results) {
  const Workspace workspace;
  trammel::reports::write_junit(results, workspace.path() / "junit.xml");
  return read_text_file(workspace.path() / "junit.xml");
}

}  // namespace

BOOST_AUTO_TEST_CASE(each_check_and_each_run_is_a_testcase) {
  const Results results = sample_results();
  std::size_t testcases = results.runs.size(), known = 0;
  for (const Run& run : results.runs)
    for (const trammel::reports::CheckGroup& group : trammel::reports::group_checks(run)) {
      ++testcases;
      known += trammel::reports::find_status(group.worst()) ==
               trammel::reports::CheckStatus::known_discrepancy;
    }
  const std::string xml = to_junit(results);
  BOOST_TEST(occurrences(xml, "<testsuite ") == results.cases.size());
  BOOST_TEST(occurrences(xml, "<testcase ") == testcases);
  BOOST_TEST(occurrences(xml, "<failure ") == 1U);
  BOOST_TEST(occurrences(xml, "<error ") == 2U);  // one of a check, one of a run
  BOOST_TEST(known > 0U);
  BOOST_TEST(occurrences(xml, "name=\"expected-status\"") == 1U);
  BOOST_TEST(occurrences(xml, "<skipped type=\"trammel.known-discrepancy\"") == known);
  BOOST_TEST(occurrences(xml, "<skipped type=\"trammel.not-run\"") == 1U);
  BOOST_TEST(occurrences(xml, "tests=\"" + std::to_string(testcases) +
                                  "\" failures=\"1\" errors=\"2\"") == 1U);
}

BOOST_AUTO_TEST_CASE(testcase_names_do_not_depend_on_the_outcome) {
  Results results = sample_results();
  const auto names = [&] { return attribute_values(to_junit(results), "name"); };
  const std::vector<std::string> before = names();
  for (Run& run : results.runs) {
    run.status = Status::singular;
    for (Check& check : run.checks) check.verdict = Verdict::error;
    run.checks.emplace_back().name = "unexpected-status";
  }
  BOOST_TEST((names() == before));
}

BOOST_AUTO_TEST_CASE(changed_discrepancy_is_a_failure_of_its_own_type) {
  Results results = sample_results();
  for (Run& run : results.runs)
    for (Check& check : run.checks)
      if (check.is_known_discrepancy()) check.verdict = Verdict::fail;
  BOOST_TEST(occurrences(to_junit(results), "<failure type=\"trammel.changed-discrepancy\"") > 0U);
}

BOOST_AUTO_TEST_CASE(text_from_the_results_is_escaped) {
  Results results = sample_results();
  results.runs.back().reason = "a < b && \"c\" \x01";
  const std::string xml = to_junit(results);
  BOOST_TEST(markup_fault(xml, false) == "");
  BOOST_TEST(xml.find("message=\"a &lt; b &amp;&amp; &quot;c&quot;  \"") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(singular_run_fails_unless_a_check_expects_it) {
  Results results = sample_results_of_case("vpcs-sdll02");
  BOOST_TEST(occurrences(to_junit(results), "<failure ") == 0U);
  results.runs.back().checks.clear();
  BOOST_TEST(occurrences(to_junit(results), "<failure ") == 1U);
}

BOOST_AUTO_TEST_SUITE_END()
