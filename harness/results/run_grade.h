#pragma once

#include <array>
#include <string>

#include "harness/results/run_results.h"

/// Grade of a run in one word, for the comparison of finite element codes.
namespace trammel::results {

/// agrees: all judged checks pass. off: a check fails. broken: the answer of the code is invalid,
/// or a check ends with an error. crashed, timed_out: the code ended without an answer.
/// cannot: the code does not support the case. not_exported: the export format does not support the
/// case. not_given: the code does not compute the quantities. not_judged: no check passes or fails.
/// not_run: the code was not called.
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

[[nodiscard]] Grade grade_of_run(const Run& run);
/// Returns the grade as text: "agrees", "off", "broken", "crashed", "timed out", "cannot", ...
[[nodiscard]] std::string to_string(Grade grade);
/// Returns true if the grade counts against the code: off, broken, crashed or timed out.
[[nodiscard]] bool is_failure(Grade grade);

/// Returns the most informative check of a run. Failing checks come first, then checks with a
/// difference, then the most severe check. Returns null if no check passes or fails.
[[nodiscard]] const Check* decisive_check(const Run& run);

}  // namespace trammel::results
