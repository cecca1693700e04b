#pragma once

#include <vector>

#include "harness/results/run_results.h"

/// Groups the checks of a run by name, and orders checks by severity. A check compares a computed
/// with an expected value.
namespace trammel::results {

/// Returns the difference between computed and expected value, divided by the tolerance. The result
/// is 1 at the limit of the tolerance, and infinity if the check has no difference. If the
/// tolerance is a range, the result is the distance of the difference from the middle of the range,
/// divided by half of the range's width. If the check is a bound, the computed value replaces the
/// difference.
[[nodiscard]] double difference_over_tolerance(const Check& check);

/// Returns the magnitude of a check's difference, or |ratio - 1| if the check measures a ratio.
[[nodiscard]] double size_of_difference(const Check& check);

/// Returns true if the result of check `a` is more severe than that of check `b`. The results in
/// descending severity are: error, fail, not run or not given, recorded without judgment, known
/// discrepancy, pass. Of two known discrepancies, the one with the larger difference is more
/// severe. Otherwise, the check with the larger `difference_over_tolerance` is more severe.
[[nodiscard]] bool is_worse_than(const Check& a, const Check& b);

/// Checks of one run that have the same name and the same quantity, in the order of the run.
struct CheckGroup {
  std::vector<const Check*> checks;

  [[nodiscard]] const Check& front() const { return *checks.front(); }
  /// Returns the check of the group with the most severe result.
  [[nodiscard]] const Check& worst() const;
};
[[nodiscard]] std::vector<CheckGroup> group_checks(const Run& run);

}  // namespace trammel::results
