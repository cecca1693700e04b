#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

/// What inputs that are known to so many printed digits do to a computed result. Each input lies
/// anywhere within +-half_width of its value, all places equally likely, inputs independent of each
/// other: its standard uncertainty is half_width / sqrt(3).
/// Source: JCGM 100:2008 (GUM) 4.3.7 and 5.1; JCGM 101:2008 for the sampling.
namespace trammel::harness {

/// The outputs with every input moved by its offset (unit of the input); empty where the model has
/// no solution there.
using Response = std::function<std::optional<std::vector<double>>(const std::vector<double>&)>;

/// First order: u^2 = sum over inputs of (df/dx half_width)^2 / 3.
struct PropagatedUncertainty {
  /// input x output: df/dx * half_width / sqrt(3), with its sign [unit of the output]
  std::vector<std::vector<double>> contribution;
  std::vector<double> standard;  ///< output: root of the sum of squares
};

/// Central differences over +-half_width / 16: truncation is 1/256 of what the nonlinearity over
/// the half width is.
/// @return empty where the model has no solution near its nominal inputs
[[nodiscard]] std::optional<PropagatedUncertainty> uncertainty_by_derivatives(
    const Response& response, const std::vector<double>& half_widths);

/// All inputs at once, nonlinearity included.
struct SampledUncertainty {
  std::vector<double> mean;      ///< output
  std::vector<double> standard;  ///< output: standard deviation
  std::vector<double> low;       ///< output: 2.5 % quantile
  std::vector<double> high;      ///< output: 97.5 % quantile
  int samples = 0;               ///< that the model solved
  int failed = 0;                ///< that it could not solve; they are in no figure above
};

/// Latin hypercube (McKay, Beckman & Conover 1979): each input visits each of `count` equal parts
/// of its range once. The same numbers on every machine.
/// @param count  at least 2
[[nodiscard]] SampledUncertainty uncertainty_by_sampling(const Response& response,
                                                         const std::vector<double>& half_widths,
                                                         int count, std::uint64_t seed);

}  // namespace trammel::harness
