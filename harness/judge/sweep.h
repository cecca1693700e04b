#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/base/quantity.h"
#include "harness/input/check.h"
#include "harness/input/reference_library.h"
#include "harness/judge/convergence.h"

/// Refinement sweeps: a computation is repeated with successively finer discretizations (levels).
namespace trammel::harness {

using results::Sweep;

/// Returns the element size h for a value of the refined parameter, up to a common factor.
/// @param parameter_meaning  meaning of the parameter: "elements" per length, "halvings" of h, or
///   "size"
[[nodiscard]] double element_size(const std::string& parameter_meaning, double parameter);

/// Selection of the quantities of a sweep whose convergence is studied (tracked quantities).
enum class TrackedQuantities {
  named,  ///< quantities that the sweep lists, else quantities of the checks
  all     ///< every quantity that changes with the level
};

/// Removes from a sweep all quantities that TrackedQuantities::named does not select.
void drop_other_values(Sweep& sweep, const Document& document, const std::vector<Check>& checks);

/// Returns one convergence study for each entry of the tracked quantities of a sweep.
/// @param element_order  order of convergence of another solver's elements, which replaces the
///   theoretical order
[[nodiscard]] std::vector<Convergence> sweep_convergence(
    const Sweep& sweep, const Document& document, const std::vector<Check>& checks,
    const References& references, TrackedQuantities tracked, results::Number element_order = {});

/// A quantity whose convergence along a sweep is studied, with the stored reference that gives its
/// exact values.
struct TrackedQuantity {
  std::string quantity, statistic;
  std::vector<std::size_t> index, reference_index;  ///< selected entries; empty: all entries
  const references::Reference* reference = nullptr;
  bool is_error = false;  ///< true: the values of the quantity are errors
  std::optional<double> theory = std::nullopt;
};

/// Returns the quantities that the key "quantities" of a sweep lists.
[[nodiscard]] std::vector<TrackedQuantity> quantities_of_sweep(const JsonView& quantities,
                                                               const References& references);

/// Returns the quantities of the checks, each once. Of several checks of the same quantity, one
/// with an exact reference is preferred.
[[nodiscard]] std::vector<TrackedQuantity> quantities_of_checks(const Document& document,
                                                                const std::vector<Check>& checks,
                                                                const References& references);

/// Returns true if the discretization error can be measured against a reference, which must be of
/// the kind proved, exact or computed.
[[nodiscard]] bool is_exact(const references::Reference& reference);

}  // namespace trammel::harness
