#include "harness/cli/command_grade.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>

#include "harness/base/contains.h"
#include "harness/base/errors.h"
#include "harness/base/json_file.h"
#include "harness/base/processes.h"
#include "harness/base/progress.h"
#include "harness/base/table.h"
#include "harness/base/text.h"
#include "harness/cli/command_cost.h"
#include "harness/grade/grade.h"
#include "harness/input/catalogue.h"
#include "harness/results/run_grade.h"
#include "harness/run/output_lock.h"
#include "harness/run/results.h"
#include "harness/run/stored_results.h"

namespace trammel::harness {
namespace {

using results::Grade;

/// What adapters leave behind ends with the command, however it ends.
class Descendants {
 public:
  Descendants() { adopt_descendants(); }
  ~Descendants() { end_descendants(); }
  Descendants(const Descendants&) = delete;
  Descendants& operator=(const Descendants&) = delete;
};

/// As many as show a relative difference, from 6 on.
int digits_to_tell(double difference) {
  const double digits = std::ceil(-std::log10(std::abs(difference))) + 1;
  return digits > 6 && digits < 15 ? static_cast<int>(digits) : digits >= 15 ? 15 : 6;
}

/// Watches over the judging itself and says nothing of a code.
bool is_control(const Case& one) {
  const std::vector<std::string> labels = one.labels();
  return contains(labels, "control");
}

/// "1e-09", "[0.62, 0.65]"; an end that is open stays empty.
std::string allowed(const results::Tolerance& tolerance) {
  const auto text = [](const results::Number& end) { return end ? rounded(*end, 3) : ""; };
  return tolerance.symmetric ? text(tolerance.high)
                             : "[" + text(tolerance.low) + ", " + text(tolerance.high) + "]";
}

/// The check that decides, or the reason.
std::string explained(const results::Run& run, Grade grade) {
  const results::Check* check = results::telling_check(run);
  if (grade == Grade::not_given) return run.checks.empty() ? "" : run.checks.front().message;
  if (grade != Grade::agrees && grade != Grade::off && grade != Grade::not_judged) {
    if (!run.reason.empty()) return run.reason;
    const auto broken = std::ranges::find_if(run.checks, [](const results::Check& candidate) {
      return candidate.verdict == Verdict::error;
    });
    return broken == run.checks.end() ? "" : broken->name + ": " + broken->message;
  }
  if (check == nullptr) return run.reason;
  if (!check->difference || !check->computed || !check->expected || !check->tolerance)
    return check->name + (check->message.empty() ? "" : ": " + check->message);
  // A recorded difference says why a number far from the expected one agrees.
  const bool recorded = check->expectation == results::Expectation::known_discrepancy;
  const std::string entry = check->index ? fmt::format("[{}]", *check->index) : "";
  const int digits = digits_to_tell(*check->difference / *check->expected);
  return fmt::format("{}: {}{} {}, expected {}: {} {:+.3g}, {} {}", check->name, check->quantity,
                     entry, rounded(*check->computed, digits), rounded(*check->expected, digits),
                     check->measure, *check->difference, recorded ? "recorded" : "allowed",
                     allowed(*check->tolerance));
}

/// A row a run, then how many of which grade.
void print_grades(const std::vector<results::Run>& runs) {
  Table table({"grade", "case", ">given", ">time", "what decides"});
  std::map<Grade, std::size_t> counts;
  for (const results::Run& run : runs) {
    const Grade grade = results::grade_of(run);
    ++counts[grade];
    const auto missing = std::ranges::count_if(run.checks, [](const auto& check) {
      return check.verdict == Verdict::not_given || check.verdict == Verdict::error;
    });
    const auto all = static_cast<std::ptrdiff_t>(run.checks.size());
    table.add({to_string(grade),
               run.case_id + (run.variant == kBaseVariant ? "" : ":" + run.variant),
               fmt::format("{} of {}", all - missing, all), rounded(run.cost.wall_s, 2) + " s",
               printable(explained(run, grade), 160)});
  }
  table.print(std::cout);
  std::cout << runs.size() << (runs.size() == 1 ? " run:" : " runs:");
  const char* separator = " ";
  for (const auto& [grade, count] : counts) {
    std::cout << separator << count << ' ' << to_string(grade);
    separator = ", ";
  }
  std::cout << '\n';
}

results::Solver solver_name(const std::vector<Run>& runs, const std::string& command,
                            const std::string& program) {
  for (const Run& run : runs)
    if (!run.solver.name.empty())
      return {one_line(run.solver.name), one_line(run.solver.version), command};
  return {std::filesystem::path(program).stem().string(), "", command};
}

}  // namespace

int grade_command(const GradeCommand& grade, const RunCommand& run, const Renderers& renderers) {
  Adapter adapter{adapter_words(grade.command), std::filesystem::absolute(grade.out) / "calls",
                  grade.limits};
  adapter.limits.memory_bytes = run.memory_bytes;
  const bool all = run.cases.empty() && run.labels.empty();
  std::vector<Case> cases = all ? Catalogue().load() : select_cases(run);
  if (run.cases.empty()) std::erase_if(cases, is_control);
  const OutputLock lock(grade.out);
  end_on_signals(kInterrupted);
  const References references;
  const Descendants ended;
  Progress progress("runs");
  RunOptions options{run.variant, run.jobs, TrackedQuantities::named, {}};
  options.progress = [&](std::size_t done, std::size_t of) { progress.show(done, of); };
  options.store = store_folder(run.out, run.store);
  options.resume = run.resume;
  options.solver = solver_of(adapter);
  results::Results found =
      results_of(run_cases(cases, references, options), cases, references, options.store);
  found.solver = solver_name(found.runs, grade.command, adapter.words.front());
  found.uncertainty_coverage.reset();  // it is a matter of trammel's own refinements
  const auto file = write_results(found, grade.out);
  renderers.junit(found, std::filesystem::path(grade.out) / "junit.xml");
  const auto page = renderers.codes({file}, grade.out);
  if (run.json) {
    std::cout << read_text(file);
  } else {
    print_grades(found.runs);
    std::cout << "results in " << file.string() << ", page in " << page.string() << std::endl;
  }
  require_complete(found.runs);
  const bool failure = std::ranges::any_of(
      found.runs, [](const results::Run& one) { return is_failure(results::grade_of(one)); });
  return failure ? 1 : 0;
}

}  // namespace trammel::harness
