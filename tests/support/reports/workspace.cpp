#include "tests/support/reports/workspace.h"

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "reports/page/report.h"
#include "tests/support/reports/sample.h"

namespace trammel::testing {

namespace fs = std::filesystem;

Workspace::Workspace() {
  std::string name = (fs::temp_directory_path() / "trammel-report-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
  path_ = name;
}

Workspace::~Workspace() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

fs::path Workspace::results(const nlohmann::ordered_json& json) const {
  const fs::path file = path_ / "results.json";
  std::ofstream(file) << json.dump(1);
  return file;
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error("no " + file.string());
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

fs::path write_report_of(const fs::path& results_json, const fs::path& out, bool single_file) {
  return reports::write_report(results::read_results(results_json), out, single_file);
}

std::map<std::string, std::string> pages_of(const fs::path& report) {
  std::map<std::string, std::string> pages;
  for (const auto& entry : fs::recursive_directory_iterator(report))
    if (entry.path().extension() == ".html")
      pages[fs::relative(entry.path(), report).string()] = text_of(entry.path());
  return pages;
}

std::string text_of_pages(const fs::path& report) {
  std::string text;
  for (const auto& [path, page] : pages_of(report)) text += page;
  return text;
}

const fs::path& sample_report() {
  static const Workspace workspace;
  static const fs::path folder = [] {
    fs::path out = workspace.path() / "report";
    write_report_of(workspace.results(sample_results()), out);
    return out;
  }();
  return folder;
}

}  // namespace trammel::testing
