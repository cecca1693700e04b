#include "harness/results/check_groups.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "harness/base/find_or_add.h"

namespace trammel::results {
namespace {

/// Severity of each verdict of a check, in the order of the enumeration `Verdict`; 5 is the worst.
constexpr std::array kSeverity = {0, 4, 5, 3, 2, 3};

int severity(const Check& check) {
  const bool is_known = check.verdict == Verdict::pass && check.is_known_discrepancy();
  return is_known ? 1 : kSeverity.at(static_cast<std::size_t>(check.verdict));
}

Number judged_number(const Check& check) {
  return check.measure == "bound" ? check.computed : check.difference;
}

/// Returns the difference of a check, or the computed value of a bound. The sign is reversed for a
/// lower bound. The worse of two checks therefore has the larger result.
double beyond(const Check& check) {
  const double number = judged_number(check).value_or(0);
  return check.tolerance && !check.tolerance->high ? -number : number;
}

}  // namespace

double difference_over_tolerance(const Check& check) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Number judged = judged_number(check);
  if (!check.tolerance || !judged) return infinity;
  const Tolerance& t = *check.tolerance;
  if (t.low && t.high) {
    const double half = 0.5 * (*t.high - *t.low);
    const double distance = std::abs(*judged - 0.5 * (*t.high + *t.low));
    if (half > 0) return distance / half;
    return distance == 0 ? 0 : infinity;
  }
  if (t.high && *t.high > 0) return std::abs(*judged) / *t.high;
  if (t.low && *t.low > 0) return *judged > 0 ? *t.low / *judged : infinity;
  return check.verdict == Verdict::pass ? 0 : infinity;
}

double size_of_difference(const Check& check) {
  const double target = check.measure == "ratio" ? 1 : 0;
  return std::abs(check.difference.value_or(target) - target);
}

bool is_worse_than(const Check& a, const Check& b) {
  if (severity(a) != severity(b)) return severity(a) > severity(b);
  if (a.is_known_discrepancy() && b.is_known_discrepancy())
    return size_of_difference(a) > size_of_difference(b);
  const double share_a = difference_over_tolerance(a), share_b = difference_over_tolerance(b);
  if (share_a != share_b) return share_a > share_b;
  return beyond(a) > beyond(b);  // decides if both tolerances are zero
}

const Check& CheckGroup::worst() const {
  return **std::ranges::min_element(
      checks, [](const Check* a, const Check* b) { return is_worse_than(*a, *b); });
}

std::vector<CheckGroup> group_checks(const Run& run) {
  std::vector<CheckGroup> groups;
  for (const Check& check : run.checks) {
    const auto same = [&](const CheckGroup& known) {
      return known.front().name == check.name && known.front().quantity == check.quantity;
    };
    harness::find_or_add(groups, same, {}).checks.push_back(&check);
  }
  return groups;
}

}  // namespace trammel::results
