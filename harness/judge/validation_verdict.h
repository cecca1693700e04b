#pragma once

#include <span>
#include <string>

#include "harness/results/run_results.h"

/// The validation comparison of ASME V&V 20-2009: E = S - D, and how much of it the numerical
/// error, the inputs and the printed digits of the reference can explain.
namespace trammel::harness {

inline constexpr const char* kWithinUncertainty = "within-uncertainty";
inline constexpr const char* kModelError = "model-error";
inline constexpr const char* kReferenceInconsistent = "reference-inconsistent";
/// A number is missing, and nothing is claimed.
inline constexpr const char* kUndecided = "undecided";

inline constexpr double kCoverageFactor = 2;

/// Judges a row of values, such as frequencies in ascending order, with the u_input of each
/// comparison and of its `all_inputs`.
///
/// If the model gives a repeated value by its symmetry (equal to 1e-6), the reference must too. If
/// the reference prints different values, more than its digits allow, and the model's value lies
/// between them, then no model of this symmetry can do better: the reference contradicts itself. If
/// the model's value lies beyond all of them, the model has an error all the same.
void evaluate_validation_row(std::span<results::Comparison> row);

}  // namespace trammel::harness
