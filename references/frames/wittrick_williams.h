#pragma once

#include <vector>

#include "references/frames/frame.h"
#include "references/numerics/arguments.h"

/// Natural frequencies of a frame by the Wittrick-Williams count (`DynamicStiffness`).
namespace trammel::references {

struct FrameFrequencies {
  int rigid_motions = 0;          ///< at w = 0
  std::vector<Real> frequencies;  ///< the elastic ones, ascending [Hz]
};

/// The first `count` elastic natural frequencies, each to 1e-20.
/// @throws DerivationError  where the frame has no mass or not so many frequencies are found.
[[nodiscard]] FrameFrequencies frame_frequencies(const Frame& frame, int count);

/// The lowest sqrt(EI/rho A)/L^2 of the members: a scale of the frequencies, not a bound [rad/s].
/// @throws DerivationError  where a member has no mass, or there is none.
[[nodiscard]] Real frequency_scale(const Frame& frame);

/// How many natural frequencies, rigid motions included, lie below `frequency` [Hz].
[[nodiscard]] int frequencies_below(const Frame& frame, const Real& frequency);

/// Arguments: model (or manipulator and pose), count. Values: elastic frequencies [Hz].
[[nodiscard]] std::vector<double> frame_frequencies_program(const Json& arguments);

/// Arguments: model (or manipulator and pose), below_Hz. Value: their number, rigid ones included.
[[nodiscard]] std::vector<double> frame_count_program(const Json& arguments);

}  // namespace trammel::references
