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

}  // namespace trammel::harness
