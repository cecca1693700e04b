#pragma once

#include <vector>

#include "harness/results/run_results.h"

/// Checks of a run and their order by severity.
namespace trammel::results {

/// Returns the difference of a check divided by its tolerance: 1 at the limit, infinity if there is
/// no number. If the tolerance is a range, the result is the distance of the difference from the
/// middle of the range, divided by half of its width. A bound judges the value itself.
[[nodiscard]] double tolerance_fraction(const Check& check);

/// Returns the magnitude of the difference, or |ratio - 1| if the check measures a ratio.
[[nodiscard]] double size_of_difference(const Check& check);

/// Returns true if `a` is more severe than `b`: error, fail, without result, not judged, known
/// discrepancy, pass. At equal severity, it compares the sizes of two known discrepancies, and
/// otherwise the fractions of the tolerance.
[[nodiscard]] bool worse(const Check& a, const Check& b);

/// Checks of one run with the same name and quantity, in their order.
struct CheckGroup {
  std::vector<const Check*> checks;

  [[nodiscard]] const Check& front() const { return *checks.front(); }
  /// Returns the most severe entry.
  [[nodiscard]] const Check& worst() const;
};
[[nodiscard]] std::vector<CheckGroup> group_checks(const Run& run);

}  // namespace trammel::results
