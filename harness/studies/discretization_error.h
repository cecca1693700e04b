#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/analysis/analysis.h"
#include "harness/readers/discretization.h"

/// Estimates the difference between a computation and the limit of infinitely fine meshes and
/// steps.
namespace trammel::harness {

enum class ErrorSource { mesh, step };

/// Second computation with a coarser or finer mesh or step, for the error estimate of the first.
struct Companion {
  Document document;
  bool finer = false;
  double ratio = 2;   ///< ratio of element sizes, steps or tolerances
  std::string words;  ///< description, for example "half the elements"
};
/// Returns a second computation (companion) with half the elements or twice the time step, or with
/// the opposite for Refine::finer. If the number of elements cannot be halved, the companion is
/// finer. Returns nothing if the analysis has no mesh or no time steps.
/// @param own  result of `document`, which contains the largest step that the step control used
[[nodiscard]] std::optional<Companion> adjacent_refinement_level(
    const Document& document, ErrorSource source, Refine refine = Refine::coarser,
    const AnalysisResult* result = nullptr);

/// Returns true if a quantity converges under refinement. Coordinates, counts and measures of
/// accuracy do not converge.
[[nodiscard]] bool is_estimated(const std::string& quantity);

/// Returns, for each mode, the index of the mode of the other result with the same shape. Modes
/// without a counterpart are matched by their numbers if their frequencies differ by at most 10 %.
/// Modes without a drawn shape are always matched by number. The index is empty if no mode matches.
[[nodiscard]] std::vector<std::optional<std::size_t>> modes_matched_by_shape(
    const AnalysisResult& own, const AnalysisResult& other);

/// Returns, for each entry of a quantity, the index of the entry of the other result at the same
/// time. Without times, entries have equal indices if both quantities have the same size.
[[nodiscard]] std::vector<std::optional<std::size_t>> samples_matched_by_time(
    const Quantities& own, const Quantities& other, std::size_t size, std::size_t other_size);

/// Returns true if the results on two refinement levels are the same to the last bit. Both levels
/// then had the same time steps, and their difference is no estimate of the error.
[[nodiscard]] bool is_same_result(const AnalysisResult& result, const AnalysisResult& other);

/// Bands of the discretization error about the values of a quantity, with 95 % confidence.
struct ErrorBand {
  std::vector<double> half_width;  ///< [unit]
  std::vector<double> difference;  ///< |fine - coarse| [unit]
  std::vector<double> factor;      ///< ratio of half width (without round-off) to difference
  std::optional<double> order;
  bool asymptotic = true;
};
using ErrorBands = std::map<std::string, ErrorBand>;

/// Returns error bands from the results on two refinement levels. The band about the fine value has
/// the half width U = 3 |fine - coarse| / (r^p - 1), with the ratio r of element sizes or steps and
/// the order p (P. J. Roache, J. Fluids Eng. 116, 1994). The band about the coarse value is r^p
/// times as wide. p is at most 2 if the difference exceeds 10 % of the value, or if a mode has
/// fewer than two coarse elements per half wave of bending. If the values are exact in theory, U is
/// the difference plus round-off. Modes are matched by their shapes if both results have them.
[[nodiscard]] ErrorBands error_bands(const AnalysisResult& result, const AnalysisResult& other,
                                     ErrorSource source, const Companion& companion);

/// Returns error bands from three refinement levels. If the observed order of convergence agrees
/// with the theoretical order, the safety factor is 1.25 instead of 3. A lower observed order
/// replaces the theoretical order, and a higher one up to twice the theoretical order. Sources:
/// Roache 1998, Verification and Validation in Computational Science and Engineering, 5.9;
/// Oberkampf & Roy 2010, Verification and Validation in Scientific Computing, 8.6.
/// @param bands    bands from the two finer levels
/// @param coarser  bands from the two coarser levels
[[nodiscard]] ErrorBands bands_with_observed_order(ErrorBands bands, const ErrorBands& coarser,
                                                   ErrorSource source, const Companion& companion);

/// Returns the relative errors of a solved computation: sums of the half widths of the error bands
/// due to mesh and time step, divided by the scales of the values.
[[nodiscard]] std::vector<results::ErrorEstimate> relative_errors(
    const Document& document, const AnalysisResult& result,
    const std::map<ErrorSource, ErrorBands>& bands);
/// Repeats a solved computation with a coarser or finer mesh and time step, and returns the
/// estimated errors of its quantities.
[[nodiscard]] results::ErrorEstimates estimate_errors(const Document& document,
                                                      const AnalysisResult& result,
                                                      const References& references);

/// Returns warnings about quantities whose estimated error exceeds the limit. Each warning names
/// the key of the mesh or time step to be refined.
[[nodiscard]] std::vector<std::string> error_warnings(const results::ErrorEstimates& errors,
                                                      double limit);

}  // namespace trammel::harness
