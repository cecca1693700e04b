#include "harness/results/run_grade.h"

#include <algorithm>

#include "harness/base/find_or_add.h"
#include "harness/results/check_groups.h"

namespace trammel::results {

Grade grade_of_run(const Run& run) {
  const auto has = [&](Verdict verdict) {
    return harness::contains(run.checks, verdict, &Check::verdict);
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

const Check* decisive_check(const Run& run) {
  const Check* decisive = nullptr;
  const auto rank = [](const Check& check) {
    return std::pair(check.verdict == Verdict::fail, check.difference.has_value());
  };
  for (const Check& check : run.checks) {
    if (check.verdict != Verdict::pass && check.verdict != Verdict::fail) continue;
    if (decisive == nullptr || rank(check) > rank(*decisive) ||
        (rank(check) == rank(*decisive) && is_worse_than(check, *decisive)))
      decisive = &check;
  }
  return decisive;
}

}  // namespace trammel::results
