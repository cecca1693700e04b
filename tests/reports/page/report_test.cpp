#include "reports/page/report.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cstdlib>
#include <fstream>
#include <set>
#include <system_error>

#include "reports/data/check_text.h"
#include "reports/drawing/figure.h"
#include "tests/support/reports/markup.h"
#include "tests/support/reports/workspace.h"

BOOST_AUTO_TEST_SUITE(report)

namespace fs = std::filesystem;
using namespace trammel::testing;
using namespace trammel::results;
using trammel::reports::write_report;

namespace {

/// Returns all pages of the sample report as one text.
const std::string& page() {
  static const std::string text = text_of_pages(sample_report());
  return text;
}

bool shows(const std::string& text) {
  return page().find(text) != std::string::npos;
}

/// Returns the links whose targets do not exist.
std::string dead_links(const std::map<std::string, std::string>& pages, const fs::path& folder) {
  std::string dead;
  for (const auto& [path, text] : pages) {
    std::vector<std::string> targets = attribute_values(text, "href");
    for (const std::string& source : attribute_values(text, "src")) targets.push_back(source);
    for (const std::string& target : targets) {
      if (target.rfind("https://doi.org/", 0) == 0) continue;
      const std::string name = target.substr(0, target.find('#'));
      const fs::path file =
          name.empty() ? fs::path(path) : (fs::path(path).parent_path() / name).lexically_normal();
      bool arrives = fs::is_regular_file(folder / file);
      if (const std::size_t hash = target.find('#'); arrives && hash != std::string::npos) {
        const std::vector<std::string> ids = attribute_values(pages.at(file.string()), "id");
        arrives = std::count(ids.begin(), ids.end(), target.substr(hash + 1)) == 1;
      }
      if (!arrives) dead += path + ": " + target + "\n";
    }
  }
  return dead;
}

std::set<std::string> files_with(const std::string& extension) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(sample_report() / "figures"))
    if (entry.path().extension() == extension) names.insert(entry.path().stem().string());
  return names;
}

/// Hides the program gnuplot while an object of this class exists.
class WithoutGnuplot {
 public:
  WithoutGnuplot() : search_(std::getenv("PATH")) { setenv("PATH", "/nonexistent", 1); }
  ~WithoutGnuplot() { setenv("PATH", search_.c_str(), 1); }
  WithoutGnuplot(const WithoutGnuplot&) = delete;
  WithoutGnuplot& operator=(const WithoutGnuplot&) = delete;

 private:
  std::string search_;
};

/// Returns a title with commands that would make gnuplot create a file, and with all control
/// characters.
std::string title_with_gnuplot_commands(const std::string& file) {
  std::string title = "'; system('touch " + file + "'); `touch " + file + "`\n!touch " + file +
                      "\n$(touch " + file + ")|set output @x %d \"";
  for (char c = 1; c < 0x20; ++c) title += c;
  return title + '\x7f';
}

}  // namespace

BOOST_AUTO_TEST_CASE(each_figure_is_in_the_page_and_has_its_data) {
  const std::set<std::string> drawings = files_with(".svg");
  BOOST_TEST(drawings.size() > 5U);
  BOOST_TEST((drawings == files_with(".csv")));
  BOOST_TEST(occurrences(page(), "<svg ") + occurrences(page(), "<iframe ") >= drawings.size());
  for (const std::string& name : drawings) {
    BOOST_TEST(shows("<figure id=\"fig-" + name + "\">"));
    BOOST_TEST(shows("figures/" + name + ".csv\""));
    const std::string data = read_text_file(sample_report() / "figures" / (name + ".csv"));
    BOOST_TEST(occurrences(data, "\n") > 1U, name << " has no data");
  }
}

BOOST_AUTO_TEST_CASE(curve_has_a_row_for_each_point_or_a_reason) {
  Results results = sample_results_of_case("vpcs-sdll02");
  CaseInfo& info = results.cases[1];
  info.figures = {{"f", "Force", "time_s", "", {"force_N:P"}, {"base"}},
                  {"g", "Stress", "time_s", "", {"stress_Pa:A-B"}, {"base"}}};
  for (int k = 0; k < 631; ++k) {
    results.runs[0].quantities["time_s"].values.push_back(0.01 * k);
    results.runs[0].quantities["force_N:P"].values.push_back(k % 10);
  }
  const Workspace workspace;
  write_report(results, workspace.path());
  const std::string data = read_text_file(workspace.path() / "figures/vpcs-sdll02-f.csv");
  BOOST_TEST(data.rfind("time_s,force_N:P [base]", 0) == 0U);
  BOOST_TEST(occurrences(data, "\n") == 632U);
  BOOST_TEST(read_text_file(workspace.path() / "cases/vpcs-sdll02.html")
                 .find("Stress is not drawn: the variant base has no stress_Pa:A-B.") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(powers_of_ten_are_typeset_in_text_only) {
  const Workspace workspace;
  Results results = sample_results_of_case("vpcs-sdll02");
  results.cases[1].description = "below 1e-6 of all";
  results.cases[1].title = "Frame of 2.5e3";
  write_report(results, workspace.path());
  const std::string text = read_text_file(workspace.path() / "cases/vpcs-sdll02.html");
  BOOST_TEST(text.find("below 10⁻⁶ of all") != std::string::npos);
  BOOST_TEST(text.find("Frame of 2.5\u202f×\u202f10³") != std::string::npos);
  BOOST_TEST(text.find("Checks of Frame of 2.5e3") != std::string::npos);  // attributes keep 2.5e3
}

BOOST_AUTO_TEST_CASE(pages_and_drawings_are_balanced_and_escaped) {
  for (const auto& [path, text] : pages_of(sample_report()))
    BOOST_TEST(markup_fault(text, true) == "", path);
  BOOST_TEST(shows("Beam &lt;b&gt;&amp;&quot;quoted&quot;"));
  BOOST_TEST(!shows("<b>&"));
  for (const std::string& name : files_with(".svg"))
    BOOST_TEST(
        markup_fault(read_text_file(sample_report() / "figures" / (name + ".svg")), false) == "",
        name);
}

BOOST_AUTO_TEST_CASE(pages_load_no_other_files_and_all_links_are_valid) {
  const auto pages = pages_of(sample_report());
  BOOST_TEST(pages.size() > 8U);
  for (const auto& [path, text] : pages) {
    BOOST_TEST(text.find("@import") == std::string::npos);
    BOOST_TEST(text.find("url(") == std::string::npos);
    std::set<std::string> ids;
    for (const std::string& id : attribute_values(text, "id"))
      BOOST_TEST(ids.insert(id).second, path << " has twice: " << id);
  }
  BOOST_TEST(dead_links(pages, sample_report()) == "");
  BOOST_TEST(dead_links({{"index.html", "<a href=\"cases/none.html\">"}}, sample_report()) != "");
}

BOOST_AUTO_TEST_CASE(anchors_and_links_contain_names_instead_of_numbers) {
  const auto pages = pages_of(sample_report());
  const std::string& beam = pages.at("cases/beam-pinned-pinned.html");
  BOOST_TEST(beam.find(" id=\"check-exact\"") != std::string::npos);
  BOOST_TEST(beam.find("href=\"../references.html#") != std::string::npos);
  const std::string& frame = pages.at("cases/vpcs-sdll02.html");
  BOOST_TEST(frame.find(" id=\"variant-base\"") != std::string::npos);
  BOOST_TEST(frame.find("trammel run vpcs-sdll02 --variant ") != std::string::npos);
  for (const Reference& reference : sample_results().references) {
    const std::string anchor = "id=\"ref-" + reference.id + "\"";
    BOOST_TEST(occurrences(pages.at("references.html"), anchor) == 1U, reference.id);
  }
}

BOOST_AUTO_TEST_CASE(summary_counts_the_checks_by_verdict) {
  std::size_t pass = 0, known = 0;
  for (const Run& run : sample_results().runs)
    for (const trammel::reports::CheckGroup& group : trammel::reports::group_checks(run))
      if (group.worst().verdict == Verdict::pass)
        ++(group.worst().is_known_discrepancy() ? known : pass);
  BOOST_TEST(shows("<strong>" + std::to_string(pass) + "</strong> passes"));
  BOOST_TEST(shows("<strong>" + std::to_string(known) + "</strong> known discrepancy"));
  BOOST_TEST(shows("<strong>1</strong> not judged"));
  BOOST_TEST(
      shows("1 check fails, 1 check could not be evaluated, 1 run did not end as expected."));
  BOOST_TEST(shows("<p class=\"reason\">the value is not finite"));
  BOOST_TEST(shows("/model/nodes/B: a member of length 0"));
  // The case expects a run that ends with the status singular. The page shows the check of this
  // status like any other check.
  BOOST_TEST(shows("A free frame has no stiffness"));
  BOOST_TEST(shows("<td class=\"number\">singular</td>"));
}

BOOST_AUTO_TEST_CASE(claims_are_shown_with_verdict_and_evidence) {
  Results results = sample_results_of_case("vpcs-sdll02");
  const auto claim = [](const char* id, const char* words, const char* verdict,
                        const char* expected, const char* undecidable,
                        const std::vector<ClaimInterpretation>& readings) {
    return Claim{id,          words,   words, "Abstract", verdict, expected, "This <b>follows</b>.",
                 undecidable, readings};
  };
  const ClaimEntry low{"vpcs-sdll02", "base", "exact", 1},
      high{"vpcs-sdll02", "base", "exact", 1.5};
  const ClaimInterpretation ratio{"flexible over rigid", "ratio", "1", "contradicts", {low, high}},
      first{"with training data", "ratio", "1", "confirms", {low}},
      relative{"sensitivity", "relative", "1", "not measured", {}};
  const char* undecided = "cannot be decided";
  results.claims = Claims{
      "Three claims",
      false,
      {claim("3", "Displacements are small.", "contradicted", "confirmed", "", {first, ratio}),
       claim("7", "The sensitivity rises.", "not measured", "not measured", "", {relative}),
       claim("10", "It matches.", undecided, undecided, "Nothing is published.", {})}};
  const std::string text = all_pages_of(results);
  for (const char* part : {"3 claims: 1 contradicted, 1 cannot be decided, 1 not measured.",
                           "<td class=\"number\">× 1 to × 1.5</td>", "(expected: confirmed)",
                           "No case of these results measures this claim.", "Nothing is published.",
                           "This &lt;b&gt;follows&lt;/b&gt;.", "<li><a href=\"paper.html\">"})
    BOOST_TEST(text.find(part) != std::string::npos, part);
  BOOST_TEST(occurrences(text, "(expected:") == 1U);
}

BOOST_AUTO_TEST_CASE(equal_results_make_equal_reports) {
  const Workspace workspace;
  write_report(sample_results(), workspace.path() / "again");
  std::size_t compared = 0;
  for (const auto& entry : fs::recursive_directory_iterator(sample_report())) {
    if (!entry.is_regular_file()) continue;
    const fs::path name = fs::relative(entry.path(), sample_report());
    BOOST_TEST((read_text_file(entry.path()) == read_text_file(workspace.path() / "again" / name)),
               name << " differs");
    ++compared;
  }
  BOOST_TEST(compared > 20U);
}

BOOST_AUTO_TEST_CASE(report_states_success_only_without_any_failure) {
  Results results = sample_results_of_case("beam-pinned-pinned");
  const Workspace workspace;
  write_report(results, workspace.path() / "good");
  const std::string good = text_of_pages(workspace.path() / "good");
  BOOST_TEST(good.find("Every check passes.") != std::string::npos);
  BOOST_TEST(good.find("<h3>Failures</h3>") == std::string::npos);
  BOOST_TEST(good.find("Table 1 against itself") == std::string::npos);
  BOOST_TEST(good.find("class=\"banner fails\"") == std::string::npos);
  results.runs.push_back(results.runs[0]);
  results.runs[1].variant = "lumped";
  results.runs[1].status = Status::timed_out;
  results.runs[1].checks.clear();
  BOOST_TEST(page_of(results).find("class=\"banner fails\"") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(known_discrepancy_is_never_shown_as_a_success) {
  Results results = sample_results_of_case("beam-pinned-pinned");
  Check known = results.runs[0].checks[0];
  known.name = "printed";
  known.role = "validation";
  known.reference = "table-1-link-mass";  // a number printed in the paper
  known.expectation = Expectation::known_discrepancy;
  known.tolerance = Tolerance{0.004, 0.006};
  results.runs[0].checks = {results.runs[0].checks[0], known};
  const std::string text = all_pages_of(results);
  for (const char* part : {"Every check passes, or differs from the publication as recorded.",
                           "class=\"banner known-discrepancy\"", "<strong>1</strong> passes",
                           "<strong>1</strong> known discrepancy", "1 printed number in 1 entry",
                           "class=\"mark known-discrepancy\" title=\"known discrepancy"})
    BOOST_TEST(text.find(part) != std::string::npos, part);
  BOOST_TEST(text.find("class=\"banner passes\"") == std::string::npos);
  // If checks of several variants compare with the same printed number, the page counts this number
  // once.
  for (const char* variant : {"second", "third"}) {
    results.cases[0].variants.push_back({variant, variant});
    results.runs.push_back(results.runs[0]);
    results.runs.back().variant = variant;
  }
  BOOST_TEST(all_pages_of(results).find("1 printed number in 3 entries") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(audit_counts_other_discrepancies_by_reason) {
  Results results = sample_results_of_case("beam-pinned-pinned");
  Check known = results.runs[0].checks[0];
  known.expectation = Expectation::known_discrepancy;
  for (const int i : {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 12}) {
    const bool repeated = results.runs[0].checks.back().name == std::to_string(i);
    known.name = std::to_string(i);
    known.difference = 2 - 0.1 * i - (repeated ? 0.1 : 0);
    known.why = repeated ? "second reason" : "first reason";
    results.runs[0].checks.push_back(known);
  }
  const std::string text = all_pages_of(results);  // the page lists the ten largest discrepancies
  for (const char* part : {"<strong>3</strong> first reason", "<strong>1</strong> second reason"})
    BOOST_TEST(text.find(part) != std::string::npos, part);
}

BOOST_AUTO_TEST_CASE(second_report_leaves_nothing_of_the_first) {
  const Workspace workspace;
  const fs::path out = workspace.path() / "out";
  write_report(sample_results(), out);
  std::ofstream(out / "figures" / "mine.svg") << "kept";
  write_report(sample_results_of_case("beam-pinned-pinned"), out);
  const std::string text = text_of_pages(out);
  std::size_t drawings = 0;
  for (const auto& entry : fs::directory_iterator(out / "figures"))
    drawings += entry.path().extension() == ".svg";
  drawings += occurrences(text, "class=\"thumbnail\" inert><svg ");
  // The user's drawing is on no page, but the figure of fitted orders is on two pages.
  BOOST_TEST(drawings == occurrences(text, "<svg ") + occurrences(text, "<iframe "));
  for (const char* folder : {"cases", "families"})
    BOOST_TEST(std::distance(fs::directory_iterator(out / folder), {}) == 1, folder);
  BOOST_TEST(fs::exists(out / "figures" / "mine.svg"));
}

BOOST_AUTO_TEST_CASE(failed_report_leaves_the_former_one) {
  const Workspace workspace;
  const fs::path out = workspace.path() / "out", elsewhere = workspace.path() / "elsewhere";
  const Results all = sample_results();
  const std::string before = read_text_file(write_report(all, out));
  const auto count = [&] { return std::distance(fs::recursive_directory_iterator(out), {}); };
  const auto files = count();
  {
    const WithoutGnuplot without;
    BOOST_TEST(!trammel::reports::has_gnuplot());
    BOOST_CHECK_THROW(write_report(all, out), std::runtime_error);
  }
  BOOST_TEST((read_text_file(out / "index.html") == before));
  BOOST_TEST(count() == files);
  // A symbolic link to a folder outside the report is replaced and not followed.
  fs::rename(out / "checks", elsewhere);
  fs::create_directory_symlink(elsewhere, out / "checks");
  for (const auto& entry : fs::directory_iterator(elsewhere)) fs::remove(entry);
  write_report(all, out);
  BOOST_TEST(fs::is_empty(elsewhere));
  BOOST_TEST(count() == files);
  // A file of the user with the name of a folder of the report is not replaced.
  fs::remove_all(out / "checks");
  std::ofstream(out / "checks") << "mine";
  BOOST_CHECK_THROW(write_report(all, out), std::system_error);
  BOOST_TEST(read_text_file(out / "checks") == "mine");
}

BOOST_AUTO_TEST_CASE(unchanged_figures_are_not_drawn_again) {
  const Workspace workspace;
  Results results = sample_results_of_case("beam-pinned-pinned");
  results.environment.stored_runs = 1;
  write_report(results, workspace.path());
  const fs::path drawing = fs::directory_iterator(workspace.path() / "figures")->path().string();
  const fs::path svg = fs::path(drawing).replace_extension(".svg");
  const std::string drawn = read_text_file(svg), commit = results.environment.commit;
  const fs::path page = workspace.path() / "index.html";
  const std::string before = read_text_file(page);
  results.environment.date = "2026-11-30T00:00:00Z";
  {
    const WithoutGnuplot without;
    write_report(results, workspace.path());
    BOOST_TEST(read_text_file(page) == before);  // all files are unchanged
    fs::remove(workspace.path() / "style.css");
    write_report(results, workspace.path());
    BOOST_TEST(read_text_file(page) != before);  // a file was missing
    BOOST_TEST(read_text_file(svg) == drawn);
    results.environment.commit = "another";
    BOOST_CHECK_THROW(write_report(results, workspace.path()), std::runtime_error);
  }
  std::ofstream(svg, std::ios::app) << "torn";
  results.environment.commit = commit;
  write_report(results, workspace.path());
  BOOST_TEST(read_text_file(svg).find("torn") == std::string::npos);
}

BOOST_AUTO_TEST_CASE(similar_names_have_separate_files) {
  std::set<std::string> slugs;
  for (const std::string& name :
       {std::string("a-b"), std::string("a.b"), std::string("A-B"), std::string("a_b"),
        std::string("a--b"), std::string(300, 'a'), std::string(301, 'a'), std::string()}) {
    const std::string slug = trammel::reports::slug(name);
    BOOST_TEST(slugs.insert(slug).second, name);
    BOOST_TEST(slug.size() <= 100U);
  }
  BOOST_TEST(trammel::reports::slug("a-b") == "a-b");
}

BOOST_AUTO_TEST_CASE(titles_and_folders_cannot_become_gnuplot_commands) {
  const Workspace workspace;
  Results results = sample_results_of_case("beam-pinned-pinned");
  const std::string file = (workspace.path() / "intruder").string();
  results.cases[0].title = title_with_gnuplot_commands(file);
  results.cases[0].variants[0].title = title_with_gnuplot_commands(file);
  BOOST_TEST((page_of(results).find('\x1b') == std::string::npos));
  BOOST_TEST(!fs::exists(file));
  const fs::path here = fs::current_path();
  fs::current_path(workspace.path());
  const std::string folder = title_with_gnuplot_commands("intruder") + "é";
  BOOST_CHECK_NO_THROW(write_report(results, folder));
  fs::current_path(here);
  BOOST_TEST(fs::exists(workspace.path() / folder / "index.html"));
  BOOST_TEST(!fs::exists(file));
}

BOOST_AUTO_TEST_CASE(results_without_any_run_make_a_page) {
  const std::string text = page_of(sample_results_of_case("none"));
  BOOST_TEST(text.find("No checks were made; there is nothing") != std::string::npos);
  BOOST_TEST(markup_fault(text, true) == "");
}

BOOST_AUTO_TEST_SUITE_END()
