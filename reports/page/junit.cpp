#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "reports/data/check_text.h"
#include "reports/data/results.h"
#include "reports/drawing/figure.h"
#include "reports/page/report.h"
#include "reports/text/files.h"

namespace trammel::reports {

namespace {

/// XML element and type with which JUnit XML reports a check that does not pass.
struct Outcome {
  CheckStatus status;
  const char *element, *type;
};
constexpr std::array<Outcome, 6> kOutcomes = {{
    {CheckStatus::fails, "failure", "fail"},
    {CheckStatus::changed_discrepancy, "failure", "changed-discrepancy"},
    {CheckStatus::error, "error", "error"},
    {CheckStatus::known_discrepancy, "skipped", "known-discrepancy"},
    {CheckStatus::not_run, "skipped", "not-run"},
    {CheckStatus::not_given, "skipped", "not-run"},
}};

/// Number of JUnit test cases, their total time, and the number of failures, errors and skips.
struct Tally {
  std::size_t tests = 0;
  double time_s = 0;
  std::map<std::string, std::size_t> elements = {};

  void add(const Tally& other) {
    tests += other.tests;
    time_s += other.time_s;
    for (const auto& [element, n] : other.elements) elements[element] += n;
  }
};

std::string attribute(const std::string& name, const std::string& value) {
  return " " + name + "=\"" + xml_escaped(value) + "\"";
}

std::string tally_attributes(Tally tally) {
  std::string text = attribute("tests", std::to_string(tally.tests));
  for (const auto& [name, element] : {std::pair("failures", "failure"), {"errors", "error"}})
    text += attribute(name, std::to_string(tally.elements[element]));
  return text + attribute("time", std::to_string(tally.time_s));
}

/// Returns the JUnit element of a test case with its outcome and output, and counts it in `tally`.
std::string testcase_element(const std::string& classname, const std::string& name, double time_s,
                             CheckStatus status, const std::string& message,
                             const std::string& output, Tally& tally) {
  ++tally.tests;
  tally.time_s += time_s;
  std::string text = "    <testcase" + attribute("classname", classname) + attribute("name", name) +
                     attribute("time", std::to_string(time_s)) + ">\n";
  const auto outcome = std::ranges::find(kOutcomes, status, &Outcome::status);
  if (outcome != kOutcomes.end()) {
    ++tally.elements[outcome->element];
    text += std::string("      <") + outcome->element +
            attribute("type", std::string("trammel.") + outcome->type) +
            attribute("message", message) + "/>\n";
  }
  if (!output.empty()) text += "      <system-out>" + xml_escaped(output) + "</system-out>\n";
  return text + "    </testcase>\n";
}

/// Returns one line about the value of a check with the most severe status.
std::string check_message(const CheckGroup& group) {
  const Check& worst = group.worst();
  if (find_status(worst) == CheckStatus::known_discrepancy)
    return "Known discrepancy: " + difference_text(worst) + ", recorded " + tolerance_text(worst) +
           "; " + worst.why;
  return failure_text(group);
}

/// Returns a line for each value of a check, then the reason for the tolerance.
std::string check_output(const CheckGroup& group) {
  std::string text;
  for (const Check* check : group.checks) {
    text += check->quantity;
    if (check->index) text += "[" + std::to_string(*check->index) + "]";
    text += ": computed " + computed_text(*check) + ", target " + target_text(*check) +
            ", difference " + difference_text(*check) + ", tolerance " + tolerance_text(*check) +
            "\n";
  }
  return text + group.front().why;
}

std::string run_output(const Run& run) {
  std::string text = "status: " + to_string(run.status);
  if (!run.reason.empty()) text += "; " + run.reason;
  for (const std::string& warning : run.warnings) text += "\nwarning: " + warning;
  return text;
}

/// Returns the JUnit test suite of a case. It has a test case named "status" for each run, and a
/// test case for each check. The check of the expected status of a run is named "expected-status".
std::string suite(const CaseInfo& info, const Results& results, Tally& all) {
  Tally tally;
  std::string body;
  for (const Run& run : results.runs) {
    if (run.case_id != info.id) continue;
    const std::string classname = info.id + "." + run.variant;
    body += testcase_element(classname, "status", run.cost.wall_s, find_status(run), run.reason,
                             run_output(run), tally);
    for (const CheckGroup& group : group_checks(run)) {
      const std::string& name = group.front().name;
      if (name == "unexpected-status") continue;  // reported by the test case "status"
      body += testcase_element(classname, name == "status" ? "expected-status" : name, 0,
                               find_status(group.worst()), check_message(group),
                               check_output(group), tally);
    }
  }
  if (tally.tests == 0) return "";
  all.add(tally);
  return "  <testsuite" + attribute("name", info.id) + tally_attributes(tally) +
         attribute("skipped", std::to_string(tally.elements["skipped"])) +
         attribute("timestamp", results.environment.date) + ">\n" + body + "  </testsuite>\n";
}

}  // namespace

void write_junit(const Results& results, const std::filesystem::path& junit_xml) {
  Tally all;
  std::string suites;
  for (const CaseInfo& info : results.cases) suites += suite(info, results, all);
  write_file(junit_xml, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites" +
                            attribute("name", "trammel") + tally_attributes(all) + ">\n" + suites +
                            "</testsuites>\n");
}

}  // namespace trammel::reports
