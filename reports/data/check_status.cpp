#include "reports/data/check_status.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace trammel::reports {

namespace {

struct StatusText {
  CheckStatus status;
  const char *words, *css, *sign;
};

constexpr std::array<StatusText, 7> kStatusTexts = {{
    {CheckStatus::passes, "passes", "passes", "✓"},
    {CheckStatus::known_discrepancy, "does not agree (known)", "known-discrepancy", "≠"},
    {CheckStatus::not_judged, "not judged", "not-judged", "○"},
    {CheckStatus::fails, "fails", "fails", "✗"},
    {CheckStatus::error, "error", "error", "!"},
    {CheckStatus::not_run, "not run", "not-run", "–"},
    {CheckStatus::not_given, "not given", "not-run", "·"},
}};

const StatusText& text_of(CheckStatus status) {
  for (const StatusText& name : kStatusTexts)
    if (name.status == status) return name;
  throw std::logic_error("unknown status");
}

}  // namespace

int severity(CheckStatus status) {
  switch (status) {
    case CheckStatus::error:
      return 5;
    case CheckStatus::fails:
      return 4;
    case CheckStatus::not_run:
    case CheckStatus::not_given:
      return 3;
    case CheckStatus::not_judged:
      return 2;
    case CheckStatus::known_discrepancy:
      return 1;
    case CheckStatus::passes:
      return 0;
  }
  return 0;
}

CheckStatus check_status(const Check& check) {
  switch (check.verdict) {
    case Verdict::pass:
      return check.known_discrepancy() ? CheckStatus::known_discrepancy : CheckStatus::passes;
    case Verdict::fail:
      return CheckStatus::fails;
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

std::string to_text(CheckStatus status) {
  return text_of(status).words;
}
std::string css_class(CheckStatus status) {
  return text_of(status).css;
}
std::string sign(CheckStatus status) {
  return text_of(status).sign;
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

bool worse(const Check& a, const Check& b) {
  const int sa = severity(check_status(a));
  const int sb = severity(check_status(b));
  return sa != sb ? sa > sb : tolerance_fraction(a) > tolerance_fraction(b);
}

const Check& CheckGroup::worst() const {
  return **std::ranges::min_element(checks,
                                    [](const Check* a, const Check* b) { return worse(*a, *b); });
}

std::vector<CheckGroup> group_checks(const Run& run) {
  std::vector<CheckGroup> groups;
  for (const Check& check : run.checks) {
    auto group = std::ranges::find_if(groups, [&](const CheckGroup& known) {
      return known.front().name == check.name && known.front().quantity == check.quantity;
    });
    if (group == groups.end()) group = groups.insert(groups.end(), CheckGroup{&run, {}});
    group->checks.push_back(&check);
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
  for (const Check& check : run.checks) ++counts[check_status(check)];
}

bool all_checks_pass(const Counts& counts) {
  return count_of(counts, CheckStatus::fails) + count_of(counts, CheckStatus::error) == 0;
}

}  // namespace trammel::reports
