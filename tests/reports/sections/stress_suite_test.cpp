#include <boost/test/unit_test.hpp>

#include "reports/page/report.h"
#include "tests/support/reports/markup.h"
#include "tests/support/reports/sample.h"
#include "tests/support/reports/workspace.h"

BOOST_AUTO_TEST_SUITE(stress_suite)

using namespace trammel::testing;

namespace {

/// The sample's results with some of its cases in a stress suite, by item.
nlohmann::ordered_json with_stress_suite() {
  auto results = sample_results();
  int item = 0;
  for (auto& [id, info] : results["cases"].items()) {
    std::string check;
    for (const auto& run : results["runs"]) {
      if (run["case"] == id && !run["checks"].empty()) check = run["checks"][0]["name"];
    }
    if (check.empty() || item == 4) continue;
    item += item == 1 ? 2 : 1;  // leaves out the second
    info["stress_suite"] = {{"item", item}, {"indicators", {check}}};
  }
  return results;
}

std::string stress_suite_of(const nlohmann::ordered_json& results) {
  const Workspace workspace;
  const std::string page =
      text_of(write_report_of(workspace.results(results), workspace.path() / "out"));
  BOOST_TEST(markup_fault(page, true) == "");
  const std::size_t from = page.find("<section id=\"stress-suite\">");
  return from == std::string::npos ? "" : page.substr(from, page.find("</section>", from) - from);
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

}  // namespace

BOOST_AUTO_TEST_CASE(items_stand_in_order_with_the_worst_of_each_indicator) {
  const std::string text = stress_suite_of(with_stress_suite());
  BOOST_TEST(text.find("3 items, 3 cases, 3 indicators:") != std::string::npos);
  BOOST_TEST(text.find("Not included: items 2.") != std::string::npos);
  const std::size_t first = text.find(">1. <"), third = text.find(">3. <"),
                    fourth = text.find(">4. <");
  BOOST_TEST(first < third);
  BOOST_TEST(third < fourth);
  BOOST_TEST(fourth != std::string::npos);
  BOOST_TEST(count_of(text, "<tr><th scope=\"row\">") == 3U);
}

BOOST_AUTO_TEST_CASE(an_indicator_that_fails_is_said_to_fail) {
  auto results = with_stress_suite();
  for (auto& [id, info] : results["cases"].items()) {
    if (!info.contains("stress_suite")) continue;
    const std::string check = info["stress_suite"]["indicators"][0];
    for (auto& run : results["runs"]) {
      if (run["case"] != id) continue;
      for (auto& entry : run["checks"]) {
        if (entry["name"] == check) entry["verdict"] = "fail";
      }
    }
    break;
  }
  const std::string text = stress_suite_of(results);
  BOOST_TEST(text.find("1 fails") != std::string::npos);
  BOOST_TEST(count_of(text, "class=\"mark fails\"") == 1U);
}

BOOST_AUTO_TEST_CASE(an_indicator_that_no_run_has_does_not_hold) {
  auto results = with_stress_suite();
  for (auto& [id, info] : results["cases"].items()) {
    if (info.contains("stress_suite")) info["stress_suite"]["indicators"] = {"nowhere"};
  }
  const std::string text = stress_suite_of(results);
  BOOST_TEST(count_of(text, "no run has it") == 3U);
  BOOST_TEST(text.find("3 not run") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(without_cases_of_a_stress_suite_there_is_no_section) {
  BOOST_TEST(stress_suite_of(sample_results()).empty());
}

BOOST_AUTO_TEST_SUITE_END()
