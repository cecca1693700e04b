#include "reports/report.h"

#include <stdexcept>

#include "reports/files.h"
#include "reports/gallery.h"
#include "reports/html.h"
#include "reports/sections.h"
#include "reports/templates.h"

namespace trammel {

namespace {

using namespace reports;
namespace fs = std::filesystem;

Data page_data(const Results& results, const std::vector<Family>& families) {
  Data page = object();
  for (const char* name : {"summary", "family", "case", "figure", "checks", "matrix", "cost",
                           "references", "counts", "rows", "matrix_row", "cell"})
    page.set(std::string(name) + "_partial",
             kainjow::mustache::partial(
                 [file = std::string(name) + ".mustache"] { return template_text(file); }));
  page.set("style", template_text("style.css"));
  page.set("script", template_text("page.js"));
  page.set("environment", environment_section(results));
  page.set("summary", summary_section(results, families));
  Data family_list = list();
  for (const Family& family : families) family_list.push_back(family_section(family, results));
  page.set("families", family_list);
  page.set("cost", cost_section(results, families));
  page.set("references", references_section(results));
  return page;
}

std::string render(const Data& data) {
  kainjow::mustache::mustache page(template_text("page.mustache"));
  std::string html = page.render(data);
  if (!page.is_valid()) throw std::logic_error("page.mustache: " + page.error_message());
  return html;
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
  const Results results = read_results(results_json);
  std::vector<Family> families = plan_families(results);
  draw(all_figures(families), fs::absolute(out) / "figures");
  write_checks(families, out / "checks");
  const fs::path page = out / "index.html";
  write_file(page, render(page_data(results, families)));
  return page;
}

}  // namespace trammel
