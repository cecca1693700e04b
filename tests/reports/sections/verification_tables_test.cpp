#include <boost/test/unit_test.hpp>
#include <cmath>

#include "reports/page/report.h"
#include "tests/support/reports/markup.h"
#include "tests/support/reports/workspace.h"

BOOST_AUTO_TEST_SUITE(verification_tables)

using namespace trammel::testing;
using namespace trammel::results;

namespace {

/// Returns the section of a page with this id.
std::string section(const std::string& page, const std::string& id) {
  const std::size_t from = page.find("<section id=\"" + id + "\">");
  if (from == std::string::npos) return "";
  return page.substr(from, page.find("</section>", from) - from);
}

Comparison compared(int index, double simulation, double u_val, const std::string& verdict) {
  Comparison entry;
  entry.check = "ansys";
  entry.quantity = "frequency_Hz";
  entry.unit = "Hz";
  entry.reference = "table-2-ansys";
  entry.index = index;
  entry.simulation = simulation;
  entry.expected = 10;
  entry.difference = simulation - 10;
  entry.u_val = u_val;
  entry.dominant_input = "link-thickness";
  entry.dominant_share = 0.987;
  entry.verdict = verdict;
  entry.conclusion = "the difference & its \"noise\" <b>";
  return entry;
}

}  // namespace

BOOST_AUTO_TEST_CASE(orders_and_uncertainties_are_counted) {
  Results results = sample_results_of_case("beam-pinned-pinned");
  results.uncertainty_coverage =
      UncertaintyCoverage{126, 125, 100, 125.0 / 126, 0.95, 1.25, 3, true};
  std::size_t fitted = 0, near = 0;
  for (const Run& run : results.runs)
    for (const Convergence& found : run.convergence) {
      if (!found.fitted_order) continue;
      ++fitted;
      near += std::abs(*found.fitted_order / *found.theory_order - 1) <= 0.1 ? 1 : 0;
    }
  BOOST_TEST(near > 0U);
  const std::string orders = section(all_pages_of(results), "orders");
  BOOST_TEST(contains(orders, "covers the exact value on 125 of 126 levels"));
  BOOST_TEST(contains(orders, std::to_string(near) + " of " + std::to_string(fitted) +
                                  " orders lie within 10\u202f% of theory"));
  BOOST_TEST(contains(orders, "frequency, 6 entries"));
  for (Run& run : results.runs)
    for (Convergence& found : run.convergence) {
      found.lower_order = 2;
      found.two_term = TwoTermLaw{{1, 1}, 0.031, {true}};
    }
  const std::string mixed = section(all_pages_of(results), "orders");
  BOOST_TEST(contains(mixed, "<td class=\"number\">4 and 2</td>"));
  BOOST_TEST(contains(mixed, "two-term law within 3.1\u202f%"));
  BOOST_TEST(contains(mixed, "the sum of both terms fits it within 3.1\u202f%."));
}

BOOST_AUTO_TEST_CASE(paper_differences_are_shown_with_uncertainty) {
  Results results = sample_results();
  for (Run& run : results.runs) {
    if (run.case_id != "manipulator-modes") continue;
    run.uncertainty = Uncertainty{};
    run.uncertainty->comparisons = {compared(0, 11.65, 0.51, "model-error"),
                                    compared(3, 12, 9, "within-uncertainty")};
  }
  const std::string words = section(all_pages_of(results), "validation-uncertainty");
  for (const char* part :
       {"2 comparisons with the paper: 1 within the validation uncertainty, 1 with a model error."})
    BOOST_TEST(contains(words, part), part << " in " << words);
  const Workspace workspace;
  (void)trammel::reports::write_report(results, workspace.path() / "out");
  const std::string uncertainty =
      read_text_file(workspace.path() / "out/families/manipulator-modes.html");
  for (const char* part : {"class=\"cell below model-error\"", "± 7.5\u202f%",
                           "the difference &amp; its &quot;noise&quot; &lt;b&gt;"})
    BOOST_TEST(contains(uncertainty, part), part << " in " << uncertainty);
  const std::string summary = read_text_file(workspace.path() / "out/summary.html");
  BOOST_TEST(contains(summary, "<td class=\"number\">± 47\u202f%</td>"), summary);
}

BOOST_AUTO_TEST_CASE(sections_without_evidence_are_left_out) {
  Results results = sample_results();
  for (Run& run : results.runs) run.convergence.clear();
  for (CaseInfo& info : results.cases) info.labels.clear();
  const std::string page = all_pages_of(results);
  for (const char* id : {"orders", "validation-uncertainty"}) {
    BOOST_TEST(section(page, id) == "", id);
    BOOST_TEST(!contains(page, std::string("href=\"#") + id + "\""));
  }
}

BOOST_AUTO_TEST_SUITE_END()
