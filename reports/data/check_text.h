#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "reports/data/results.h"

/// A check in words: its status, its numbers and its counts.
namespace trammel::reports {

/// The status of a check on the page. A comparison that is recorded as not agreeing is a status of
/// its own and no pass, although its verdict, which gates, is "pass" while it is as recorded.
enum class CheckStatus { passes, known_discrepancy, not_judged, fails, error, not_run, not_given };
inline constexpr std::array<CheckStatus, 7> kAllCheckStatuses = {
    CheckStatus::passes,     CheckStatus::known_discrepancy,
    CheckStatus::not_judged, CheckStatus::fails,
    CheckStatus::error,      CheckStatus::not_run,
    CheckStatus::not_given};

[[nodiscard]] CheckStatus check_status(const Check& check);

/// How a run's own ending counts: a singular or not converged run passes when it has checks and all
/// of them pass, for then the case expects that ending.
[[nodiscard]] CheckStatus check_status(const Run& run);

/// "passes", "known discrepancy", "not judged", "fails", "error", "not run", "not given"; and
/// the class name in the style sheet; and a sign that does not need colour.
[[nodiscard]] std::string to_text(CheckStatus status);
[[nodiscard]] std::string css_class(CheckStatus status);
[[nodiscard]] std::string sign(CheckStatus status);

/// What deserves attention before others has more.
[[nodiscard]] int severity(CheckStatus status);

/// Share of its tolerance that a check uses: 1 at the limit, infinity where nothing can be said.
/// For a band the distance from its middle over its half width.
[[nodiscard]] double tolerance_fraction(const Check& check);

/// Checks of one run under one name and quantity, in their order.
struct CheckGroup {
  const Run* run = nullptr;
  std::vector<const Check*> checks;

  [[nodiscard]] const Check& front() const { return *checks.front(); }
  /// An error before a failure before whatever uses most of its tolerance.
  [[nodiscard]] const Check& worst() const;
};
[[nodiscard]] std::vector<CheckGroup> group_checks(const Run& run);

/// Distance of the difference from agreement, in the measure of the check.
[[nodiscard]] double size_of_difference(const Check& check);
/// Whether `a` deserves attention before `b`: of known discrepancies the larger difference.
[[nodiscard]] bool worse(const Check& a, const Check& b);

using Counts = std::map<CheckStatus, std::size_t>;
[[nodiscard]] std::size_t count_of(const Counts& counts, CheckStatus status);
[[nodiscard]] std::size_t total(const Counts& counts);
void add(Counts& counts, const Run& run);  ///< its checks
[[nodiscard]] bool all_checks_pass(const Counts& counts);

/// A check in the words and digits of a table's cells.

[[nodiscard]] std::string target_text(const Check& check);
[[nodiscard]] std::string computed_text(const Check& check);
[[nodiscard]] std::string difference_text(const Check& check);
[[nodiscard]] std::string tolerance_text(const Check& check);

/// A difference of this check's measure: +26 %, −3 × 10⁻⁸ N, ratio 1.02.
[[nodiscard]] std::string difference_text(const Check& check, double difference);

/// What the case calls the check, else its name.
[[nodiscard]] std::string check_title(const Check& check);

/// "frequency (Hz)", "largest |x displacement of P| (m), over rigid-platform".
[[nodiscard]] std::string quantity_text(const Check& check);

/// "mode 3", "point 37", "2"; empty without an index.
[[nodiscard]] std::string entry_text(const Check& check, std::size_t entries);

/// One line that says what went wrong with a group: how many, and the worst.
[[nodiscard]] std::string failure_text(const CheckGroup& group);

/// "192 element evaluations, 2 factorizations".
[[nodiscard]] std::string work_counters_text(const Counters& counters);

}  // namespace trammel::reports
