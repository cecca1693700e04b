#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <map>

#include "harness/base/number.h"
#include "harness/base/quantity.h"
#include "harness/base/text.h"
#include "harness/judge/evaluate_check.h"
#include "harness/printing/printing.h"
#include "harness/results/check_groups.h"
#include "harness/results/run_grade.h"

namespace trammel::harness {
namespace {

using results::Number;
using results::Numbers;

/// Returns the number of digits required to distinguish the printed limits of a check from each
/// other and from the judged number.
int digits_of_check_limits(const results::Check& check) {
  constexpr int kLeast = 3, kMost = 12;
  if (!check.tolerance || check.tolerance->symmetric) return kLeast;
  const Number low = check.tolerance->low, high = check.tolerance->high,
               judged = check.measure == "bound" ? check.computed : check.difference;
  const auto differ = [](const Number& a, const Number& b, int digits) {
    return !a || !b || *a == *b || rounded(*a, digits) != rounded(*b, digits);
  };
  int digits = kLeast;
  while (digits < kMost && !(differ(low, high, digits) && differ(low, judged, digits) &&
                             differ(judged, high, digits)))
    ++digits;
  return digits;
}

std::string tolerance_text(const results::Check& check) {
  if (!check.tolerance) return "";
  const auto& [low, high, is_symmetric] = *check.tolerance;
  const auto text = [&](const Number& end) { return rounded(*end, digits_of_check_limits(check)); };
  if (is_symmetric) return "+-" + text(high);
  if (!low) return high ? "at most " + text(high) : "";
  return high ? "[" + text(low) + ", " + text(high) + "]" : "at least " + text(low);
}

/// Returns the largest estimated discretization error of a quantity as text [%]; empty if
/// there is no estimate.
std::string estimated_error_text(const results::Run& run, const std::string& quantity) {
  const auto* found = run.errors ? run.errors->find(quantity) : nullptr;
  if (found == nullptr) return "";
  double largest = 0;
  for (const Number relative : found->relative) largest = std::max(largest, relative.value_or(0));
  return fmt::format("+- {:.2g} %{}", 100 * largest, found->asymptotic ? "" : " (coarse)");
}

/// Prints the values of each quantity, or their range if there are more than six.
void print_quantities(const results::Run& run) {
  constexpr std::size_t kMostValues = 6;
  Rows table({"quantity", "entries", {"values", "", 8}, {"discretization"}});
  for (const auto& [name, quantity] : run.quantities) {
    const std::vector<double>& values = quantity.values;
    if (values.empty() || is_error_measure(name)) continue;
    Json cells = Json::array();
    for (const double value : values) cells.push_back(number_or_null(value));
    if (values.size() > kMostValues) {
      const auto [low, high] = std::ranges::minmax(values);
      cells = fmt::format("{:.6g} ... {:.6g}", low, high);
    }
    table.add({name, values.size(), cells, estimated_error_text(run, name)});
  }
  if (!table.empty()) table.print(std::cout, "  ");
}

}  // namespace

std::vector<Column> columns_of_checks() {
  return {"verdict",           "check",       "quantity", {"computed", "", 8},
          {"expected", "", 8}, ">difference", ">allowed"};
}

std::vector<Json> cells_of_check(const results::Check& check, bool with_index) {
  const std::string index = check.index && with_index ? fmt::format("[{}]", *check.index) : "",
                    statistic = check.statistic.empty() ? "" : check.statistic + " ";
  return {results::verdict_text(check),
          check.name,
          statistic + check.quantity + index,
          number_or_null(check.computed),
          number_or_null(check.expected),
          check.difference ? rounded(*check.difference, digits_of_check_limits(check)) : "",
          tolerance_text(check)};
}

void print_run(const results::Run& run, bool with_values) {
  std::cout << run.case_id << (run.variant == "base" ? "" : ":" + run.variant) << "  "
            << to_string(run.status) << ", " << rounded(run.cost.wall_s, 2) << " s\n"
            << wrapped(run.reason, "  ");
  for (const std::string& warning : run.warnings) std::cout << wrapped("warning: " + warning, "  ");
  if (run.errors && !run.errors->search.empty()) print_tried_settings(*run.errors);
  if (with_values || run.checks.empty() || run.errors) print_quantities(run);
  if (run.checks.empty()) return;
  Rows table(columns_of_checks());
  std::string messages;
  for (const results::CheckGroup& group : results::group_checks(run)) {
    const results::Check& check = group.worst();
    const std::vector<Json> cells = cells_of_check(check, group.checks.size() > 1);
    table.add(cells);
    const bool is_printed = check.quantity == "status" && !run.reason.empty();
    if (counts_as_failure(check.verdict) && !check.message.empty() && !is_printed)
      messages +=
          wrapped(fmt::format("{}, {}: {}", check.name, cells[2].get<std::string>(), check.message),
                  "    ");
  }
  table.print(std::cout, "  ");
  std::cout << messages;
}

void print_tried_settings(const results::ErrorEstimates& errors) {
  Rows table({{"setting"}, {"error", "estimated error", 2}, {"cpu_s", "processor time [s]", 2}});
  for (const results::AccuracyStep& step : errors.search)
    table.add({step.setting, number_or_null(step.error), step.cpu_s});
  table.print(std::cout, "  ");
}

void print_numerical_uncertainty(const results::Results& results) {
  if (!results.uncertainty_coverage) return;
  const results::UncertaintyCoverage& found = *results.uncertainty_coverage;
  std::cout << fmt::format(
      "the numerical uncertainty (GCI) covers the exact value on {} of {} levels ({}); median "
      "ratio of GCI to error: {}",
      found.covered, found.levels, percent(found.coverage.value_or(kNaN)),
      rounded(found.median_ratio.value_or(kNaN), 3));
  if (!found.passes)
    std::cout << ": FAIL, expected at least " << percent(found.min_coverage.value_or(kNaN))
              << " and at most " << rounded(found.max_median_ratio.value_or(kNaN));
  std::cout << '\n';
}

void print_summary(const results::Results& results) {
  std::map<std::string, std::size_t> verdicts, validations;
  std::size_t checks = 0, entries = 0, comparisons = 0;
  for (const results::Run& run : results.runs) {
    entries += run.checks.size();
    for (const results::CheckGroup& group : results::group_checks(run)) {
      ++checks;
      ++verdicts[results::verdict_text(group.worst())];
    }
    if (!run.uncertainty) continue;
    comparisons += run.uncertainty->comparisons.size();
    for (const results::Comparison& comparison : run.uncertainty->comparisons)
      ++validations[comparison.verdict];
  }
  std::cout << count_of(results.runs.size(), "run");
  if (const auto stored = std::ranges::count_if(results.runs, &results::Run::was_stored))
    std::cout << " (" << stored << " of them stored by an earlier call)";
  std::cout << fmt::format(", {} with {}: {} pass, {} known discrepancies, {} fail",
                           count_of(checks, "check"), count_of(entries, "number"), verdicts["pass"],
                           verdicts["known discrepancy"], verdicts["fail"]);
  for (const char* rare : {"changed discrepancy", "error", "not run", "not given", "not judged"})
    if (verdicts[rare] > 0) std::cout << ", " << verdicts[rare] << ' ' << rare;
  const auto bad = std::ranges::count(results.runs, results::Status::error, &results::Run::status);
  if (bad > 0) std::cout << "; " << bad << " with status error";
  std::cout << '\n';
  print_numerical_uncertainty(results);
  if (comparisons == 0) return;
  std::cout << comparisons << " comparisons with the paper (ASME V&V 20)";
  for (const auto& [verdict, count] : validations) std::cout << ", " << count << ' ' << verdict;
  std::cout << '\n';
}

}  // namespace trammel::harness
