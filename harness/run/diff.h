#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/input/document.h"
#include "harness/results/results.h"
#include "harness/results/side_comparison.h"

/// Compares verdicts and numbers of two sets of results. The commands `compare`, `certify` and
/// `history` print the result.
namespace trammel::harness {

/// Compared item of two sets of results: a run, or one judged number of a check.
struct Entry {
  std::string verdict;    ///< verdict of the check, or status of the run
  results::Number value;  ///< computed value
  double noise = 0;       ///< differences up to this value are round-off
  const results::Run* run = nullptr;
  const results::Check* check = nullptr;  ///< check of the entry; null: the entry is a run

  /// Returns true if the verdicts differ, or if the values differ by more than the larger `noise`
  /// of both entries.
  [[nodiscard]] bool differs(const Entry& other) const;
};

/// Entries by name: "case:variant", "case:variant check quantity[index] statistic". Checks that
/// report only their worst entry (bounds, comparisons with a variant) have no index.
using Entries = std::map<std::string, Entry>;

/// Adds entries for a run and for each judged number of the run's checks.
/// @param name  name of the run, such as "case:variant"
void add_entries_of_run(const results::Run& run, const std::string& name, Entries& entries);
/// Returns all entries of the results, which must outlive the entries.
[[nodiscard]] Entries all_entries(const results::Results& results);
/// Returns the name of a run: "case:variant".
[[nodiscard]] std::string name_of(const results::Run& run);

/// The same entry in two sets of results. The pointer to an entry is null if its set does not
/// contain the entry.
struct DiffRow {
  std::string name;
  const Entry *before = nullptr, *after = nullptr;

  [[nodiscard]] bool is_in_both() const { return before != nullptr && after != nullptr; }
  [[nodiscard]] bool is_run() const { return (before ? before : after)->check == nullptr; }
};

/// Pairs the entries of two sets of results by name. The row of a run precedes the rows of its
/// checks.
[[nodiscard]] std::vector<DiffRow> pair_entries(const Entries& before, const Entries& after);

/// Results of runs that form one side of a comparison, such as one variant, date or solver.
struct Side {
  std::string label;
  results::Results results;
  /// Case of a single run that this call of the program has computed; empty for stored results.
  /// Computed runs are compared even if their names differ, and their mode shapes are compared at
  /// stations along the members. Stored runs are compared only if their names are equal, and their
  /// mode shapes are compared at the nodes of the drawings.
  std::optional<Document> document;
};

/// Compares all sets of results (sides) with the first one. Differences up to the round-off error
/// are ignored. This error is read from the runs, but is at least 1e-9 of the largest value of all
/// quantities with the same unit.
/// @param series  if true, the result contains all values over time or a path for the runs with the
///   largest changes
[[nodiscard]] results::SideComparison compare_sides(std::vector<Side> sides, bool series);

}  // namespace trammel::harness
