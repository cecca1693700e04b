#include "reports/page/report.h"

#include <set>

#include "harness/results/unfinished_folder.h"
#include "reports/page/render.h"
#include "reports/page/site.h"
#include "reports/text/files.h"

namespace trammel::reports {

namespace {

namespace fs = std::filesystem;

constexpr const char* kGenerator = R"(<meta name="generator" content="trammel">)";

/// Returns the pages of an earlier report in the folder `out`, and the files to which they link.
std::vector<fs::path> earlier_files(const fs::path& out) {
  std::set<fs::path> files, pages = {"index.html"};
  while (!pages.empty()) {
    const fs::path page = *pages.begin();
    pages.erase(pages.begin());
    if (!fs::is_regular_file(out / page)) continue;
    const std::string html = read_file(out / page);
    if (html.find(kGenerator) == std::string::npos) continue;
    files.insert(page);
    for (const std::string& target : link_targets(html)) {
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

fs::path write_report(const Results& results, const fs::path& out) {
  const fs::path part = out / kUnfinishedFolder;
  try {
    std::vector<Family> families = plan_family_figures(results);
    StudyFigures studies = plan_studies(results, families);
    std::vector<Figure*> figures = all_figures(families);
    for (Figure* figure : studies.all()) figures.push_back(figure);
    make_ids_unique(figures);
    // If the results include stored runs, unchanged drawings of the earlier report are reused.
    const Environment& from = results.environment;
    draw(figures, part / "figures", from.stored_runs > 0 ? out / "figures" : fs::path(),
         from.trammel + from.commit);
    // A drawing is inlined in the page if the script of the page reads its curves or animates its
    // shapes. Other drawings are loaded when they come into view.
    for (Figure* figure : figures)
      figure->is_linked |=
          figure->moving.empty() && figure->svg.find(" data-axes=") == std::string::npos;
    write_checks(families, part / "checks");
    for (const SiteFile& file : site_files(results, families, studies)) {
      fs::create_directories((part / file.path).parent_path());
      write_file(part / file.path, file.text);
    }
    replace_files(part, out, "index.html", earlier_files(out));
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(part, ignored);
    throw;
  }
  return out / "index.html";
}

}  // namespace trammel::reports
