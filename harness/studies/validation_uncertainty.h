#pragma once

#include <optional>
#include <vector>

#include "harness/analysis/analysis.h"
#include "harness/input/check.h"
#include "harness/judge/input_uncertainty.h"
#include "harness/judge/sweep.h"

/// The validation comparison of ASME V&V 20-2009 for the checks of a run that have the role
/// validation: what the discretization, the printed digits of the inputs and those of the reference
/// explain of the difference, and what is left to the model. Asked for by "uncertainty" in a case.
namespace trammel::harness {

/// The inputs of a case or variant that has "uncertainty", without those that stand there as words.
/// @throws InputError  where a pointer leads nowhere
[[nodiscard]] std::vector<results::UncertainInput> stated_inputs(const Document& document,
                                                                 const References& references);

/// @param document    case or variant that has "uncertainty"
/// @param quantities  of its solution
/// @param errors      of its discretization
/// @returns nothing if no check compares anything.
/// @throws InputError  where a pointer leads nowhere or a patched model has no meaning.
[[nodiscard]] std::optional<results::Uncertainty> evaluate_validation_uncertainty(
    const Document& document, const Quantities& quantities, const std::vector<Check>& checks,
    const results::ErrorEstimates& errors, const References& references);

/// Computes all levels of all sweeps of a case or variant.
/// @throws InputError  where the values do not go from coarse to fine.
[[nodiscard]] std::vector<Sweep> run_sweeps(const Document& document, const References& references);

}  // namespace trammel::harness
