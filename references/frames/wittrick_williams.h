#pragma once

#include <functional>
#include <vector>

#include "references/frames/dynamic_stiffness.h"
#include "references/numerics/arguments.h"

/// Natural frequencies of a frame by the Wittrick-Williams count (`DynamicStiffness`).
namespace trammel::references {

/// A Wittrick-Williams count as a function of a frequency or load factor. Its roots are the
/// arguments at which the count reaches 1, 2, 3, ... They are bracketed in double precision. The
/// bracket is confirmed and refined in extended precision, because double precision only yields a
/// relative error of about 3e-10. No root is missed, and a repeated root appears as often as it
/// occurs.
struct CountingFunction {
  std::function<int(double)> coarse;
  std::function<DynamicStiffness<Real>::Count(const Real&)> fine;
  double lo = 0;  ///< > 0; lower end of the search, below all roots
  double hi = 0;  ///< first upper end of the search, which is doubled
};

/// Returns the roots `skipped` + 1 to `skipped` + `count` of a counting function. Their relative
/// errors are 1e-20.
/// @throws DerivationError  if the count stays below `skipped` + `count`.
[[nodiscard]] std::vector<Real> counted_roots(const CountingFunction& f, int skipped, int count);

struct FrameFrequencies {
  int rigid_motions = 0;          ///< number of rigid motions, w = 0
  std::vector<Real> frequencies;  ///< elastic natural frequencies, ascending [Hz]
};

/// Returns the first `count` elastic natural frequencies of a frame with relative errors of 1e-20.
/// @throws DerivationError  if the frame has no mass, or if fewer frequencies are found.
[[nodiscard]] FrameFrequencies frame_frequencies(const Frame& frame, int count);

/// Returns the lowest sqrt(EI/rho A)/L^2 of the members [rad/s]. It is an order of magnitude of the
/// lowest natural frequencies, not a bound.
/// @throws DerivationError  if a member has no mass, or if the frame has no member.
[[nodiscard]] Real frequency_order_of_magnitude(const Frame& frame);

/// Returns the number of natural frequencies below `frequency` [Hz], including rigid motions.
[[nodiscard]] int count_frequencies_below(const Frame& frame, const Real& frequency);

/// Computes the first `count` elastic natural frequencies of a frame [Hz].
[[nodiscard]] std::vector<Real> frame_frequencies_program(const Arguments& arguments);

/// Computes the number of natural frequencies of a frame below below_Hz, including rigid motions.
[[nodiscard]] std::vector<Real> frame_frequency_count_program(const Arguments& arguments);

/// Computes derivatives of frequencies by central differences of `frame_frequencies` at step, step
/// / 2 and step / 4, extrapolated twice. The error is O(step^6) plus 1e-20/step, because each
/// frequency has the error 1e-20. Frequencies that remain repeated have a common derivative. The
/// argument pointers is a list of JSON pointers to equal numbers in the arguments. All these
/// numbers change by step together. Values: [Hz / unit of the numbers], ascending in frequency.
[[nodiscard]] std::vector<Real> frame_frequency_sensitivity_program(const Arguments& arguments);

/// Computes the first `count` positive factors of the loads at which a frame buckles. The axial
/// forces of force_method_statics are multiplied by the factor. The number of natural frequencies
/// below a small w increases at each buckling load.
/// @throws DerivationError  if an axial force varies along its member.
[[nodiscard]] std::vector<Real> frame_buckling_program(const Arguments& arguments);

}  // namespace trammel::references
