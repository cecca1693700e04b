#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/input/document.h"
#include "harness/results/results.h"
#include "harness/results/side_comparison.h"

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

/// One side: what runs came to.
struct Side {
  std::string label;
  results::Results results;
  /// Of the one run of a variant computed now, which stands beside those of other names and whose
  /// modes are told apart at stations along its members; otherwise runs of one name stand beside
  /// each other, and modes are told apart by what is drawn of them.
  std::optional<Document> document;
};

/// All sides against the first. Round-off is what refinements and checks state of a number, and at
/// least 1e-9 of the largest number of its series.
/// @param series  keeps the series and drawings of the runs that change most
[[nodiscard]] results::SideComparison compare_sides(std::vector<Side> sides, bool series);

}  // namespace trammel::harness
