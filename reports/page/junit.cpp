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

/// One testcase element, counted.
std::string testcase(const std::string& classname, const std::string& name, double time_s,
                     CheckStatus status, const std::string& message, Tally& tally) {
  ++tally.tests;
  tally.time_s += time_s;
  const std::string head = "    <testcase" + attribute("classname", classname) +
                           attribute("name", name) + attribute("time", shortest(time_s));
  const auto with = [&](const std::string& element) {
    return head + ">\n      <" + element + attribute("message", message) + "/>\n    </testcase>\n";
  };
  switch (status) {
    case CheckStatus::fails:
      ++tally.failures;
      return with("failure");
    case CheckStatus::error:
      ++tally.errors;
      return with("error");
    case CheckStatus::not_run:
    case CheckStatus::not_given:
      ++tally.skipped;
      return with("skipped");
    case CheckStatus::known_discrepancy:
      // No failure of the gate, but no agreement either.
      return head + ">\n      <system-out>does not agree: " + xml_escaped(message) +
             "</system-out>\n    </testcase>\n";
    case CheckStatus::passes:
    case CheckStatus::not_judged:
      break;
  }
  return head + "/>\n";
}

std::string check_name(const Check& check) {
  std::string name = check.name + ": " + check.quantity;
  if (check.index) name += "[" + std::to_string(*check.index) + "]";
  return name;
}

std::string check_message(const Check& check) {
  std::string text = check.message;
  if (check.computed)
    add_item(text,
             "computed " + computed_text(check) + ", target " + target_text(check) +
                 ", difference " + difference_text(check) + ", tolerance " + tolerance_text(check),
             "; ");
  return text;
}

std::string suite(const CaseInfo& info, const Results& results, Tally& all) {
  Tally tally;
  std::string body;
  for (const Run& run : results.runs) {
    if (run.case_id != info.id) continue;
    const std::string classname = info.id + "." + run.variant;
    body += testcase(classname, "status: " + to_string(run.status), run.cost.wall_s,
                     check_status(run), run.reason, tally);
    for (const Check& check : run.checks)
      body += testcase(classname, check_name(check), 0, check_status(check), check_message(check),
                       tally);
  }
  if (tally.tests == 0) return "";
  all.add(tally);
  return "  <testsuite" + attribute("name", info.id) + attributes(tally) + ">\n" + body +
         "  </testsuite>\n";
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
