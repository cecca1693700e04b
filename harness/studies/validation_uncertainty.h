#pragma once

#include <optional>
#include <vector>

#include "harness/analysis/analysis.h"
#include "harness/input/check.h"
#include "harness/judge/input_uncertainty.h"
#include "harness/judge/sweep.h"

/// Validation comparison of ASME V&V 20-2009 for the checks of a run with the role "validation".
/// The key "uncertainty" of a case requests it. The difference has contributions of the
/// discretization, the printed digits of the inputs, those of the reference, and the model.
namespace trammel::harness {

/// Returns the inputs of a case or variant that has "uncertainty". Inputs that are only described
/// in words are omitted.
/// @throws InputError  if a pointer is invalid.
[[nodiscard]] std::vector<results::UncertainInput> stated_inputs(const Document& document,
                                                                 const References& references);

/// Evaluates the uncertainty.
/// @param document    case or variant that has "uncertainty"
/// @param quantities  of its solution
/// @param errors      of its discretization.
/// @returns nothing if no check compares anything.
/// @throws InputError  if a pointer or a patched model is invalid.
[[nodiscard]] std::optional<results::Uncertainty> evaluate_validation_uncertainty(
    const Document& document, const Quantities& quantities, const std::vector<Check>& checks,
    const results::ErrorEstimates& errors, const References& references);

/// Computes all levels of all sweeps of a case or variant.
/// @throws InputError  if the values are not ordered from coarse to fine.
[[nodiscard]] std::vector<Sweep> run_sweeps(const Document& document, const References& references);

}  // namespace trammel::harness
