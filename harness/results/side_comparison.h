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
  Numbers values;  ///< value in each set of results (side); missing if the set has no value
  /// Change from the value in the first set of results [%]; missing if that value is zero up to
  /// round-off.
  Numbers percent;
  /// Estimated discretization error of the value in each set of results (side): half-width of the
  /// error band [unit]. Missing if the run has no estimate.
  Numbers errors;
  double noise = 0;  ///< differences up to this value are round-off
  /// Largest difference from the first set of results, relative to the largest value of all
  /// quantities with the same unit.
  double share = 0;
  bool changed = false;  ///< true if the largest difference exceeds `noise`
};

/// A compared entry of a quantity. All entries of a short quantity are compared, but only the entry
/// with the largest difference of a long quantity.
struct ComparedNumber : ComparedValue {
  std::string quantity;
  std::size_t index = 0, entries = 1;  ///< index from 0; number of entries of the quantity
};

/// A set of modes in the first set of results (side), and the modes of similar shape in the other
/// sets.
struct ComparedModes : ComparedValue {
  /// Mode numbers (from 1) in each set of results (side); empty: no mode of that set has a similar
  /// shape.
  std::vector<std::vector<std::size_t>> modes;
  Numbers last;   ///< highest frequency of the modes on each side, if a repeated frequency splits
  Numbers alike;  ///< similarity of the mode shapes; 1: identical
};

struct ComparedRun {
  std::string name;
  std::vector<ComparedNumber> numbers;  ///< compared numbers, largest change first
  std::vector<ComparedModes> modes;
  std::vector<std::string> remarks;  ///< texts about missing quantities and changed verdicts
  double share = 0;                  ///< largest `share` of the compared numbers
  bool changed = false;
  CaseInfo info;          ///< case of the first set of results; not written to JSON
  std::vector<Run> runs;  ///< run in each set of results (side); not written to JSON
};

struct ComparedSide {
  std::string label, commit, date, processor, solver;
  std::size_t runs = 0;
  /// Processor time and counted work of one set of results (side), summed over the runs that all
  /// sets contain.
  double cpu_s = 0;
  std::size_t work = 0;  ///< element evaluations, factorizations, solves and steps
  /// Processor time relative to that of the first set of results.
  Number relative_time;
  /// Errors relative to the reference values that all sides have.
  Number median_error, largest_error;
};

struct SideComparison {
  std::string conclusion;
  std::vector<ComparedSide> sides;
  /// Numbers of runs; same: runs whose results are equal to the last bit.
  std::size_t same = 0, within_noise = 0, changed = 0;
  std::vector<ComparedRun> runs;  ///< runs that differ, largest change first
};

}  // namespace trammel::results
