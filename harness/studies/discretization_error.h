#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/analysis/analysis.h"
#include "harness/readers/discretization.h"

/// How far a computation is from what its model gives on infinitely fine meshes and steps.
namespace trammel::harness {

enum class ErrorSource { mesh, step };

/// The computation on the next coarser level, or on the next finer one.
struct Companion {
  Document document;
  bool finer = false;
  double ratio = 2;   ///< of element sizes, steps or tolerances
  std::string words;  ///< "half the elements"
};
/// The one asked for, or the finer one if a count cannot be halved. Nothing if the analysis has no
/// mesh or no steps.
[[nodiscard]] std::optional<Companion> companion_of(const Document& document, ErrorSource source,
                                                    Refine refine = Refine::coarser);

/// Order of convergence, the lowest of the active parts: 4 for straight prismatic members with a
/// consistent mass, 2 for a lumped mass, tapered members, chords of arcs and triangles (J. S.
/// Archer, J. Struct. Div. ASCE 89, 1963); 2 for time schemes, 1 for Newmark's with numerical
/// damping; the error of an adaptive scheme of order p follows its tolerance to the power
/// p/(p + 1). None: theory says that nodal values are exact.
[[nodiscard]] std::optional<double> order_of(const Document& document, ErrorSource source,
                                             const std::string& quantity);

/// Bands about the numbers of a quantity, at about 95 %.
struct ErrorBand {
  std::vector<double> half_width;  ///< [unit]
  std::optional<double> order;
  bool asymptotic = true;
};
using ErrorBands = std::map<std::string, ErrorBand>;

/// Bands from two levels: U = 3 |fine - coarse| / (r^p - 1) about the fine numbers, r^p times that
/// about the coarse ones (P. J. Roache, J. Fluids Eng. 116, 1994). Where the difference exceeds a
/// tenth of the number, the lower of p and 2 counts. If theory says exact, U is the difference and
/// round-off. Modes are matched by their shapes if both results have them.
[[nodiscard]] ErrorBands error_bands(const AnalysisResult& own, const AnalysisResult& other,
                                     ErrorSource source, const Companion& companion);

/// Relative errors of a solved computation from its bands, added as magnitudes over the sources.
[[nodiscard]] std::vector<results::ErrorEstimate> relative_errors(
    const Document& document, const AnalysisResult& own,
    const std::map<ErrorSource, ErrorBands>& bands);
/// Computes the companions of a solved computation.
[[nodiscard]] results::ErrorEstimates estimate_errors(const Document& document,
                                                      const AnalysisResult& own,
                                                      const References& references);

/// Warnings of quantities whose error is above the limit, with the setting to change.
[[nodiscard]] std::vector<std::string> error_warnings(const results::ErrorEstimates& errors,
                                                      double limit);

}  // namespace trammel::harness
