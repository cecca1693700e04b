#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/input/check.h"
#include "harness/input/reference_library.h"

/// Which quantities a refinement follows, and where their exact values stand.
namespace trammel::harness {

struct TrackedQuantity {
  std::string quantity, statistic;
  std::vector<std::size_t> index, reference_index;  ///< empty: all
  const references::Reference* reference = nullptr;
  bool is_error = false;  ///< the values are errors themselves
  std::optional<double> theory = std::nullopt;
};

/// What the "quantities" of a sweep name.
[[nodiscard]] std::vector<TrackedQuantity> named_by_sweep(const JsonView& quantities,
                                                          const References& references);

/// What the checks look at, each once; a check with exact values before one without.
[[nodiscard]] std::vector<TrackedQuantity> named_by_checks(const Document& document,
                                                           const std::vector<Check>& checks,
                                                           const References& references);

/// Whether a reference tells the discretisation error: of kind exact or computed.
[[nodiscard]] bool is_exact(const references::Reference& reference);

}  // namespace trammel::harness
