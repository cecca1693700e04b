#pragma once

#include <array>
#include <map>
#include <string>

#include "harness/results/check_groups.h"
#include "reports/data/results.h"

/// Status of a check (comparison of a computed value with a target), and its values as text.
namespace trammel::reports {

/// Status of a check on the report pages. A check with a known discrepancy has the verdict "pass"
/// while its difference from the target stays in the recorded range. The page shows a separate
/// status for it, because the computed value does not agree with the target.
enum class CheckStatus {
  passes,
  known_discrepancy,
  not_judged,
  fails,
  changed_discrepancy,
  error,
  not_run,
  not_given
};

/// Text, CSS class and symbol of a status. The symbol, such as ✓, shows the status without color. A
/// report page lists statuses of higher severity first.
struct StatusStyle {
  CheckStatus status;
  const char *text, *css_class, *sign;
  int severity;
};
inline constexpr std::array<StatusStyle, 8> kStatusStyles = {{
    {CheckStatus::passes, "passes", "passes", "✓", 0},
    {CheckStatus::known_discrepancy, "known discrepancy", "known-discrepancy", "≠", 1},
    {CheckStatus::not_judged, "not judged", "not-judged", "○", 2},
    {CheckStatus::fails, "fails", "fails", "✗", 4},
    {CheckStatus::changed_discrepancy, "changed discrepancy", "fails", "Δ", 4},
    {CheckStatus::error, "error", "error", "!", 5},
    {CheckStatus::not_run, "not run", "not-run", "–", 3},
    {CheckStatus::not_given, "not given", "not-run", "·", 3},
}};
static_assert(kStatusStyles.back().status == static_cast<CheckStatus>(kStatusStyles.size() - 1));
static_assert(kStatusStyles[4].status == static_cast<CheckStatus>(4));
[[nodiscard]] const StatusStyle& find_style(CheckStatus status);

/// Returns true if a check fails, ends with an error, or has a known discrepancy outside its
/// recorded range.
[[nodiscard]] bool is_failure(CheckStatus status);
[[nodiscard]] CheckStatus find_status(const Check& check);

/// Returns the status of the run of a case from the status of its solution: solved, singular
/// matrix, no convergence or error. A run with a singular matrix or without convergence passes if
/// it has checks and all its checks pass. Its case then expects this status.
[[nodiscard]] CheckStatus find_status(const Run& run);

/// Number of checks with each status.
using Counts = std::map<CheckStatus, std::size_t>;
[[nodiscard]] std::size_t count_of(const Counts& counts, CheckStatus status);
[[nodiscard]] std::size_t total(const Counts& counts);
/// Adds the numbers of checks of a run to `counts`. A check of several values counts once, with the
/// status of its worst value: the most severe status among the values.
void add_check_counts(Counts& counts, const Run& run);
[[nodiscard]] bool all_checks_pass(const Counts& counts);

// Values of a check as text for the cells of a table.

[[nodiscard]] std::string target_text(const Check& check);
[[nodiscard]] std::string computed_text(const Check& check);
[[nodiscard]] std::string difference_text(const Check& check);
[[nodiscard]] std::string tolerance_text(const Check& check);

/// Returns a difference from the target, in the form that the key "measure" of the check names:
/// relative "+26 %", absolute "−3 × 10⁻⁸ N", or as a ratio "× 1.02".
[[nodiscard]] std::string difference_text(const Check& check, double difference);

/// Returns true if a check compares a number with a tolerance. It returns false for checks of a
/// status and for checks with a known discrepancy.
[[nodiscard]] bool is_numeric(const Check& check);

/// Returns the comparison of the difference of a check with its validation uncertainty. Returns
/// null if the run has no such comparison.
[[nodiscard]] const Comparison* find_comparison(const Run& run, const Check& check);

/// Returns the title of the check, or its name if it has none.
[[nodiscard]] std::string check_title(const Check& check);

/// Returns the judged quantity with its unit: "frequency (Hz)", or "largest magnitude of x
/// displacement of P, against rigid-platform (m)".
[[nodiscard]] std::string quantity_text(const Check& check);

/// Returns a name for one of several values of a quantity: "mode 3", "point 37" or "2". The name is
/// empty for a check without an index.
/// @param entries  number of checked values of the quantity
[[nodiscard]] std::string entry_text(const Check& check, std::size_t entries);

/// Returns one line about a check that fails: the number of its values that fail, and the value
/// with the most severe result.
[[nodiscard]] std::string failure_text(const CheckGroup& group);

/// Returns the counted work of a run: "192 element evaluations, 2 factorizations".
[[nodiscard]] std::string work_counters_text(const Counters& counters);

}  // namespace trammel::reports
