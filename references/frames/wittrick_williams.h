#pragma once

#include <functional>
#include <vector>

#include "references/frames/dynamic_stiffness.h"
#include "references/numerics/arguments.h"

/// Natural frequencies of a frame by the Wittrick-Williams count (`DynamicStiffness`).
namespace trammel::references {

/// Passages: the arguments at which a Wittrick-Williams count reaches 1, 2, 3, ... They are
/// bracketed in double precision. The bracket is confirmed and refined in extended precision,
/// because double precision reaches only about 3e-10. No passage is missed, and a repeated passage
/// appears as often as it occurs.
struct CountingFunction {
  std::function<int(double)> coarse;
  std::function<DynamicStiffness<Real>::Count(const Real&)> fine;
  double lo = 0;  ///< > 0; lower end of the search, below all passages
  double hi = 0;  ///< first upper end of the search, which is doubled
};

/// Returns the passages from `first` + 1 to `first` + `count`, each to 1e-20.
/// @throws DerivationError  if the count does not reach their sum.
[[nodiscard]] std::vector<Real> counted_roots(const CountingFunction& f, int first, int count);

struct FrameFrequencies {
  int rigid_motions = 0;          ///< at w = 0
  std::vector<Real> frequencies;  ///< the elastic ones, ascending [Hz]
};

/// The first `count` elastic natural frequencies, each to 1e-20.
/// @throws DerivationError  if the frame has no mass or fewer frequencies are found.
[[nodiscard]] FrameFrequencies frame_frequencies(const Frame& frame, int count);

/// The lowest sqrt(EI/rho A)/L^2 of the members: a scale of the frequencies, not a bound [rad/s].
/// @throws DerivationError  if a member has no mass, or there is none.
[[nodiscard]] Real frequency_scale(const Frame& frame);

/// Returns the number of natural frequencies below `frequency` [Hz], including rigid motions.
[[nodiscard]] int frequencies_below(const Frame& frame, const Real& frequency);

/// Arguments: model (or manipulator and pose), count. Values: elastic frequencies [Hz].
[[nodiscard]] std::vector<Real> frame_frequencies_program(const Arguments& arguments);

/// Arguments: model (or manipulator and pose), below_Hz. Value: the number of natural frequencies
/// below below_Hz, including rigid motions.
[[nodiscard]] std::vector<Real> frame_count_program(const Arguments& arguments);

/// Derivatives of frequencies, by central differences of `frame_frequencies` at step, step / 2 and
/// step / 4, extrapolated twice. The error is O(step^6) plus 1e-20 over the step, because each
/// frequency has the error 1e-20. Frequencies that remain repeated have a common derivative.
/// Arguments: model (or manipulator and pose), pointers (JSON pointers into the arguments, to equal
/// numbers that change together), step (in their unit), count. Values: [Hz / unit], ascending in
/// frequency.
[[nodiscard]] std::vector<Real> frame_sensitivity_program(const Arguments& arguments);

/// Computes the first `count` positive factors of the loads at which the frame buckles: the axial
/// forces of unit_load_statics times the factor, and the count at vanishing frequency.
/// Arguments: model (or manipulator, pose and loads), count. Values: factors of the loads.
/// @throws DerivationError  if an axial force varies along its member.
[[nodiscard]] std::vector<Real> frame_buckling_program(const Arguments& arguments);

}  // namespace trammel::references
