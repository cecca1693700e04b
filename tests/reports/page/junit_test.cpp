#include <boost/test/unit_test.hpp>

#include "reports/page/report.h"
#include "tests/support/reports/markup.h"
#include "tests/support/reports/sample.h"
#include "tests/support/reports/workspace.h"

BOOST_AUTO_TEST_SUITE(junit)

using namespace trammel::testing;

namespace {

std::string junit_of(const nlohmann::ordered_json& results) {
  const Workspace workspace;
  trammel::reports::write_junit(trammel::results::read_results(results),
                                workspace.path() / "junit.xml");
  return text_of(workspace.path() / "junit.xml");
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_testcase_stands_for_every_check_and_every_run) {
  const auto results = sample_results();
  std::size_t checks = 0, runs = 0, failures = 0, errors = 0, skipped = 0;
  for (const auto& run : results["runs"]) {
    ++runs;
    errors += run["status"] == "error";
    for (const auto& check : run["checks"]) {
      ++checks;
      failures += check["verdict"] == "fail";
      errors += check["verdict"] == "error";
      skipped += check["verdict"] == "not-run";
    }
  }
  const std::string xml = junit_of(results);
  BOOST_TEST(occurrences(xml, "<testsuite ") == results["cases"].size());
  BOOST_TEST(occurrences(xml, "<testcase ") == checks + runs);
  BOOST_TEST(occurrences(xml, "<failure ") == failures);
  BOOST_TEST(occurrences(xml, "<error ") == errors);
  BOOST_TEST(occurrences(xml, "<skipped ") == skipped);
  const std::string head = xml.substr(xml.find("<testsuites"), 200);
  BOOST_TEST(head.find("tests=\"" + std::to_string(checks + runs) + "\" failures=\"" +
                       std::to_string(failures) + "\" errors=\"" + std::to_string(errors) + "\"") !=
             std::string::npos);
  BOOST_TEST(failures > 0U);
  BOOST_TEST(errors > 0U);
}

BOOST_AUTO_TEST_CASE(text_from_the_results_is_escaped) {
  auto results = sample_results();
  results["runs"].back()["reason"] = "a < b && \"c\" \x01";
  const std::string xml = junit_of(results);
  BOOST_TEST(markup_fault(xml, false) == "");
  BOOST_TEST(xml.find("message=\"a &lt; b &amp;&amp; &quot;c&quot;  \"") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_singular_run_is_a_failure_unless_its_checks_expect_it) {
  auto results = sample_results();
  const std::string before = junit_of(results);
  for (auto& run : results["runs"])
    if (run["status"] == "singular") run["checks"] = nlohmann::ordered_json::array();
  BOOST_TEST(occurrences(junit_of(results), "<failure ") == occurrences(before, "<failure ") + 2);
}

BOOST_AUTO_TEST_SUITE_END()
