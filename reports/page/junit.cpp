#include <unistd.h>

#include <array>

#include "reports/data/check_text.h"
#include "reports/data/results.h"
#include "reports/drawing/figure.h"
#include "reports/page/report.h"
#include "reports/text/files.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

struct Tally {
  std::size_t tests = 0, failures = 0, errors = 0, skipped = 0;
  double time_s = 0;

  void add(const Tally& other) {
    tests += other.tests;
    failures += other.failures;
    errors += other.errors;
    skipped += other.skipped;
    time_s += other.time_s;
  }
};

std::string attribute(const std::string& name, const std::string& value) {
  return " " + name + "=\"" + xml_escaped(value) + "\"";
}

std::string attributes(const Tally& tally) {
  return attribute("tests", std::to_string(tally.tests)) +
         attribute("failures", std::to_string(tally.failures)) +
         attribute("errors", std::to_string(tally.errors)) +
         attribute("skipped", std::to_string(tally.skipped)) +
         attribute("time", shortest(tally.time_s));
}

/// A test case with its outcome and what it prints, counted.
std::string testcase(const std::string& classname, const std::string& name, double time_s,
                     CheckStatus status, const std::string& message, const std::string& output,
                     Tally& tally) {
  ++tally.tests;
  tally.time_s += time_s;
  std::string text = "    <testcase" + attribute("classname", classname) + attribute("name", name) +
                     attribute("time", shortest(time_s)) + ">\n";
  const auto add = [&](const std::string& element, const std::string& type,
                       const std::string& words) {
    text += "      <" + element + attribute("type", "trammel." + type) +
            attribute("message", words) + "/>\n";
  };
  switch (status) {
    case CheckStatus::fails:
      ++tally.failures;
      add("failure", "fail", message);
      break;
    case CheckStatus::error:
      ++tally.errors;
      add("error", "error", message);
      break;
    case CheckStatus::known_discrepancy:
      ++tally.skipped;
      add("skipped", "known-discrepancy", "Known discrepancy: " + message);
      break;
    case CheckStatus::not_run:
    case CheckStatus::not_given:
      ++tally.skipped;
      add("skipped", "not-run", message);
      break;
    case CheckStatus::passes:
    case CheckStatus::not_judged:
      break;
  }
  if (!output.empty()) text += "      <system-out>" + xml_escaped(output) + "</system-out>\n";
  return text + "    </testcase>\n";
}

/// The worst entry of a check in one line.
std::string check_message(const CheckGroup& group) {
  const Check& worst = group.worst();
  if (check_status(worst) == CheckStatus::known_discrepancy)
    return difference_text(worst) + ", recorded " + tolerance_text(worst) + "; " + worst.why;
  return failure_text(group);
}

/// All entries of a check, and the reason of its tolerance.
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

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

std::string properties_of(const Environment& environment) {
  std::string text = "    <properties>\n";
  for (const auto& [name, value] : {std::pair("trammel", environment.trammel),
                                    {"commit", environment.commit},
                                    {"compiler", environment.compiler},
                                    {"processor", environment.processor}})
    text += "      <property" + attribute("name", name) + attribute("value", value) + "/>\n";
  return text + "    </properties>\n";
}

/// One check of a run is a test case; the run itself is a test case with the name "status".
std::string suite(const CaseInfo& info, const Results& results, Tally& all) {
  Tally tally;
  std::string body;
  for (const Run& run : results.runs) {
    if (run.case_id != info.id) continue;
    const std::string classname = info.id + "." + run.variant;
    body += testcase(classname, "status", run.cost.wall_s, check_status(run), run.reason,
                     run_output(run), tally);
    for (const CheckGroup& group : group_checks(run))
      body += testcase(classname, group.front().name, 0, check_status(group.worst()),
                       check_message(group), check_output(group), tally);
  }
  if (tally.tests == 0) return "";
  all.add(tally);
  const Environment& environment = results.environment;
  return "  <testsuite" + attribute("name", info.id) + attributes(tally) +
         attribute("timestamp", environment.date) + attribute("hostname", host_name()) + ">\n" +
         properties_of(environment) + body + "  </testsuite>\n";
}

}  // namespace

void write_junit(const Results& results, const std::filesystem::path& junit_xml) {
  Tally all;
  std::string suites;
  for (const CaseInfo& info : results.cases) suites += suite(info, results, all);
  write_file(junit_xml, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites" +
                            attribute("name", "trammel") + attributes(all) + ">\n" + suites +
                            "</testsuites>\n");
}

}  // namespace trammel::reports
