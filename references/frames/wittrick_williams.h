#pragma once

#include <functional>
#include <vector>

#include "references/frames/dynamic_stiffness.h"
#include "references/numerics/arguments.h"

/// Natural frequencies of a frame by the Wittrick-Williams count (`DynamicStiffness`).
namespace trammel::references {

/// Where a Wittrick-Williams count passes 1, 2, 3, ...: bracketed in double, the bracket confirmed
/// in extended precision, then refined there. None is missed or doubled, and a repeated one appears
/// as often as it occurs. (A double alone reaches about 3e-10.)
struct CountingFunction {
  std::function<int(double)> coarse;
  std::function<DynamicStiffness<Real>::Count(const Real&)> fine;
  double lo = 0;  ///< > 0; where the search begins; nothing sought lies below
  double hi = 0;  ///< where its doubling begins
};

/// Returns the passages from `first` + 1 to `first` + `count`, each to 1e-20.
/// @throws DerivationError  if the count does not reach them.
[[nodiscard]] std::vector<Real> counted_roots(const CountingFunction& f, int first, int count);

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
[[nodiscard]] std::vector<Real> frame_frequencies_program(const Arguments& arguments);

/// Arguments: model (or manipulator and pose), below_Hz. Value: their number, rigid ones included.
[[nodiscard]] std::vector<Real> frame_count_program(const Arguments& arguments);

}  // namespace trammel::references
