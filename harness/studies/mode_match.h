#pragma once

#include <Eigen/Core>
#include <vector>

#include "harness/input/document.h"

/// Matching the modes of two models by their shapes, never by their numbers.
namespace trammel::harness {

/// Modes seen at the places that two models have in common.
struct SampledModes {
  std::vector<double> frequency;  ///< ascending [Hz]
  Eigen::MatrixXd shape;          ///< displacement at common places x mode
};

/// The modes of both cases, seen at nodes of the same names and at stations along members of the
/// same names, where the cubic shape functions of the beam interpolate.
/// @throws InputError  where one of them is no case of modes, or is singular.
[[nodiscard]] std::pair<SampledModes, SampledModes> sample_modes(const Document& a,
                                                                 const Document& b);

/// A set of modes of one model and the set of the other that looks most like it. Frequencies within
/// a millionth of each other are one set, whose single shapes mean nothing.
struct ModeMatch {
  /// b is empty where nothing looks alike; a set of b may stand beside several single modes of a.
  std::vector<std::size_t> a, b;
  /// Mean squared cosine of the angles between the two subspaces: the modal assurance criterion
  /// where both sets are single modes (R. J. Allemang, D. L. Brown, IMAC 1982).
  double overlap = 0;
};

[[nodiscard]] std::vector<ModeMatch> match_modes(const SampledModes& a, const SampledModes& b);

}  // namespace trammel::harness
