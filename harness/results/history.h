#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "harness/results/run_results.h"

/// What calls of the program came to over time.
namespace trammel::results {

struct HistoryCall {
  std::int64_t id = 0;
  std::string date, commit, machine;
  std::size_t runs = 0, checks = 0, failures = 0, work = 0;
  double cpu_s = 0;  ///< 0: not all of it was computed by this call
  [[nodiscard]] bool green() const { return failures == 0; }
};

/// Between the last green call before the newest one, and that.
struct HistoryChange {
  std::string name;  ///< run, check and entry; or run alone for its counted work
  std::string verdict_before, verdict;
  Number before, after;
  std::string commit, date;  ///< of the first call that had it
  [[nodiscard]] bool of_verdict() const { return verdict_before != verdict; }
};

/// A value that has gone one way in small steps, in at least three calls.
struct HistoryDrift {
  std::string name;
  std::size_t steps = 0;
  double first = 0, last = 0;
};

struct History {
  std::vector<HistoryCall> calls;      ///< oldest first
  std::int64_t since = 0;              ///< the green call that changes are counted from; 0: none
  std::vector<HistoryChange> changes;  ///< of verdicts first
  std::vector<HistoryChange> work;     ///< counted, exact
  std::vector<HistoryDrift> drifts;    ///< largest first
};

}  // namespace trammel::results
