#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/base/quantity.h"
#include "harness/input/check.h"
#include "harness/input/reference_library.h"
#include "harness/judge/convergence.h"

/// Refinement sweeps: the same computation level by level.
namespace trammel::harness {

using results::Sweep;

/// Element size h of a swept number, to a common factor.
/// @param measures  what the number is: "elements" a length, "halvings" or "size"
[[nodiscard]] double element_size(const std::string& measures, double parameter);

/// Which quantities of a sweep are followed.
enum class TrackedQuantities {
  named,  ///< those that the sweep names, else those that the checks name
  all     ///< every one that changes with the level
};

/// Removes quantities that are not tracked as `named`.
void drop_untracked(Sweep& sweep, const Document& document, const std::vector<Check>& checks);

/// @param element_order  of another solver, in place of the orders of the sweep
[[nodiscard]] std::vector<Convergence> study_sweep(const Sweep& sweep, const Document& document,
                                                   const std::vector<Check>& checks,
                                                   const References& references,
                                                   TrackedQuantities tracked,
                                                   results::Number element_order = {});

/// Which quantities a refinement follows, and where their exact values stand.

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
