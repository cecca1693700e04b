#pragma once

#include <string>
#include <vector>

#include "harness/results/results.h"

/// Several sides beside each other, number by number: variants, cases, or results of other days,
/// machines and codes. Every list of values has one entry a side.
namespace trammel::results {

/// What one number, or the frequency of a set of modes, comes to on each side.
struct ComparedValue {
  Numbers values;        ///< empty where a side has none
  Numbers percent;       ///< of the first side; empty where that is zero but for round-off
  double noise = 0;      ///< a difference up to it is round-off
  double share = 0;      ///< largest difference from the first side over the largest of its series
  bool changed = false;  ///< beyond the noise
};

/// An entry of a quantity: each of a few, of many the one that differs most.
struct ComparedNumber : ComparedValue {
  std::string quantity;
  std::size_t index = 0, entries = 1;  ///< from 0; of so many
};

/// A set of modes of the first side, and those of the others that look alike.
struct ComparedModes : ComparedValue {
  std::vector<std::vector<std::size_t>> modes;  ///< from 1; empty: no mode looks alike
  Numbers last;                                 ///< frequencies where a set has come apart
  Numbers alike;                                ///< 1: the same shape
};

struct ComparedRun {
  std::string name;
  std::vector<ComparedNumber> numbers;  ///< that change most first
  std::vector<ComparedModes> modes;
  std::vector<std::string> remarks;  ///< what only some sides have; verdicts that changed
  double share = 0;                  ///< the largest
  bool changed = false;
  CaseInfo info;          ///< of the first side; not written
  std::vector<Run> runs;  ///< with their series where they are to be drawn; not written
};

struct ComparedSide {
  std::string label, commit, date, processor, solver;
  std::size_t runs = 0;
  /// Of the runs that all sides have.
  double cpu_s = 0;
  std::size_t work = 0;                ///< element evaluations, factorizations, solves and steps
  Number relative_time;                ///< of the first side's
  Number median_error, largest_error;  ///< relative, of what references are there for on all sides
};

struct SideComparison {
  std::string conclusion;
  std::vector<ComparedSide> sides;
  std::size_t same = 0, within_noise = 0, changed = 0;  ///< runs; same: bit for bit
  std::vector<ComparedRun> runs;  ///< that are not the same, the ones that change most first
};

}  // namespace trammel::results
