#pragma once

#include <optional>
#include <vector>

#include "harness/analysis/analysis.h"
#include "harness/input/check.h"
#include "harness/judge/input_uncertainty.h"
#include "harness/judge/sweep.h"

/// Validation comparison of ASME V&V 20-2009 for the checks of a run with the role "validation".
/// The key "uncertainty" of a case requests this comparison. The difference between computed and
/// printed value has contributions of the discretization, of the printed digits of inputs and
/// reference, and of the model.
namespace trammel::harness {

/// Returns the uncertain inputs of a case or variant with the key "uncertainty". Inputs that are
/// not numbers in the case or variant are omitted.
/// @throws InputError  if a pointer is invalid.
[[nodiscard]] std::vector<results::UncertainInput> uncertain_inputs(const Document& document,
                                                                    const References& references);

/// Evaluates the validation uncertainty of the compared quantities.
/// @param document    case or variant with the key "uncertainty"
/// @param quantities  quantities of the solution
/// @param errors      estimated discretization errors of the quantities.
/// @returns nothing if no validation check compares a quantity with a reference.
/// @throws InputError  if a pointer or a patched model is invalid.
[[nodiscard]] std::optional<results::Uncertainty> evaluate_validation_uncertainty(
    const Document& document, const Quantities& quantities, const std::vector<Check>& checks,
    const results::ErrorEstimates& errors, const References& references);

/// Computes all levels of all refinement sweeps of a case or variant.
/// @throws InputError  if the values are not ordered from coarse to fine.
[[nodiscard]] std::vector<Sweep> run_sweep_levels(const Document& document,
                                                  const References& references);

}  // namespace trammel::harness
