#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "reports/data/results.h"

namespace trammel::reports {

/// Where a check stands, as the page says it: a pass that was expected to agree is not the same
/// as a pass that was expected to differ.
enum class Standing { holds, known, recorded, fails, error, not_run };
inline constexpr std::array<Standing, 6> all_standings = {Standing::holds,    Standing::known,
                                                          Standing::recorded, Standing::fails,
                                                          Standing::error,    Standing::not_run};

[[nodiscard]] Standing standing(const Check& check);

/// How a run's own ending counts: a singular or not converged run holds when it has checks and all
/// of them pass, for then the case expects that ending.
[[nodiscard]] Standing standing(const Run& run);

/// "holds", "known discrepancy", "fails", "error", "not run"; and the class name in the style
/// sheet; and a sign that does not need colour.
[[nodiscard]] std::string in_words(Standing standing);
[[nodiscard]] std::string css_class(Standing standing);
[[nodiscard]] std::string sign(Standing standing);

/// Share of its tolerance that a check uses: 1 at the limit, infinity where nothing can be said.
/// For a band the distance from its middle over its half width.
[[nodiscard]] double tolerance_used(const Check& check);

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

using Counts = std::map<Standing, std::size_t>;
[[nodiscard]] std::size_t count_of(const Counts& counts, Standing standing);
[[nodiscard]] std::size_t total(const Counts& counts);
void add(Counts& counts, const Run& run);  ///< its checks
[[nodiscard]] bool gate_holds(const Counts& counts);

}  // namespace trammel::reports
