#include "reports/data/check_status.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace trammel::reports {

namespace {

struct Name {
  Standing standing;
  const char *words, *css, *sign;
};

constexpr std::array<Name, 6> names = {{
    {Standing::holds, "holds", "holds", "✓"},
    {Standing::known, "known discrepancy", "known", "≠"},
    {Standing::recorded, "recorded only", "recorded", "○"},
    {Standing::fails, "fails", "fails", "✗"},
    {Standing::error, "error", "error", "!"},
    {Standing::not_run, "not run", "not-run", "–"},
}};

const Name& name_of(Standing standing) {
  for (const Name& name : names)
    if (name.standing == standing) return name;
  throw std::logic_error("unknown standing");
}

int severity(Standing standing) {
  switch (standing) {
    case Standing::error:
      return 5;
    case Standing::fails:
      return 4;
    case Standing::not_run:
      return 3;
    case Standing::recorded:
      return 2;
    case Standing::known:
      return 1;
    case Standing::holds:
      return 0;
  }
  return 0;
}

}  // namespace

Standing standing(const Check& check) {
  switch (check.verdict) {
    case Verdict::pass:
      return check.known_discrepancy ? Standing::known : Standing::holds;
    case Verdict::fail:
      return Standing::fails;
    case Verdict::error:
      return Standing::error;
    case Verdict::not_run:
      return Standing::not_run;
    case Verdict::recorded:
      return Standing::recorded;
  }
  throw std::logic_error("unknown verdict");
}

Standing standing(const Run& run) {
  const bool expected =
      !run.checks.empty() && std::all_of(run.checks.begin(), run.checks.end(),
                                         [](const Check& c) { return c.verdict == Verdict::pass; });
  switch (run.status) {
    case Status::solved:
      return Standing::holds;
    case Status::singular:
    case Status::not_converged:
      return expected ? Standing::holds : Standing::fails;
    case Status::error:
      return Standing::error;
    case Status::not_run:
      return Standing::not_run;
  }
  throw std::logic_error("unknown status");
}

std::string in_words(Standing standing) {
  return name_of(standing).words;
}
std::string css_class(Standing standing) {
  return name_of(standing).css;
}
std::string sign(Standing standing) {
  return name_of(standing).sign;
}

double tolerance_used(const Check& check) {
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
  const int sa = severity(standing(a));
  const int sb = severity(standing(b));
  return sa != sb ? sa > sb : tolerance_used(a) > tolerance_used(b);
}

const Check& CheckGroup::worst() const {
  return **std::min_element(checks.begin(), checks.end(),
                            [](const Check* a, const Check* b) { return worse(*a, *b); });
}

std::vector<CheckGroup> group_checks(const Run& run) {
  std::vector<CheckGroup> groups;
  for (const Check& check : run.checks) {
    auto group = std::find_if(groups.begin(), groups.end(), [&](const CheckGroup& known) {
      return known.front().name == check.name && known.front().quantity == check.quantity;
    });
    if (group == groups.end()) group = groups.insert(groups.end(), CheckGroup{&run, {}});
    group->checks.push_back(&check);
  }
  return groups;
}

std::size_t count_of(const Counts& counts, Standing standing) {
  const auto found = counts.find(standing);
  return found == counts.end() ? 0 : found->second;
}

std::size_t total(const Counts& counts) {
  std::size_t sum = 0;
  for (const auto& [_, n] : counts) sum += n;
  return sum;
}

void add(Counts& counts, const Run& run) {
  for (const Check& check : run.checks) ++counts[standing(check)];
}

bool gate_holds(const Counts& counts) {
  return count_of(counts, Standing::fails) + count_of(counts, Standing::error) == 0;
}

}  // namespace trammel::reports
