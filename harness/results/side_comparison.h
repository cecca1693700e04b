#pragma once

#include <string>
#include <vector>

#include "harness/results/results.h"

/// Comparison of several sets of results (sides), number by number. Each side contains the results
/// of one variant, case, date, machine or code. Every list of values has one entry per side.
namespace trammel::results {

/// Values of one number, or of the frequency of a set of modes, in each compared set of results
/// (side).
struct ComparedValue {
  Numbers values;  ///< value on each side; missing if the side has no value
  /// Change from the value on the first side [%]; missing if that value is zero up to round-off.
  Numbers percent;
  /// Estimated discretization error of the value on each side: half-width of the error band [unit].
  /// Missing if the run has no estimate.
  Numbers errors;
  double noise = 0;  ///< differences up to this value are round-off
  /// Largest difference from the first side, relative to the largest value of all quantities with
  /// the same unit.
  double share = 0;
  bool changed = false;  ///< true if the largest difference exceeds `noise`
};

/// A compared entry of a quantity. All entries of a short quantity are compared, but only the entry
/// with the largest difference of a long quantity.
struct ComparedNumber : ComparedValue {
  std::string quantity;
  std::size_t index = 0, entries = 1;  ///< index from 0; number of entries of the quantity
};

/// A set of modes of the first side, and the modes of the other sides with a similar shape.
struct ComparedModes : ComparedValue {
  /// Mode numbers (from 1) on each side; empty: no mode of the side has a similar shape.
  std::vector<std::vector<std::size_t>> modes;
  Numbers last;   ///< highest frequency on each side, if a set of equal frequencies splits
  Numbers alike;  ///< similarity of the mode shapes; 1: identical
};

struct ComparedRun {
  std::string name;
  std::vector<ComparedNumber> numbers;  ///< compared numbers, largest change first
  std::vector<ComparedModes> modes;
  std::vector<std::string> remarks;  ///< texts about missing quantities and changed verdicts
  double share = 0;                  ///< largest `share` of the compared numbers
  bool changed = false;
  CaseInfo info;          ///< case of the first side; not written to JSON
  std::vector<Run> runs;  ///< run of each side; not written to JSON
};

struct ComparedSide {
  std::string label, commit, date, processor, solver;
  std::size_t runs = 0;
  /// Processor time and counted work of one side, summed over the runs that all sides contain.
  double cpu_s = 0;
  std::size_t work = 0;                ///< element evaluations, factorizations, solves and steps
  Number relative_time;                ///< processor time relative to the first side
  Number median_error, largest_error;  ///< relative errors of references that all sides use
};

struct SideComparison {
  std::string conclusion;
  std::vector<ComparedSide> sides;
  std::size_t same = 0, within_noise = 0, changed = 0;  ///< numbers of runs; same: equal bits
  std::vector<ComparedRun> runs;                        ///< runs that differ, largest change first
};

}  // namespace trammel::results
