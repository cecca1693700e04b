#pragma once

#include <array>
#include <string>

#include "harness/results/run_results.h"

/// A run in one word, for codes side by side.
namespace trammel::results {

/// broken: an answer that cannot be judged. not_exported: the protocol does not carry the case.
/// not_judged: nothing of it has a gate.
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
/// Whether it counts against the code: off, broken, crashed or timed out.
[[nodiscard]] bool is_failure(Grade grade);

/// The check that says most: one that fails, else the judged one that uses most of its tolerance;
/// null where none has a difference.
[[nodiscard]] const Check* telling_check(const Run& run);

/// Share of the tolerance that a check's difference uses; 0 where it has none.
[[nodiscard]] double tolerance_share(const Check& check);

}  // namespace trammel::results
