#pragma once

#include "solver/modes/modes.h"
#include "solver/statics/statics.h"

namespace trammel::solver {

/// Small vibration about the state that the model's loads hold it in: (K + K_G) x = w^2 M x, K_G
/// from the forces of second-order statics. The state's displacements are small: the geometry is
/// the undeformed one.
struct PrestressedModes {
  StaticSolution state;
  ModalSolution modes;  ///< outcome singular: without a stable state, for the reason given there
};

[[nodiscard]] PrestressedModes solve_prestressed_modes(const System& system,
                                                       const ModesOptions& options);

}  // namespace trammel::solver
