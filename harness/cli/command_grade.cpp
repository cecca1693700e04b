#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <memory>

#include "harness/base/find_or_add.h"
#include "harness/base/json_file.h"
#include "harness/base/processes.h"
#include "harness/base/progress.h"
#include "harness/base/text.h"
#include "harness/cli/commands.h"
#include "harness/grade/grade.h"
#include "harness/printing/printing.h"
#include "harness/results/run_grade.h"
#include "harness/run/results.h"
#include "harness/run/stored_results.h"

namespace trammel::harness {
namespace {

using results::Grade;

/// Returns the reason for a grade other than `agrees` and `off`: the reason of the run, or else the
/// message of a check without a computed value.
std::string reason_of_grade(const results::Run& run, Grade grade) {
  if (!run.reason.empty()) return run.reason;
  for (const results::Check& check : run.checks)
    if (grade == Grade::not_given || check.verdict == Verdict::error)
      return check.name + ": " + check.message;
  return "";
}

/// Prints a row for each run with the decisive check, then the number of runs with each grade.
void print_grades(const std::vector<results::Run>& runs) {
  std::vector<Column> columns = {"grade", "case", ">given", {"time_s", "time [s]", 2}};
  std::ranges::move(columns_of_checks(), std::back_inserter(columns));
  Rows table(columns);
  std::map<Grade, std::size_t> counts;
  std::map<std::string, std::vector<std::string>> reasons;  // names of runs by reason
  for (const results::Run& run : runs) {
    const Grade grade = results::grade_of_run(run);
    ++counts[grade];
    const auto missing = std::ranges::count_if(run.checks, [](const auto& check) {
      return check.verdict == Verdict::not_given || check.verdict == Verdict::error;
    });
    const std::string name = run.case_id + (run.variant == kBaseVariant ? "" : ":" + run.variant);
    std::vector<Json> row = {
        to_string(grade), name,
        fmt::format("{} of {}", std::ssize(run.checks) - missing, run.checks.size()),
        run.cost.wall_s};
    if (grade == Grade::agrees || grade == Grade::off)
      std::ranges::move(cells_of_check(*results::decisive_check(run)), std::back_inserter(row));
    else
      reasons[printable(reason_of_grade(run, grade), 160)].push_back(name);
    table.add(std::move(row));
  }
  table.print(std::cout);
  for (const auto& [reason, names] : reasons)
    std::cout << wrapped(
        (names.size() > 3 ? count_of(names.size(), "run") : join(names, "and")) + ": " + reason,
        "  ");
  std::vector<std::string> parts;
  for (const auto& [grade, count] : counts)
    parts.push_back(fmt::format("{} {}", count, to_string(grade)));
  std::cout << count_of(runs.size(), "run") << fmt::format(": {}\n", fmt::join(parts, ", "));
  if (!counts.contains(Grade::agrees) && !counts.contains(Grade::off))
    std::cout << "No check could judge a number that the adapter returned.\n";
}

results::Solver solver_name(const std::vector<Run>& runs, const std::string& command,
                            const std::string& program) {
  for (const Run& run : runs)
    if (!run.solver.name.empty())
      return {one_line(run.solver.name), one_line(run.solver.version), command};
  return {std::filesystem::path(program).stem().string(), "", command};
}

}  // namespace

int grade_command(const CommandOptions& options, const Renderers& renderers) {
  Adapter adapter{split_adapter_command(options.adapter),
                  std::filesystem::absolute(options.out) / "calls",
                  {options.max_time_s, options.memory_bytes, options.max_disk_bytes}};
  std::vector<Case> cases = select_cases(options);
  // Cases with the label "control" test only the evaluation of checks and do not apply to other
  // codes.
  if (options.words.empty())
    std::erase_if(cases, [](const Case& given) { return contains(given.labels(), "control"); });
  const OutputLock lock(options.out);
  exit_on_signals(kInterrupted);
  const References references;
  adopt_descendants();
  // When the command ends for any reason, kills the processes that adapters have left running.
  const std::shared_ptr<void> guard(nullptr, [](void*) { kill_descendants(); });
  Progress progress("runs");
  RunOptions run_options{options.variant, options.jobs, TrackedQuantities::named, {}};
  run_options.progress = [&](std::size_t done, std::size_t of) { progress.show(done, of); };
  run_options.store = store_folder(options.out, options.store);
  run_options.resume = options.resume;
  run_options.solver = adapter_solver(adapter);
  results::Results found = collect_results(run_cases(cases, references, run_options), cases,
                                           references, run_options.store);
  found.solver = solver_name(found.runs, options.adapter, adapter.words.front());
  found.uncertainty_coverage.reset();  // valid only for refinements by trammel
  const auto file = write_results(found, options.out);
  renderers.junit(found, std::filesystem::path(options.out) / "junit.xml");
  const auto page = renderers.codes({file}, options.out);
  if (options.json) {
    std::cout << read_text(file);
  } else {
    print_grades(found.runs);
    std::cout << "results in " << file.string() << ", page in " << page.string() << std::endl;
  }
  require_uninterrupted(found.runs);
  const bool failure = std::ranges::any_of(
      found.runs, [](const results::Run& one) { return is_failure(results::grade_of_run(one)); });
  return failure ? 1 : 0;
}

}  // namespace trammel::harness
