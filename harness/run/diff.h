#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/input/document.h"
#include "harness/results/results.h"
#include "harness/results/side_comparison.h"

/// Compares the judgments in two results. The commands `compare`, `certify` and `history` show
/// selected rows.
namespace trammel::harness {

/// A run, or an entry of one of its checks.
struct Entry {
  std::string verdict;    ///< verdict of the check, or status of the run
  results::Number value;  ///< computed value
  double noise = 0;       ///< differences up to this value are round-off
  const results::Run* run = nullptr;
  const results::Check* check = nullptr;  ///< check of the entry; null: the entry is the run itself

  /// Returns true if the verdict differs, or the value by more than the noise of both.
  [[nodiscard]] bool differs(const Entry& other) const;
};

/// Entries by name: "case:variant", "case:variant check quantity[index] statistic". Checks that
/// report only their worst entry (bounds, comparisons with a variant) have no index.
using Entries = std::map<std::string, Entry>;

/// @param name  name of the run
void add_entries(const results::Run& run, const std::string& name, Entries& entries);
/// Returns entries that point into the results.
[[nodiscard]] Entries entries_of(const results::Results& results);
/// Returns "case:variant".
[[nodiscard]] std::string name_of(const results::Run& run);

/// The same entry in two results; null in a result without this entry.
struct DiffRow {
  std::string name;
  const Entry *before = nullptr, *after = nullptr;

  [[nodiscard]] bool in_both() const { return before != nullptr && after != nullptr; }
  [[nodiscard]] bool is_run() const { return (before ? before : after)->check == nullptr; }
};

/// Returns all entries of both results by name. A run precedes its checks.
[[nodiscard]] std::vector<DiffRow> pair_entries(const Entries& before, const Entries& after);

/// One side of a comparison: results of runs.
struct Side {
  std::string label;
  results::Results results;
  /// Set for a single run of a variant computed now. Such runs are compared in spite of different
  /// names, and their mode shapes are compared at stations along the members. Otherwise, runs of
  /// the same name are compared, and mode shapes are compared by the drawings.
  std::optional<Document> document;
};

/// Compares all sides with the first. Round-off is the value stated by refinements and checks, and
/// at least 1e-9 of the largest number of its series.
/// @param series  keeps the series and drawings of the runs with the largest changes
[[nodiscard]] results::SideComparison compare_sides(std::vector<Side> sides, bool series);

}  // namespace trammel::harness
