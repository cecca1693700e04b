#pragma once

#include <cstdint>

#include "harness/input/document.h"

namespace trammel::harness {

/// The n-th of the random scenes of a seed: a case with statics or modes of a manipulator, a portal
/// frame, or a beam, whose sizes, loads and joints are drawn so that each effect lies anywhere from
/// far below a per cent to far above. The same on every machine.
[[nodiscard]] Document random_scene(std::uint64_t seed, std::uint64_t n);

/// The same in motion: a manipulator along a circle (elastodynamics), slow or fast, damped or not,
/// or the modes of a link that spins.
[[nodiscard]] Document random_motion(std::uint64_t seed, std::uint64_t n);

}  // namespace trammel::harness
