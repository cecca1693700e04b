#include "reports/page/report.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cstdlib>
#include <fstream>
#include <set>
#include <system_error>

#include "reports/drawing/figure.h"
#include "tests/support/reports/markup.h"
#include "tests/support/reports/sample.h"
#include "tests/support/reports/workspace.h"

BOOST_AUTO_TEST_SUITE(report)

namespace fs = std::filesystem;
using namespace trammel::testing;

namespace {

/// All pages of the sample, one after another.
const std::string& page() {
  static const std::string text = text_of_pages(sample_report());
  return text;
}

/// Where links of one of the pages lead to nothing.
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

bool says(const std::string& text) {
  return page().find(text) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_figure_stands_in_the_page_and_beside_it_with_its_data) {
  const std::set<std::string> drawings = files_with(".svg");
  BOOST_TEST(drawings.size() > 45U);
  BOOST_TEST((drawings == files_with(".csv")));
  BOOST_TEST(occurrences(page(), "<figure id=\"fig-") == drawings.size());
  const std::size_t linked = occurrences(page(), "<iframe ");
  BOOST_TEST(linked > 0U);
  BOOST_TEST(occurrences(page(), "<svg ") + linked == drawings.size());
  for (const std::string& name : drawings) {
    BOOST_TEST(says("<figure id=\"fig-" + name + "\">"));
    BOOST_TEST(says("figures/" + name + ".csv\""));
    const std::string data = text_of(sample_report() / "figures" / (name + ".csv"));
    BOOST_TEST(occurrences(data, "\n") > 1U, name << " has no data");
  }
}

BOOST_AUTO_TEST_CASE(a_curve_of_631_points_has_631_rows_of_data_with_units_in_their_heads) {
  const std::string data = text_of(sample_report() / "figures" / "circle-load-fig-7.csv");
  BOOST_TEST(data.rfind("time_s,displacement_x_m:P [base],", 0) == 0U);
  BOOST_TEST(occurrences(data, "\n") == 632U);
}

BOOST_AUTO_TEST_CASE(powers_of_ten_are_written_as_such_but_not_in_code) {
  const Workspace workspace;
  auto results = sample_results();
  results["cases"]["cantilever"]["description"] = "below 1e-6 of all";
  results["cases"]["cantilever"]["title"] = "Beam of 2.5e3";
  write_report_of(workspace.results(results), workspace.path() / "out");
  const std::string text = text_of(workspace.path() / "out/cases/cantilever.html");
  BOOST_TEST(text.find("below 10⁻⁶ of all") != std::string::npos);
  BOOST_TEST(text.find("Beam of 2.5\u202f×\u202f10³") != std::string::npos);
  BOOST_TEST(text.find("Checks of Beam of 2.5e3") != std::string::npos);  // an attribute
}

BOOST_AUTO_TEST_CASE(page_and_drawings_are_balanced_and_escaped) {
  for (const auto& [path, text] : pages_of(sample_report()))
    BOOST_TEST(markup_fault(text, true) == "", path);
  BOOST_TEST(says("Free-free beam &lt;b&gt;&amp;&quot;quoted&quot;&lt;/b&gt;"));
  BOOST_TEST(!says("<b>&"));
  for (const std::string& name : files_with(".svg"))
    BOOST_TEST(markup_fault(text_of(sample_report() / "figures" / (name + ".svg")), false) == "",
               name);
}

BOOST_AUTO_TEST_CASE(pages_load_nothing_from_elsewhere_and_every_link_arrives) {
  const auto pages = pages_of(sample_report());
  BOOST_TEST(pages.size() > 10U);
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

BOOST_AUTO_TEST_CASE(a_case_its_checks_and_variants_have_addresses_made_of_their_names_alone) {
  const std::string text = text_of(sample_report() / "cases" / "cantilever.html");
  BOOST_TEST(text.find(" id=\"check-exact\"") != std::string::npos);
  const std::string other = text_of(sample_report() / "cases" / "manipulator-modes-centred.html");
  BOOST_TEST(other.find(" id=\"variant-base\"") != std::string::npos);
  BOOST_TEST(other.find("trammel run manipulator-modes-centred --variant ") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(references_stand_on_pages_of_the_families_and_keep_their_address) {
  const auto pages = pages_of(sample_report());
  const std::string& all = pages.at("references.html");
  const auto references = sample_results()["references"];
  std::size_t listed = 0;
  for (const auto& [id, reference] : references.items()) {
    const std::string anchor = "id=\"ref-" + id + "\"";
    listed += occurrences(all, anchor);
    std::size_t told = 0;
    for (const auto& [path, text] : pages)
      if (path.rfind("references/", 0) == 0) told += occurrences(text, anchor);
    BOOST_TEST(told == 1U, id);
  }
  BOOST_TEST(listed == references.size());
  const std::string& page = pages.at("cases/cantilever.html");
  BOOST_TEST(page.find("href=\"../references/") != std::string::npos);
  BOOST_TEST(page.find("references.html#") == std::string::npos);
}

BOOST_AUTO_TEST_CASE(one_file_holds_all_pages_needs_no_other_and_says_what_it_leaves_out) {
  const Workspace workspace;
  const fs::path file =
      write_report_of(workspace.results(sample_results()), workspace.path() / "out", true);
  const std::string text = text_of(file);
  BOOST_TEST(markup_fault(text, true) == "");
  BOOST_TEST(text.size() < 6'000'000U);
  BOOST_TEST(attribute_values(text, "src").empty());
  BOOST_TEST(text.find("<link") == std::string::npos);
  BOOST_TEST(text.find("without the figures of further variants") != std::string::npos);
  BOOST_TEST(text.find("class=\"derivation\"") == std::string::npos);
  std::set<std::string> ids;
  for (const std::string& id : attribute_values(text, "id"))
    BOOST_TEST(ids.insert(id).second, "twice: " << id);
  BOOST_TEST(dead_links({{"report.html", text}}, file.parent_path()) == "");
  BOOST_TEST(occurrences(text, "<svg ") > 20U);
  BOOST_TEST(ids.count("case-cantilever-check-exact") == 1U);
}

BOOST_AUTO_TEST_CASE(summary_counts_what_the_results_hold) {
  std::size_t pass = 0, known = 0, recorded = 0;
  const auto results = sample_results();
  for (const auto& run : results["runs"])
    for (const auto& check : run["checks"]) {
      if (check["verdict"] == "pass") ++(check["expectation"] == "agrees" ? pass : known);
      recorded += check["verdict"] == "recorded";
    }
  BOOST_TEST(says("<strong>" + std::to_string(pass) + "</strong> passes"));
  BOOST_TEST(says("<strong>" + std::to_string(known) + "</strong> does not agree (known)"));
  BOOST_TEST(says("<strong>" + std::to_string(recorded) + "</strong> not judged"));
  BOOST_TEST(says("1 check fails, 1 could not be evaluated, 1 run did not end as expected."));
  BOOST_TEST(says("<p class=\"reason\">platform_inertia_kg_m2[0] is not finite"));
  BOOST_TEST(says("/model/nodes/B: a member of length 0"));
}

BOOST_AUTO_TEST_CASE(claims_stand_with_their_verdict_and_what_it_rests_on) {
  BOOST_TEST(says("3 claims: 1 contradicted, 1 cannot be decided, 1 not measured."));
  BOOST_TEST(says("<strong>× 1 to × 1.5</strong>"));
  BOOST_TEST(says("(expected: confirmed)"));
  BOOST_TEST(occurrences(page(), "(expected:") == 1U);
  BOOST_TEST(says("No case of these results measures it."));
  BOOST_TEST(says("Nothing is published."));
  BOOST_TEST(says("What &lt;b&gt;follows&lt;/b&gt; &amp; why."));
  BOOST_TEST(says("<li><a href=\"#claims\">"));
}

BOOST_AUTO_TEST_CASE(a_table_of_variants_has_a_number_or_a_dash_in_each_cell) {
  BOOST_TEST(says("Largest displacement &amp; time"));
  BOOST_TEST(says("<td class=\"number\">20 µs</td><td class=\"number\">× 2</td>"));
  BOOST_TEST(says("<td class=\"number\">–</td>"));
}

BOOST_AUTO_TEST_CASE(how_a_run_ends_is_judged_like_any_other_check) {
  BOOST_TEST(says("The free mechanism has no stiffness"));
  BOOST_TEST(says("<td class=\"number\">singular</td>"));
}

BOOST_AUTO_TEST_CASE(a_figure_that_cannot_be_drawn_is_named_with_its_reason) {
  BOOST_TEST(
      says("A figure whose quantity is missing is not drawn: the variant base has no "
           "stress_Pa:A1-B1."));
}

BOOST_AUTO_TEST_CASE(one_of_many_variants_is_marked_as_nearest_to_each_reference) {
  BOOST_TEST(occurrences(page(), "class=\"best\"") == 2U);
  BOOST_TEST(says("Nearest as a whole: "));
  BOOST_TEST(says("No variant comes within 1\u202f% of modes "));
}

BOOST_AUTO_TEST_CASE(the_same_results_make_the_same_report_byte_for_byte) {
  const Workspace workspace;
  write_report_of(workspace.results(sample_results()), workspace.path() / "again");
  std::size_t compared = 0;
  for (const auto& entry : fs::recursive_directory_iterator(sample_report())) {
    if (!entry.is_regular_file()) continue;
    const fs::path name = fs::relative(entry.path(), sample_report());
    BOOST_TEST((text_of(entry.path()) == text_of(workspace.path() / "again" / name)),
               name << " differs");
    ++compared;
  }
  BOOST_TEST(compared > 90U);
}

BOOST_AUTO_TEST_CASE(results_without_any_failure_say_that_every_check_passes) {
  const Workspace workspace;
  auto results = sample_results();
  auto good = nlohmann::ordered_json::array();
  for (const auto& run : results["runs"])
    if (run["case"] == "cantilever") good.push_back(run);
  results["runs"] = good;
  write_report_of(workspace.results(results), workspace.path() / "out");
  const std::string text = text_of_pages(workspace.path() / "out");
  BOOST_TEST(text.find("Every check passes.") != std::string::npos);
  BOOST_TEST(text.find("<h3>Failures</h3>") == std::string::npos);
  BOOST_TEST(text.find("Table 1 against itself") == std::string::npos);
  BOOST_TEST(text.find("class=\"banner fails\"") == std::string::npos);
  // A run that has no checks and was stopped spoils the page.
  nlohmann::ordered_json late = good.front();
  late["status"] = "timed-out";
  late["checks"] = nlohmann::ordered_json::array();
  results["runs"].push_back(late);
  write_report_of(workspace.results(results), workspace.path() / "late");
  const std::string spoilt = text_of_pages(workspace.path() / "late");
  BOOST_TEST(spoilt.find("class=\"banner fails\"") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_recorded_disagreement_is_never_shown_as_a_success) {
  const Workspace workspace;
  auto results = sample_results();
  auto runs = nlohmann::ordered_json::array();
  for (const auto& run : results["runs"])
    if (run["case"] == "pinned-pinned") runs.push_back(run);
  results["runs"] = runs;
  write_report_of(workspace.results(results), workspace.path() / "out");
  const std::string text = text_of_pages(workspace.path() / "out");
  const auto shows = [&](const char* part) { return text.find(part) != std::string::npos; };
  BOOST_TEST(
      shows("Every check with an expected agreement passes; 1 comparison with 1 printed number of "
            "the publication does not agree"));
  BOOST_TEST(shows("class=\"banner known-discrepancy\""));
  BOOST_TEST(!shows("class=\"banner passes\""));
  BOOST_TEST(shows("<strong>6</strong> passes"));  // the six that agree, and no more
  BOOST_TEST(shows("<strong>1</strong> does not agree (known)"));
  BOOST_TEST(shows("class=\"mark known-discrepancy\" title=\"does not agree"));
}

BOOST_AUTO_TEST_CASE(a_printed_number_is_one_target_however_many_variants_meet_it) {
  const Workspace workspace;
  auto results = sample_results();
  auto runs = nlohmann::ordered_json::array();
  for (const auto& run : results["runs"])
    if (run["case"] == "pinned-pinned") runs.push_back(run);
  for (const char* variant : {"second", "third"}) {
    results["cases"]["pinned-pinned"]["variants"][variant] = {{"title", variant}};
    runs.push_back(runs[0]);
    runs.back()["variant"] = variant;
  }
  results["runs"] = runs;
  const std::string text =
      text_of(write_report_of(workspace.results(results), workspace.path() / "out"));
  BOOST_TEST(text.find("3 comparisons with 1 printed number of the publication do not agree") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_second_report_in_the_same_folder_leaves_nothing_of_the_first) {
  const Workspace workspace;
  auto results = sample_results();
  const fs::path out = workspace.path() / "out";
  write_report_of(workspace.results(results), out);
  std::ofstream(out / "figures" / "mine.svg") << "kept";
  results["runs"] = nlohmann::ordered_json::array({results["runs"].back()});
  write_report_of(workspace.results(results), out);
  const std::string text = text_of_pages(out);
  std::size_t drawings = 0;
  for (const auto& entry : fs::directory_iterator(out / "figures"))
    drawings += entry.path().extension() == ".svg";
  BOOST_TEST(drawings == occurrences(text, "<svg ") + occurrences(text, "<iframe ") + 1);
  for (const char* folder : {"cases", "families"})
    BOOST_TEST(std::distance(fs::directory_iterator(out / folder), {}) == 1, folder);
  BOOST_TEST(fs::exists(out / "figures" / "mine.svg"));
}

BOOST_AUTO_TEST_CASE(a_report_that_fails_or_is_replaced_leaves_whole_what_stands_there) {
  const Workspace workspace;
  const fs::path out = workspace.path() / "out", elsewhere = workspace.path() / "elsewhere";
  const auto all = sample_results();
  const std::string before = text_of(write_report_of(workspace.results(all), out));
  const auto count = [&] { return std::distance(fs::recursive_directory_iterator(out), {}); };
  const auto files = count();
  const std::string search = std::getenv("PATH");
  setenv("PATH", "/nonexistent", 1);
  BOOST_TEST(!trammel::reports::can_draw());
  BOOST_CHECK_THROW(write_report_of(workspace.results(all), out), std::runtime_error);
  setenv("PATH", search.c_str(), 1);
  BOOST_TEST((text_of(out / "index.html") == before));
  BOOST_TEST(count() == files);
  // A link is not followed out of the folder, but replaced.
  fs::remove_all(elsewhere);
  fs::rename(out / "checks", elsewhere);
  fs::create_directory_symlink(elsewhere, out / "checks");
  for (const auto& entry : fs::directory_iterator(elsewhere)) fs::remove(entry);
  write_report_of(workspace.results(all), out);
  BOOST_TEST(fs::is_empty(elsewhere));
  BOOST_TEST(count() == files);
  // A file is the user's own.
  fs::remove_all(out / "checks");
  std::ofstream(out / "checks") << "mine";
  BOOST_CHECK_THROW(write_report_of(workspace.results(all), out), std::system_error);
  BOOST_TEST(text_of(out / "checks") == "mine");
}

BOOST_AUTO_TEST_CASE(where_runs_were_stored_the_drawings_of_what_did_not_change_are_taken) {
  const Workspace workspace;
  const fs::path out = workspace.path() / "out", drawing = out / "figures/circle-load-fig-7.svg";
  auto results = sample_results();
  results["environment"]["stored_runs"] = 1;
  write_report_of(workspace.results(results), out);
  const std::string drawn = text_of(drawing), search = std::getenv("PATH");
  setenv("PATH", "/nonexistent", 1);  // without gnuplot
  write_report_of(workspace.results(results), out);
  BOOST_TEST(text_of(drawing) == drawn);
  results["environment"]["commit"] = "another";
  BOOST_CHECK_THROW(write_report_of(workspace.results(results), out), std::runtime_error);
  setenv("PATH", search.c_str(), 1);
  std::ofstream(drawing, std::ios::app) << "torn";
  results["environment"]["commit"] = "abc1234";
  write_report_of(workspace.results(results), out);
  BOOST_TEST(text_of(drawing).find("torn") == std::string::npos);
}

BOOST_AUTO_TEST_CASE(no_folder_of_a_report_becomes_a_command_of_gnuplot) {
  const Workspace workspace;
  const fs::path here = fs::current_path();
  fs::current_path(workspace.path());
  std::string name = "a'\"`touch intruder`@x %d $(touch intruder)\n!touch intruder\n|";
  for (char c = 1; c < 0x20; ++c) name += c;
  BOOST_CHECK_NO_THROW(write_report_of(workspace.results(sample_results()), name + "\x7fé"));
  fs::current_path(here);
  BOOST_TEST(fs::exists(workspace.path() / (name + "\x7fé") / "index.html"));
  BOOST_TEST(!fs::exists(workspace.path() / "intruder"));
}

BOOST_AUTO_TEST_CASE(names_that_look_alike_have_files_of_their_own_and_long_ones_are_cut) {
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

BOOST_AUTO_TEST_CASE(no_text_of_a_case_becomes_a_command_of_gnuplot) {
  const Workspace workspace;
  auto results = sample_results();
  const std::string file = (workspace.path() / "intruder").string();
  std::string title = "'; system('touch " + file + "'); `touch " + file + "`\n!touch " + file +
                      "\nset output @x \"";
  for (char c = 1; c < 0x20; ++c) title += c;
  title += '\x7f';
  for (auto& [id, info] : results["cases"].items()) {
    info["title"] = title;
    for (auto& [variant, value] : info["variants"].items()) value["title"] = title + variant;
  }
  const std::string text =
      text_of(write_report_of(workspace.results(results), workspace.path() / "out"));
  BOOST_TEST(!fs::exists(file));
  BOOST_TEST((text.find('\x1b') == std::string::npos));
}

BOOST_AUTO_TEST_CASE(results_without_any_run_still_make_a_page) {
  const Workspace workspace;
  auto results = sample_results();
  results["runs"] = nlohmann::ordered_json::array();
  results.erase("cost");
  const std::string text =
      text_of(write_report_of(workspace.results(results), workspace.path() / "out"));
  BOOST_TEST(text.find("No checks were made.") != std::string::npos);
  BOOST_TEST(markup_fault(text, true) == "");
}

BOOST_AUTO_TEST_SUITE_END()
