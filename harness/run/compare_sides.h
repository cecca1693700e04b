#pragma once

#include <string>
#include <vector>

#include "harness/input/document.h"
#include "harness/results/side_comparison.h"

namespace trammel::harness {

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
