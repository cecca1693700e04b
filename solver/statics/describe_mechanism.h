#pragma once

#include <string>

#include "solver/statics/zero_energy_modes.h"

namespace trammel::solver {

/// "rotation of the platform about (0.25, 0.144) m; node B turns freely"; empty without modes.
[[nodiscard]] std::string describe_mechanism(const System& system, const ZeroEnergyModes& modes);

}  // namespace trammel::solver
