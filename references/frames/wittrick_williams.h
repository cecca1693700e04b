#pragma once

#include <vector>

#include "references/frames/frame.h"
#include "references/numerics/arguments.h"

/// Natural frequencies and critical loads of a frame by the Wittrick-Williams count.
namespace trammel::references {

struct FrameFrequencies {
  int rigid_motions = 0;          ///< at w = 0
  std::vector<Real> frequencies;  ///< the elastic ones, ascending [Hz]
};

/// The first `count` elastic natural frequencies, each to 1e-20.
/// @throws DerivationError  where the frame has no mass or not so many frequencies are found.
[[nodiscard]] FrameFrequencies frame_frequencies(const Frame& frame, int count);

/// How many natural frequencies, rigid motions included, lie below `frequency` [Hz].
[[nodiscard]] int frequencies_below(const Frame& frame, const Real& frequency);

/// The first `count` positive factors of the loads at which the frame buckles: the axial forces of
/// unit_load_statics times the factor, and the count at vanishing frequency.
/// @throws DerivationError  where an axial force varies along its member.
[[nodiscard]] std::vector<Real> frame_buckling_factors(const Frame& frame, int count);

/// Arguments: model (or manipulator and pose), count. Values: elastic frequencies [Hz].
[[nodiscard]] std::vector<double> frame_frequencies_program(const Json& arguments);

/// Arguments: model (or manipulator and pose), below_Hz. Value: their number, rigid ones included.
[[nodiscard]] std::vector<double> frame_count_program(const Json& arguments);

/// Arguments: model (or manipulator, pose and loads), count. Values: factors of the loads.
[[nodiscard]] std::vector<double> frame_buckling_program(const Json& arguments);

}  // namespace trammel::references
