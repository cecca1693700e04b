#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/base/quantity.h"
#include "harness/input/check.h"
#include "harness/input/reference_library.h"
#include "harness/judge/convergence.h"

/// Refinement sweeps: a computation repeated on successive levels.
namespace trammel::harness {

using results::Sweep;

/// Returns the element size h of a swept number, up to a common factor.
/// @param measures  meaning of the number: "elements" per length, "halvings" or "size"
[[nodiscard]] double element_size(const std::string& measures, double parameter);

/// Selection of the quantities of a sweep that are tracked.
enum class TrackedQuantities {
  named,  ///< quantities named by the sweep, else those named by the checks
  all     ///< every quantity that changes with the level
};

/// Removes quantities that are not tracked as `named`.
void drop_untracked(Sweep& sweep, const Document& document, const std::vector<Check>& checks);

/// Returns the convergence study of each tracked entry of a sweep.
/// @param element_order  order of another solver, which replaces the orders of the sweep
[[nodiscard]] std::vector<Convergence> study_sweep(const Sweep& sweep, const Document& document,
                                                   const std::vector<Check>& checks,
                                                   const References& references,
                                                   TrackedQuantities tracked,
                                                   results::Number element_order = {});

/// A quantity whose convergence along a sweep is studied, with the stored reference that gives its
/// exact values.
struct TrackedQuantity {
  std::string quantity, statistic;
  std::vector<std::size_t> index, reference_index;  ///< selected entries; empty: all
  const references::Reference* reference = nullptr;
  bool is_error = false;  ///< the values are themselves errors
  std::optional<double> theory = std::nullopt;
};

/// Returns the quantities named by the "quantities" of a sweep.
[[nodiscard]] std::vector<TrackedQuantity> quantities_of_sweep(const JsonView& quantities,
                                                               const References& references);

/// Returns the quantities of the checks, each once. A check with exact values precedes one without.
[[nodiscard]] std::vector<TrackedQuantity> quantities_of_checks(const Document& document,
                                                                const std::vector<Check>& checks,
                                                                const References& references);

/// Returns true if a reference can measure the discretization error: its kind is exact or computed.
[[nodiscard]] bool is_exact(const references::Reference& reference);

}  // namespace trammel::harness
