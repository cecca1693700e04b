#include "harness/results/run_grade.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trammel::results {

Grade grade_of(const Run& run) {
  const auto has = [&](Verdict verdict) {
    return std::ranges::any_of(run.checks,
                               [&](const Check& check) { return check.verdict == verdict; });
  };
  if (run.status == Status::error) return Grade::broken;
  if (run.status == Status::crashed) return Grade::crashed;
  if (run.status == Status::timed_out) return Grade::timed_out;
  if (run.status == Status::cannot) return Grade::cannot;
  if (run.status == Status::not_exported) return Grade::not_exported;
  if (run.status == Status::not_run) return Grade::not_run;
  if (has(Verdict::fail)) return Grade::off;
  if (has(Verdict::error)) return Grade::broken;
  if (has(Verdict::pass)) return Grade::agrees;
  return has(Verdict::not_given) ? Grade::not_given : Grade::not_judged;
}

std::string to_string(Grade grade) {
  constexpr std::array<const char*, 10> texts = {
      "agrees", "off",          "broken",    "crashed",    "timed out",
      "cannot", "not exported", "not given", "not judged", "not run"};
  return texts.at(static_cast<std::size_t>(grade));
}

bool is_failure(Grade grade) {
  return grade == Grade::off || grade == Grade::broken || grade == Grade::crashed ||
         grade == Grade::timed_out;
}

double tolerance_share(const Check& check) {
  if (!check.difference || !check.tolerance) return 0;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double low = check.tolerance->low.value_or(-infinity),
               high = check.tolerance->high.value_or(infinity);
  const double half = (high - low) / 2, away = std::abs(*check.difference - (low + half));
  if (std::isfinite(half) && half > 0) return away / half;
  return check.verdict == Verdict::fail ? infinity : 0;
}

const Check* decisive_check(const Run& run) {
  const Check* telling = nullptr;
  const auto rank = [](const Check& check) {
    return std::pair(check.verdict == Verdict::fail, tolerance_share(check));
  };
  for (const Check& check : run.checks) {
    const bool judged = check.verdict == Verdict::pass || check.verdict == Verdict::fail;
    if (judged && (telling == nullptr || rank(check) > rank(*telling))) telling = &check;
  }
  return telling;
}

}  // namespace trammel::results
