#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "reports/data/results.h"

/// Checks: their status, and their numbers as text.
namespace trammel::reports {

/// Status of a check on the page. A known discrepancy is a separate status: its verdict is "pass"
/// as long as the difference is as recorded, but it does not pass.
enum class CheckStatus { passes, known_discrepancy, not_judged, fails, error, not_run, not_given };

/// Presentation of a status. The signs do not depend on color. A status of higher severity needs
/// attention first.
struct StatusStyle {
  CheckStatus status;
  const char *text, *css_class, *sign;
  int severity;
};
inline constexpr std::array<StatusStyle, 7> kStatusStyles = {{
    {CheckStatus::passes, "passes", "passes", "✓", 0},
    {CheckStatus::known_discrepancy, "known discrepancy", "known-discrepancy", "≠", 1},
    {CheckStatus::not_judged, "not judged", "not-judged", "○", 2},
    {CheckStatus::fails, "fails", "fails", "✗", 4},
    {CheckStatus::error, "error", "error", "!", 5},
    {CheckStatus::not_run, "not run", "not-run", "–", 3},
    {CheckStatus::not_given, "not given", "not-run", "·", 3},
}};
[[nodiscard]] const StatusStyle& style_of(CheckStatus status);

[[nodiscard]] CheckStatus check_status(const Check& check);

/// Returns the status of the way in which a run ended. A singular or not converged run passes if it
/// has checks and all of them pass, because then the case expects this ending.
[[nodiscard]] CheckStatus check_status(const Run& run);

/// Returns the share of its tolerance that a check uses: 1 at the limit, infinity if there is no
/// number. For a range, it is the distance from the middle over the half width.
[[nodiscard]] double tolerance_fraction(const Check& check);

/// Checks of one run with the same name and quantity, in their order.
struct CheckGroup {
  std::vector<const Check*> checks;

  [[nodiscard]] const Check& front() const { return *checks.front(); }
  /// Returns the entry of highest severity, and among those the one that uses most of its
  /// tolerance.
  [[nodiscard]] const Check& worst() const;
};
[[nodiscard]] std::vector<CheckGroup> group_checks(const Run& run);

/// Returns the distance of the difference from agreement, in the measure of the check.
[[nodiscard]] double size_of_difference(const Check& check);
/// Returns whether `a` needs attention before `b`. Of two known discrepancies, the larger one does.
[[nodiscard]] bool worse(const Check& a, const Check& b);

/// Number of checks of each status.
using Counts = std::map<CheckStatus, std::size_t>;
[[nodiscard]] std::size_t count_of(const Counts& counts, CheckStatus status);
[[nodiscard]] std::size_t total(const Counts& counts);
/// Adds the checks of a run. A check counts once, by its worst number.
void add(Counts& counts, const Run& run);
[[nodiscard]] bool all_checks_pass(const Counts& counts);

// Numbers of a check as text in the cells of a table.

[[nodiscard]] std::string target_text(const Check& check);
[[nodiscard]] std::string computed_text(const Check& check);
[[nodiscard]] std::string difference_text(const Check& check);
[[nodiscard]] std::string tolerance_text(const Check& check);

/// Returns a difference in the measure of the check: "+26 %", "−3 × 10⁻⁸ N", "× 1.02".
[[nodiscard]] std::string difference_text(const Check& check, double difference);

/// Returns the comparison of a check with its validation uncertainty; null if there is none.
[[nodiscard]] const Comparison* find_comparison(const Run& run, const Check& check);

/// Returns the title of the check, or its name if it has none.
[[nodiscard]] std::string check_title(const Check& check);

/// Returns "frequency (Hz)", "largest magnitude of x displacement of P, against rigid-platform
/// (m)".
[[nodiscard]] std::string quantity_text(const Check& check);

/// Returns "mode 3", "point 37" or "2"; empty for a check without an index.
[[nodiscard]] std::string entry_text(const Check& check, std::size_t entries);

/// Returns the number of failures of a group and its worst entry in one line.
[[nodiscard]] std::string failure_text(const CheckGroup& group);

/// Returns "192 element evaluations, 2 factorizations".
[[nodiscard]] std::string work_counters_text(const Counters& counters);

}  // namespace trammel::reports
