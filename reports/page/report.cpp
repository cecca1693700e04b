#include "reports/page/report.h"

#include <algorithm>
#include <stdexcept>

#include "harness/results/unfinished_folder.h"
#include "reports/figures/gallery.h"
#include "reports/page/render.h"
#include "reports/sections/claims.h"
#include "reports/sections/cost.h"
#include "reports/sections/coverage.h"
#include "reports/sections/environment.h"
#include "reports/sections/family.h"
#include "reports/sections/orders.h"
#include "reports/sections/references.h"
#include "reports/sections/stress_suite.h"
#include "reports/sections/summary.h"
#include "reports/sections/tables.h"
#include "reports/sections/targets.h"
#include "reports/sections/validation_uncertainty.h"
#include "reports/text/files.h"
#include "reports/text/html.h"
#include "reports/text/number.h"
#include "reports/text/templates.h"

namespace trammel::reports {

namespace {

using namespace reports;
namespace fs = std::filesystem;

constexpr const char* kGenerator = R"(<meta name="generator" content="trammel">)";

Data page_data(const Results& results, const std::vector<Family>& families,
               const std::vector<CostPanel>& panels) {
  Data page = object();
  for (const char* name : {"summary",    "claims",
                           "family",     "case",
                           "variants",   "figure",
                           "checks",     "matrix",
                           "cost",       "stress_suite",
                           "targets",    "orders",
                           "coverage",   "validation_uncertainty",
                           "references", "counts",
                           "rows",       "head",
                           "matrix_row", "cell"})
    page.set(std::string(name) + "_partial",
             kainjow::mustache::partial(
                 [file = std::string(name) + ".mustache"] { return template_text(file); }));
  page.set("style", template_text("style.css"));
  page.set("script", template_text("page.js"));
  page.set("environment", environment_section(results));
  const Data claims = claims_section(results);
  const Data cost = cost_section(results, families, panels);
  const Data stress_suite = stress_suite_section(families);
  const Data targets = targets_section(results, families);
  const Data orders = orders_section(results, families);
  const Data uncertainty = validation_uncertainty_section(results, families);
  const Data coverage = coverage_section(results);
  std::vector<SectionSummary> summaries;
  const auto add_summary = [&](const std::string& title, const std::string& anchor,
                               const Data& section, const char* key) {
    const Data* words = section.get(key);
    const Data* rows = section.get("has_rows");
    if (words != nullptr && words->is_string() && (rows == nullptr || rows->is_true()))
      summaries.push_back({title, anchor, words->string_value()});
  };
  add_summary("The paper's claims", "claims", claims, "overview");
  add_summary("Accuracy and computing time", "cost", cost, "words");
  add_summary("Stress suite", "stress-suite", stress_suite, "words");
  add_summary("Published benchmark values", "targets", targets, "words");
  add_summary("Orders of convergence and numerical uncertainty", "orders", orders, "words");
  add_summary("Validation uncertainty", "validation-uncertainty", uncertainty, "words");
  add_summary("What is verified, and by what", "coverage", coverage, "words");
  page.set("summary", summary_section(results, families, summaries));
  page.set("claims", claims);
  set_flag(page, "has_claims", results.claims.has_value());
  page.set("cost", cost);
  page.set("stress_suite", stress_suite);
  page.set("targets", targets);
  page.set("orders", orders);
  page.set("validation_uncertainty", uncertainty);
  page.set("coverage", coverage);
  Data family_list = list();
  for (const Family& family : families) family_list.push_back(family_section(family, results));
  page.set("families", family_list);
  set_flag(page, "has_runs", !results.runs.empty() || panels.empty());
  set_flag(page, "has_references", !results.references.empty());
  page.set("references", references_section(results));
  return page;
}

/// What an earlier report in the same folder has written and links to.
std::vector<fs::path> earlier_files(const fs::path& out) {
  std::vector<fs::path> files;
  const fs::path page = out / "index.html";
  if (!fs::is_regular_file(page)) return files;
  const std::string html = read_file(page);
  if (html.find(kGenerator) == std::string::npos) return files;
  for (const std::string folder : {"figures/", "checks/"}) {
    const std::string link = "href=\"" + folder;
    for (std::size_t at = html.find(link); at != std::string::npos; at = html.find(link, at + 1)) {
      const std::size_t from = at + link.size();
      const std::string name = html.substr(from, html.find('"', from) - from);
      if (name.find('/') == std::string::npos) files.push_back(fs::path(folder) / name);
    }
  }
  return files;
}

void write_checks(const std::vector<Family>& families, const fs::path& folder) {
  fs::create_directories(folder);
  for (const Family& family : families)
    for (const CaseInfo* info : family.cases)
      write_file(folder / (slug(info->id) + ".csv"),
                 to_csv(checks_table(*info, family.runs_of(info->id))));
}

}  // namespace

fs::path write_report(const fs::path& results_json, const fs::path& out) {
  const fs::path part = out / kUnfinishedFolder;
  if (results_json.parent_path() != part) fs::remove_all(part);
  try {
    const Results results = read_results(results_json);
    std::vector<Family> families = plan_families(results);
    std::vector<CostPanel> panels = plan_cost(results);
    std::vector<Figure*> figures;
    for (CostPanel& panel : panels) figures.push_back(&panel.figure);
    for (Figure* figure : all_figures(families)) figures.push_back(figure);
    number_figures(figures);
    draw(figures, part / "figures");
    write_checks(families, part / "checks");
    write_file(part / "index.html", render("page.mustache", page_data(results, families, panels)));
    replace_files(part, out, "index.html", earlier_files(out));
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(part, ignored);
    throw;
  }
  return out / "index.html";
}

}  // namespace trammel::reports
