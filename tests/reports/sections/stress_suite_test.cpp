#include <boost/test/unit_test.hpp>

#include "tests/support/reports/markup.h"
#include "tests/support/reports/workspace.h"

BOOST_AUTO_TEST_SUITE(stress_suite)

using namespace trammel::testing;
using namespace trammel::results;

namespace {

/// Returns the sample with three of its cases as items 1, 3 and 4 of a stress suite.
Results results_with_stress_suite() {
  Results results = sample_results();
  results.cases[2].stress_suite = StressSuiteEntry{1, {"fe-program"}};
  results.cases[0].stress_suite = StressSuiteEntry{3, {"exact"}};
  results.cases[1].stress_suite = StressSuiteEntry{4, {"printed"}};
  return results;
}

std::string stress_suite_text(const Results& results) {
  const std::string page = all_pages_of(results);
  const std::size_t from = page.find("<section id=\"stress-suite\">");
  return from == std::string::npos ? "" : page.substr(from, page.find("</section>", from) - from);
}

}  // namespace

BOOST_AUTO_TEST_CASE(items_are_ordered_with_the_worst_of_each_indicator) {
  Results results = results_with_stress_suite();
  results.runs[0].checks[1].verdict = Verdict::fail;  // a check of the indicator "exact"
  const std::string text = stress_suite_text(results);
  BOOST_TEST(text.find("3 items, 3 cases, 3 indicators:") != std::string::npos);
  const std::size_t first = text.find("cases/" + results.cases[2].id),
                    third = text.find("cases/" + results.cases[0].id),
                    fourth = text.find("cases/" + results.cases[1].id);
  BOOST_TEST((first < third && third < fourth && fourth != std::string::npos));
  BOOST_TEST(occurrences(text, "<tr><th scope=\"row\">") == 6U);  // three cases, three indicators
  BOOST_TEST(text.find("1 fails") != std::string::npos);
  BOOST_TEST(occurrences(text, "class=\"mark fails\"") == 1U);
}

BOOST_AUTO_TEST_CASE(stress_suite_indicator_without_a_run_fails) {
  Results results = results_with_stress_suite();
  for (CaseInfo& info : results.cases)
    if (info.stress_suite) info.stress_suite->indicators = {"nowhere"};
  const std::string text = stress_suite_text(results);
  BOOST_TEST(occurrences(text, "no run has this check") == 3U);
  BOOST_TEST(text.find("3 not run") != std::string::npos);
  BOOST_TEST(stress_suite_text(sample_results()).empty());
}

BOOST_AUTO_TEST_SUITE_END()
