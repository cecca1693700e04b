#include <boost/test/unit_test.hpp>
#include <cmath>

#include "reports/page/report.h"
#include "tests/support/reports/markup.h"
#include "tests/support/reports/sample.h"
#include "tests/support/reports/workspace.h"

BOOST_AUTO_TEST_SUITE(verification_tables)

using namespace trammel::testing;

namespace {

/// A section of the page, from its id to its end.
std::string section(const std::string& page, const std::string& id) {
  const std::size_t from = page.find("<section id=\"" + id + "\">");
  if (from == std::string::npos) return "";
  return page.substr(from, page.find("</section>", from) - from);
}

std::string section(const std::string& id) {
  return section(text_of(sample_report() / "index.html"), id);
}

std::string page_of(const nlohmann::ordered_json& results) {
  const Workspace workspace;
  return text_of(write_report_of(workspace.results(results), workspace.path() / "out"));
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_target_stands_as_printed_beside_the_better_value_and_both_ratios) {
  const std::string targets = section("targets");
  BOOST_TEST(says(targets, "1 published benchmark."));
  BOOST_TEST(says(targets, ">Pinned-pinned beam, six modes</a>"));
  BOOST_TEST(!says(targets, "Cantilever, six modes"));  // is no benchmark
  BOOST_TEST(says(targets, "<td class=\"number\">17.9</td>"));
  BOOST_TEST(says(targets, "<td class=\"number\">17.99337</td>"));  // 0.8166 of the root squared
  BOOST_TEST(says(targets, "<td class=\"number\">1.0052</td><td class=\"number\">1.000005</td>"));
  BOOST_TEST(says(targets, "does not agree (known)"));
}

BOOST_AUTO_TEST_CASE(orders_are_counted_against_theory_and_uncertainties_against_exact_values) {
  const std::string orders = section("orders");
  BOOST_TEST(says(orders, "covers the exact value on 125 of 126 levels"));
  std::size_t fitted = 0, near = 0;
  const auto results = sample_results();
  for (const auto& run : results["runs"]) {
    if (!run.contains("convergence")) continue;
    for (const auto& found : run["convergence"]) {
      if (found["fitted_order"].is_null()) continue;
      ++fitted;
      near += std::abs(found["fitted_order"].get<double>() - 4) <= 0.4 ? 1 : 0;
    }
  }
  BOOST_TEST(near > 0U);
  BOOST_TEST(says(orders, "The fitted order lies within a tenth of theory for " +
                              std::to_string(near) + " of " + std::to_string(fitted) + "."));
  BOOST_TEST(says(orders, "frequency <span class=\"muted\">6 entries</span>"));
  // The sample's GCI is 1.25 times the error, which always covers it.
  BOOST_TEST(says(orders, "<td class=\"number\">44 of 44</td><td class=\"number\">1.25</td>"));
}

BOOST_AUTO_TEST_CASE(a_law_of_two_orders_is_shown_by_how_well_it_meets_the_errors) {
  auto results = sample_results();
  for (auto& run : results["runs"]) {
    if (!run.contains("convergence")) continue;
    for (auto& found : run["convergence"]) {
      found["lower_order"] = 2;
      found["two_term"] = {
          {"coefficients", {1, 1}}, {"max_relative_misfit", 0.031}, {"used", {true}}};
    }
  }
  const std::string orders = section(page_of(results), "orders");
  BOOST_TEST(says(orders, "<td class=\"number\">4 and 2</td>"));
  BOOST_TEST(says(orders, "law within 3.1\u202f%"));
  BOOST_TEST(says(orders, "the two-term law fits the errors within 3.1\u202f%."));
}

BOOST_AUTO_TEST_CASE(differences_from_the_paper_are_shown_with_their_validation_uncertainty) {
  const std::string uncertainty = section("validation-uncertainty");
  BOOST_TEST(says(uncertainty,
                  "16 comparisons with the paper: 8 within the validation "
                  "uncertainty, 8 with a model error."));
  BOOST_TEST(says(uncertainty, "The dominant input is the link thickness, for 16 of 16."));
  BOOST_TEST(says(uncertainty, "class=\"cell model-error above\""));
  BOOST_TEST(says(uncertainty, "+16.5\u202f%<span class=\"delta muted\">± 5.1\u202f%</span>"));
  BOOST_TEST(says(uncertainty, "link thickness, up to 99\u202f%"));
  BOOST_TEST(says(uncertainty, "the difference &amp; its &quot;noise&quot; &lt;b&gt;"));
}

BOOST_AUTO_TEST_CASE(without_evidence_of_a_kind_its_section_is_left_out) {
  auto results = sample_results();
  results.erase("numerical_uncertainty");
  for (auto& run : results["runs"]) {
    run.erase("uncertainty");
    run["convergence"] = nlohmann::ordered_json::array();
  }
  for (auto& [id, info] : results["cases"].items()) info.erase("labels");
  const std::string page = page_of(results);
  for (const char* id : {"targets", "orders", "validation-uncertainty"}) {
    BOOST_TEST(section(page, id) == "", id);
    BOOST_TEST(!says(page, std::string("href=\"#") + id + "\""));
  }
  BOOST_TEST(markup_fault(page, true) == "");
}

BOOST_AUTO_TEST_SUITE_END()
