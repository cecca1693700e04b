#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "harness/results/run_results.h"

/// Uncertainty of computed results due to inputs with a limited number of printed digits. Each
/// input has a uniform distribution over +-half_width about its value, independent of the others.
/// Its standard uncertainty is half_width / sqrt(3).
/// Source: JCGM 100:2008 (GUM) 4.3.7 and 5.1; JCGM 101:2008 for the sampling.
namespace trammel::harness {

/// Function that returns the outputs of the model for given offsets of the inputs from their
/// nominal values, in the unit of each input. The result is empty if the model has no solution.
using Response = std::function<std::optional<std::vector<double>>(const std::vector<double>&)>;

/// First-order standard uncertainty u of an output f due to the inputs x:
///   u^2 = sum over inputs of (df/dx half_width)^2 / 3.
/// Returns the signed contributions df/dx half_width / sqrt(3): one list per input, with one value
/// per output [unit of the output]. The central differences have a step of half_width / 16. Their
/// truncation error is 1/256 of the nonlinearity over the half-width.
/// @return empty if the model has no solution near its nominal inputs
[[nodiscard]] std::optional<std::vector<std::vector<double>>> uncertainty_by_derivatives(
    const Response& response, const std::vector<double>& half_widths);

/// Uncertainty of the outputs if all inputs vary together; it includes nonlinearity.
struct SampledUncertainty {
  std::vector<double> standard;  ///< standard deviation of each output
  int samples = 0;               ///< number of solved samples
  int failed = 0;                ///< number of samples without solution; they are excluded
};

/// Samples a Latin hypercube (McKay, Beckman & Conover 1979): each input takes one value in each of
/// `count` equal parts of its range. The samples are the same on every machine.
/// @param count  at least 2
[[nodiscard]] SampledUncertainty uncertainty_by_sampling(const Response& response,
                                                         const std::vector<double>& half_widths,
                                                         int count, std::uint64_t seed);

/// Validation comparison after ASME V&V 20-2009. The difference E = S - D of simulation and
/// reference is compared with the uncertainties due to discretization, inputs and printed digits.

inline constexpr const char* kWithinUncertainty = "within-uncertainty";
inline constexpr const char* kModelError = "model-error";
inline constexpr const char* kReferenceInconsistent = "reference-inconsistent";
/// Verdict of a validation comparison if a number is missing, so that no conclusion is drawn.
inline constexpr const char* kUndecided = "undecided";

inline constexpr double kCoverageFactor = 2;

/// Judges the comparisons of one row of printed values, such as frequencies in ascending order. The
/// uncertainties of each comparison, and u_input of its `all_inputs`, must be set before.
///
/// If symmetry of the model implies a repeated value (equal within 1e-6), the reference must repeat
/// this value. If the reference prints values that differ by more than its digits allow, and the
/// model's value is between them, the reference contradicts itself: no model with this symmetry can
/// match the reference. If the model's value is outside the printed range, the verdict is a model
/// error.
void evaluate_validation_row(std::span<results::Comparison> row);

}  // namespace trammel::harness
