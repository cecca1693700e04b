#pragma once

#include <cstdint>

#include "harness/input/document.h"

namespace trammel::harness {

/// The n-th of the random scenes of a seed, its kind in its title. Of ten, five are statics (a
/// manipulator, a portal frame, a beam, a column up to 0.99 of its buckling load, or a path near a
/// singularity), three are modes, one is harmonic response and one motion: a manipulator along a
/// circle (elastodynamics), slow or fast, damped or not, or sometimes a link that spins. Sizes,
/// loads, joints and tolerances are drawn so that each effect lies anywhere from far below what is
/// asked for to far above. The same on every machine.
[[nodiscard]] Document random_scene(std::uint64_t seed, std::uint64_t n);

}  // namespace trammel::harness
