#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "reports/data/results.h"

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

/// "passes", "does not agree (known)", "not judged", "fails", "error", "not run", "not given"; and
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

/// Whether `a` deserves attention before `b`.
[[nodiscard]] bool worse(const Check& a, const Check& b);

using Counts = std::map<CheckStatus, std::size_t>;
[[nodiscard]] std::size_t count_of(const Counts& counts, CheckStatus status);
[[nodiscard]] std::size_t total(const Counts& counts);
void add(Counts& counts, const Run& run);  ///< its checks
[[nodiscard]] bool all_checks_pass(const Counts& counts);

}  // namespace trammel::reports
