#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/results/run_results.h"

/// What inputs that are known to so many printed digits do to a computed result. Each input lies
/// anywhere within +-half_width of its value, all places equally likely, inputs independent of each
/// other: its standard uncertainty is half_width / sqrt(3).
/// Source: JCGM 100:2008 (GUM) 4.3.7 and 5.1; JCGM 101:2008 for the sampling.
namespace trammel::harness {

/// The outputs with every input moved by its offset (unit of the input); empty where the model has
/// no solution there.
using Response = std::function<std::optional<std::vector<double>>(const std::vector<double>&)>;

/// First order, u^2 = sum over inputs of (df/dx half_width)^2 / 3: the contributions df/dx *
/// half_width / sqrt(3), input x output, with their sign [unit of the output].
/// Central differences over +-half_width / 16: truncation is 1/256 of what the nonlinearity over
/// the half width is.
/// @return empty where the model has no solution near its nominal inputs
[[nodiscard]] std::optional<std::vector<std::vector<double>>> uncertainty_by_derivatives(
    const Response& response, const std::vector<double>& half_widths);

/// All inputs at once, nonlinearity included.
struct SampledUncertainty {
  std::vector<double> standard;  ///< standard deviation of each output
  int samples = 0;               ///< that the model solved
  int failed = 0;                ///< that it could not solve; they are left out
};

/// Latin hypercube (McKay, Beckman & Conover 1979): each input visits each of `count` equal parts
/// of its range once. The same numbers on every machine.
/// @param count  at least 2
[[nodiscard]] SampledUncertainty uncertainty_by_sampling(const Response& response,
                                                         const std::vector<double>& half_widths,
                                                         int count, std::uint64_t seed);

/// The validation comparison of ASME V&V 20-2009: E = S - D, and how much of it the numerical
/// error, the inputs and the printed digits of the reference can explain.

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
