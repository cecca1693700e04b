#include "reports/page/report.h"

#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "harness/base/environment.h"
#include "harness/results/unfinished_folder.h"
#include "reports/page/render.h"
#include "reports/page/site.h"
#include "reports/text/files.h"

namespace trammel::reports {

namespace {

namespace fs = std::filesystem;

/// Name of the file that contains the key of a report (see `key_of`), and the sizes and paths of
/// the files of the report.
constexpr const char* kFileList = "report-files.txt";

/// Returns the key of a report: a hash of the program and of all results, without the date of the
/// call. A run in the store contributes the name of its file, which depends on the inputs.
std::string key_of(const Results& results) {
  auto json = to_json(results, true);
  for (const char* key : {"date", "stored_runs"}) json["environment"].erase(key);
  using Handler = decltype(json)::error_handler_t;
  return harness::content_hash(json.dump(-1, ' ', false, Handler::replace) +
                               harness::program_hash());
}

/// Reads the list of files of an earlier report.
/// @param key  set to the key of the earlier report, or empty if one of its files is missing or has
/// another size
std::vector<fs::path> read_file_list(const fs::path& out, std::string& key) {
  std::vector<fs::path> files;
  std::ifstream in(out / kFileList);
  std::getline(in, key);
  std::uintmax_t size = 0;
  std::error_code missing;
  for (fs::path file; in >> file >> size; files.push_back(file)) {
    if (file.is_absolute() || *file.lexically_normal().begin() == "..") return {};
    if (fs::file_size(out / file, missing) != size) key.clear();
  }
  return files;
}

/// Returns the paths and sizes of the files of a report, except for results.json and junit.xml.
std::string list_report_files(const fs::path& folder) {
  std::set<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.insert(entry.path().lexically_relative(folder));
  std::ostringstream list;
  for (const fs::path& file : files)
    if (file != "results.json" && file != "junit.xml")
      list << file << ' ' << fs::file_size(folder / file) << '\n';
  return list.str();
}

}  // namespace

fs::path write_report(const Results& results, const fs::path& out) {
  const fs::path part = out / kUnfinishedFolder;
  const std::string key = key_of(results);
  std::string earlier_key;
  const std::vector<fs::path> earlier_files = read_file_list(out, earlier_key);
  try {
    const Environment& from = results.environment;
    if (from.stored_runs > 0 && key == earlier_key) {
      fs::create_directories(part);
      replace_files(part, out, kFileList, {});
      return out / "index.html";
    }
    std::vector<Family> families = plan_family_figures(results);
    StudyFigures studies = plan_studies(results, families);
    std::vector<Figure*> figures = all_figures(families);
    for (Figure* figure : studies.all()) figures.push_back(figure);
    make_ids_unique(figures);
    // If the results include runs that an earlier call computed, unchanged drawings of the earlier
    // report are reused.
    draw(figures, part / "figures", from.stored_runs > 0 ? out / "figures" : fs::path(),
         from.trammel + from.commit);
    // A drawing is inlined in the page if the script page.js reads its curves or animates its
    // motion. Other drawings are loaded when the reader scrolls to them.
    for (Figure* figure : figures)
      figure->is_linked |=
          figure->moving.empty() && figure->svg.find(" data-axes=") == std::string::npos;
    fs::create_directories(part / "checks");
    for (const Family& family : families)
      for (const CaseInfo* info : family.cases)
        write_file(part / "checks" / (slug(info->id) + ".csv"),
                   to_csv(checks_table(*info, family.runs_of(info->id))));
    for (const SiteFile& file : site_files(results, families, studies)) {
      fs::create_directories((part / file.path).parent_path());
      write_file(part / file.path, file.text);
    }
    write_file(part / kFileList, key + "\n" + list_report_files(part));
    replace_files(part, out, kFileList, earlier_files);
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(part, ignored);
    throw;
  }
  return out / "index.html";
}

}  // namespace trammel::reports
