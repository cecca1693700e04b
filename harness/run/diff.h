#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/results/results.h"

/// The one comparison of what was judged in two results. `compare`, `certify` and `history` select
/// from its rows.
namespace trammel::harness {

/// A run, or an entry of one of its checks.
struct Entry {
  std::string verdict;    ///< of the check, or the status of the run
  results::Number value;  ///< that was computed
  double noise = 0;       ///< a difference up to it is round-off
  const results::Run* run = nullptr;
  const results::Check* check = nullptr;  ///< null: the run itself

  /// Returns whether the verdict differs, or the value by more than the noise of both.
  [[nodiscard]] bool differs(const Entry& other) const;
};

/// By name: "case:variant", "case:variant check quantity[index] statistic". Checks that report only
/// the worst of their entries (bounds, comparisons with a variant) have no index.
using Entries = std::map<std::string, Entry>;

/// @param name  of the run
void add_entries(const results::Run& run, const std::string& name, Entries& entries);
/// Entries point into the results.
[[nodiscard]] Entries entries_of(const results::Results& results);
/// "case:variant"
[[nodiscard]] std::string name_of(const results::Run& run);

/// An entry in both results; null if one lacks it.
struct DiffRow {
  std::string name;
  const Entry *before = nullptr, *after = nullptr;

  [[nodiscard]] bool in_both() const { return before != nullptr && after != nullptr; }
  [[nodiscard]] bool is_run() const { return (before ? before : after)->check == nullptr; }
};

/// All entries of both, by name: a run comes before its checks.
[[nodiscard]] std::vector<DiffRow> diff(const Entries& before, const Entries& after);

}  // namespace trammel::harness
