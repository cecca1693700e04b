#include "reports/page/report.h"

#include <optional>
#include <set>

#include "harness/results/unfinished_folder.h"
#include "reports/figures/figures.h"
#include "reports/figures/gallery.h"
#include "reports/page/render.h"
#include "reports/page/site.h"
#include "reports/sections/sections.h"
#include "reports/text/files.h"

namespace trammel::reports {

namespace {

namespace fs = std::filesystem;

constexpr const char* kGenerator = R"(<meta name="generator" content="trammel">)";

/// What an earlier report in the same folder has written: its pages, and what they link to.
std::vector<fs::path> earlier_files(const fs::path& out) {
  std::set<fs::path> files, pages = {"index.html"};
  while (!pages.empty()) {
    const fs::path page = *pages.begin();
    pages.erase(pages.begin());
    if (!fs::is_regular_file(out / page)) continue;
    const std::string html = read_file(out / page);
    if (html.find(kGenerator) == std::string::npos) continue;
    files.insert(page);
    for (const std::string& target : targets_in(html)) {
      const std::string name = target.substr(0, target.find('#'));
      const fs::path file = (page.parent_path() / name).lexically_normal();
      if (name.empty() || file.is_absolute() || *file.begin() == ".." || files.count(file))
        continue;
      if (file.extension() == ".html") {
        pages.insert(file);
      } else if (name.find(':') == std::string::npos) {
        files.insert(file);
      }
    }
  }
  return {files.begin(), files.end()};
}

void write_checks(const std::vector<Family>& families, const fs::path& folder) {
  fs::create_directories(folder);
  for (const Family& family : families)
    for (const CaseInfo* info : family.cases)
      write_file(folder / (slug(info->id) + ".csv"),
                 to_csv(checks_table(*info, family.runs_of(info->id))));
}

}  // namespace

fs::path write_report(const Results& results, const fs::path& out, bool single_file) {
  const fs::path part = out / kUnfinishedFolder;
  try {
    std::vector<Family> families = plan_families(results);
    CostPanels panels = plan_cost(results);
    std::vector<std::vector<Figure*>> pages = figures_by_page(families);
    pages.push_back(panels.figures());
    std::optional<Figure> over_time;
    if (results.history && results.history->calls.size() > 1)
      pages.back().push_back(&over_time.emplace(history_figure(*results.history)));
    number_figures(pages);
    std::vector<Figure*> figures;
    for (const auto& page : pages) figures.insert(figures.end(), page.begin(), page.end());
    // Where nothing was to be computed anew, nothing is drawn anew that is there.
    const Environment& from = results.environment;
    draw(figures, part / "figures", from.stored_runs > 0 ? out / "figures" : fs::path(),
         from.trammel + from.commit);
    // The script reads curves and moves shapes in their page only; the rest is loaded when seen.
    for (Figure* figure : figures)
      figure->is_linked |=
          figure->moving.empty() && figure->svg.find(" data-axes=") == std::string::npos;
    write_checks(families, part / "checks");
    for (const SiteFile& file : site_files(results, families, panels, over_time)) {
      fs::create_directories((part / file.path).parent_path());
      write_file(part / file.path, file.text);
    }
    if (single_file)
      write_file(part / "report.html", single_page(results, families, panels, over_time));
    replace_files(part, out, "index.html", earlier_files(out));
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(part, ignored);
    throw;
  }
  return out / (single_file ? "report.html" : "index.html");
}

}  // namespace trammel::reports
