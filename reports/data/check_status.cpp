#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "reports/data/check_text.h"

namespace trammel::reports {

const StatusStyle& find_style(CheckStatus status) {
  return *std::ranges::find(kStatusStyles, status, &StatusStyle::status);
}

bool is_failure(CheckStatus status) {
  return status == CheckStatus::fails || status == CheckStatus::changed_discrepancy ||
         status == CheckStatus::error;
}

CheckStatus find_status(const Check& check) {
  switch (check.verdict) {
    case Verdict::pass:
      return check.is_known_discrepancy() ? CheckStatus::known_discrepancy : CheckStatus::passes;
    case Verdict::fail:
      return check.is_known_discrepancy() ? CheckStatus::changed_discrepancy : CheckStatus::fails;
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

CheckStatus find_status(const Run& run) {
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

const Comparison* find_comparison(const Run& run, const Check& check) {
  if (!run.uncertainty) return nullptr;
  for (const Comparison& c : run.uncertainty->comparisons)
    if (c.check == check.name && c.quantity == check.quantity &&
        c.index == check.index.value_or(0) && c.u_val)
      return &c;
  return nullptr;
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

void add_check_counts(Counts& counts, const Run& run) {
  for (const CheckGroup& group : group_checks(run)) ++counts[find_status(group.worst())];
}

bool all_checks_pass(const Counts& counts) {
  return std::ranges::none_of(counts, [](const auto& item) { return is_failure(item.first); });
}

}  // namespace trammel::reports
