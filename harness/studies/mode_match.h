#pragma once

#include <Eigen/Core>
#include <vector>

#include "harness/results/run_results.h"

/// Matches the modes of two models by their shapes, not by their numbers.
namespace trammel::harness {

/// Mode shapes of one model, sampled at the points that two models have in common.
struct SampledModes {
  std::vector<double> frequency;  ///< natural frequencies, ascending [Hz]
  Eigen::MatrixXd shape;          ///< rows: displacements of common points; columns: modes
};

/// Returns the drawn modes of two results at common points of their drawings: the points with equal
/// coordinates, or the points with equal numbers if the dimensions of equal meshes differ. Modes
/// without a drawn shape are omitted, and so are sets of equal frequencies with some shapes that
/// are not drawn.
/// @param frequency_a, frequency_b  natural frequencies of the results, ascending [Hz]
[[nodiscard]] std::pair<SampledModes, SampledModes> sample_modes(
    const std::vector<double>& frequency_a, const results::Drawing& a,
    const std::vector<double>& frequency_b, const results::Drawing& b);

/// Set of modes of one model and the most similar set of the other model. Frequencies within a
/// relative distance of 1e-6 form one set, because their single shapes are arbitrary.
struct ModeMatch {
  /// Indices of modes of the models a and b. The list b is empty if no set is similar. Several
  /// single modes of model a may match one set of b.
  std::vector<std::size_t> a, b;
  /// Mean squared cosine of the angles between the two subspaces. For single modes it is the modal
  /// assurance criterion (R. J. Allemang, D. L. Brown, IMAC 1982).
  double overlap = 0;
};

[[nodiscard]] std::vector<ModeMatch> match_modes(const SampledModes& a, const SampledModes& b);

}  // namespace trammel::harness
