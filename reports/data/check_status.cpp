#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "harness/base/find_or_add.h"
#include "reports/data/check_text.h"

namespace trammel::reports {

const StatusStyle& style_of(CheckStatus status) {
  return *std::ranges::find(kStatusStyles, status, &StatusStyle::status);
}

bool is_failure(CheckStatus status) {
  return status == CheckStatus::fails || status == CheckStatus::changed_discrepancy ||
         status == CheckStatus::error;
}

CheckStatus check_status(const Check& check) {
  switch (check.verdict) {
    case Verdict::pass:
      return check.known_discrepancy() ? CheckStatus::known_discrepancy : CheckStatus::passes;
    case Verdict::fail:
      return check.known_discrepancy() ? CheckStatus::changed_discrepancy : CheckStatus::fails;
    case Verdict::error:
      return CheckStatus::error;
    case Verdict::not_run:
      return CheckStatus::not_run;
    case Verdict::recorded:
      return CheckStatus::not_judged;
    case Verdict::not_given:
      return CheckStatus::not_given;
  }
  throw std::logic_error("unknown verdict");
}

CheckStatus check_status(const Run& run) {
  const bool expected = !run.checks.empty() && std::ranges::all_of(run.checks, [](const Check& c) {
    return c.verdict == Verdict::pass;
  });
  switch (run.status) {
    case Status::solved:
      return CheckStatus::passes;
    case Status::singular:
    case Status::not_converged:
      return expected ? CheckStatus::passes : CheckStatus::fails;
    case Status::error:
    case Status::crashed:
    case Status::timed_out:
      return CheckStatus::error;
    case Status::not_run:
      return CheckStatus::not_run;
    case Status::cannot:
    case Status::not_exported:
      return CheckStatus::not_given;
  }
  throw std::logic_error("unknown status");
}

double tolerance_fraction(const Check& check) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Number& judged = check.measure == "bound" ? check.computed : check.difference;
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

const Comparison* find_comparison(const Run& run, const Check& check) {
  if (!run.uncertainty) return nullptr;
  for (const Comparison& c : run.uncertainty->comparisons)
    if (c.check == check.name && c.quantity == check.quantity &&
        c.index == check.index.value_or(0) && c.u_val)
      return &c;
  return nullptr;
}

double size_of_difference(const Check& check) {
  const double target = check.measure == "ratio" ? 1 : 0;
  return std::abs(check.difference.value_or(target) - target);
}

bool worse(const Check& a, const Check& b) {
  const int sa = style_of(check_status(a)).severity;
  const int sb = style_of(check_status(b)).severity;
  if (sa != sb) return sa > sb;
  if (a.known_discrepancy() && b.known_discrepancy())
    return size_of_difference(a) > size_of_difference(b);
  return tolerance_fraction(a) > tolerance_fraction(b);
}

const Check& CheckGroup::worst() const {
  return **std::ranges::min_element(checks,
                                    [](const Check* a, const Check* b) { return worse(*a, *b); });
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

std::size_t count_of(const Counts& counts, CheckStatus status) {
  const auto found = counts.find(status);
  return found == counts.end() ? 0 : found->second;
}

std::size_t total(const Counts& counts) {
  std::size_t sum = 0;
  for (const auto& [_, n] : counts) sum += n;
  return sum;
}

void add(Counts& counts, const Run& run) {
  for (const CheckGroup& group : group_checks(run)) ++counts[check_status(group.worst())];
}

bool all_checks_pass(const Counts& counts) {
  return std::ranges::none_of(counts, [](const auto& item) { return is_failure(item.first); });
}

}  // namespace trammel::reports
