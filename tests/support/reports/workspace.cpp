#include "tests/support/reports/workspace.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "reports/page/report.h"

namespace trammel::testing {

namespace fs = std::filesystem;

Workspace::Workspace() {
  std::string name = (fs::temp_directory_path() / "trammel-report-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("cannot create a temporary folder");
  path_ = name;
}

Workspace::~Workspace() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string read_text_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error("no " + file.string());
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

std::map<std::string, std::string> pages_of(const fs::path& report) {
  std::map<std::string, std::string> pages;
  for (const auto& entry : fs::recursive_directory_iterator(report))
    if (entry.path().extension() == ".html")
      pages[fs::relative(entry.path(), report).string()] = read_text_file(entry.path());
  return pages;
}

std::string text_of_pages(const fs::path& report) {
  std::string text;
  for (const auto& [path, page] : pages_of(report)) text += page;
  return text;
}

results::Results sample_results() {
  using namespace results;
  Results sample;
  for (const char* name : {"beam", "benchmark", "manipulator"}) {
    const fs::path folder = TRAMMEL_SOURCE_DIR "/tests/support/reports/results";
    Results part = read_results(folder / (std::string(name) + ".json"));
    for (Run& run : part.runs) run.stored.clear();
    std::ranges::move(part.cases, std::back_inserter(sample.cases));
    std::ranges::move(part.references, std::back_inserter(sample.references));
    std::ranges::move(part.runs, std::back_inserter(sample.runs));
    sample.environment = std::move(part.environment);
  }
  sample.cases[0].title = "Beam <b>&\"quoted\"</b> 'it' `date` {{x}}, six modes";

  std::vector<Check>& checks = sample.runs.back().checks;
  Check failing = checks.front(), missing = failing, recorded = failing, not_run = failing;
  failing.name = "failing";
  failing.computed = 2 * *failing.expected;
  failing.difference = 1.0;
  failing.verdict = Verdict::fail;
  missing.name = "missing";
  missing.computed = missing.difference = {};
  missing.verdict = Verdict::error;
  missing.message = "the value is not finite";
  recorded.name = "recorded";
  recorded.tolerance.reset();
  recorded.expectation = Expectation::none;
  recorded.verdict = Verdict::recorded;
  not_run.name = "not-run";
  not_run.role = "regression";
  not_run.verdict = Verdict::not_run;
  checks.insert(checks.end(), {failing, missing, recorded, not_run});

  Run singular;
  singular.case_id = "vpcs-sdll02";
  singular.variant = "free";
  singular.status = Status::singular;
  singular.reason = "the frame turns about its node";
  Check ending;
  ending.name = ending.quantity = ending.measure = "status";
  ending.title = "A free frame has no stiffness";
  ending.role = "verification";
  ending.message = "singular: the frame turns about its node";
  ending.verdict = Verdict::pass;
  singular.checks = {ending};
  for (CaseInfo& info : sample.cases)
    if (info.id == "vpcs-sdll02") info.variants.push_back({"free", "without support"});
  Run broken;
  broken.case_id = "table-1-audit";
  broken.variant = "broken";
  broken.status = Status::error;
  broken.reason = "/model/nodes/B: a member of length 0";
  sample.cases.back().variants.push_back({"broken", "with an error"});
  sample.runs.insert(sample.runs.end(), {singular, broken});
  return sample;
}

results::Results sample_results_of_case(const std::string& case_id) {
  results::Results sample = sample_results();
  std::erase_if(sample.runs, [&](const results::Run& run) { return run.case_id != case_id; });
  return sample;
}

const fs::path& sample_report() {
  static const Workspace workspace;
  static const fs::path folder = [] {
    fs::path out = workspace.path() / "report";
    reports::write_report(sample_results(), out);
    return out;
  }();
  return folder;
}

std::string page_of(const results::Results& results) {
  const Workspace workspace;
  return read_text_file(reports::write_report(results, workspace.path() / "out"));
}

std::string all_pages_of(const results::Results& results) {
  const Workspace workspace;
  (void)reports::write_report(results, workspace.path() / "out");
  return text_of_pages(workspace.path() / "out");
}

}  // namespace trammel::testing
