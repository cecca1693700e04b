#pragma once

#include <array>
#include <string>

#include "harness/results/run_results.h"

/// Grade of a run in one word, for the comparison of codes.
namespace trammel::results {

/// off: a check fails. broken: the answer cannot be judged. cannot: the code does not support the
/// case. not_exported: the protocol does not support the case. not_given: the code does not compute
/// the quantities. not_judged: no check passes or fails.
enum class Grade {
  agrees,
  off,
  broken,
  crashed,
  timed_out,
  cannot,
  not_exported,
  not_given,
  not_judged,
  not_run
};
inline constexpr std::array<Grade, 10> kAllGrades = {
    Grade::agrees, Grade::off,          Grade::broken,    Grade::crashed,    Grade::timed_out,
    Grade::cannot, Grade::not_exported, Grade::not_given, Grade::not_judged, Grade::not_run};

[[nodiscard]] Grade grade_of(const Run& run);
/// "agrees", "off", "broken", "crashed", "timed out", "cannot", ...
[[nodiscard]] std::string to_string(Grade grade);
/// Returns true if the grade counts against the code: off, broken, crashed or timed out.
[[nodiscard]] bool is_failure(Grade grade);

/// Returns the most informative check: a failing one, else one with a difference, of these the most
/// severe; null if no check is judged.
[[nodiscard]] const Check* decisive_check(const Run& run);

}  // namespace trammel::results
