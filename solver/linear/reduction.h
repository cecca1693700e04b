#pragma once

#include <vector>

#include "solver/linear/modes.h"
#include "solver/linear/system.h"

namespace trammel::solver {

/// Component mode synthesis: the free coordinates inside the members (of the nodes that cut them
/// into elements) follow the rest statically and, beyond that, in their lowest modes with the
/// members' ends held,
///   q_i = -K_ii^-1 K_ib q_b + X p + r s,   K_ii x = w^2 M_ii x,
/// with r the part of K_ii^-1 f_i beyond X for each of `loads`, so that the static response and the
/// forces inside the members are exact. Without modes and loads it is static condensation.
/// Frequencies are those of a constrained model, never below the full one's. Source: Guyan (1965);
/// Craig & Bampton (1968).
///
/// @param modes  of each member's inside [-]; as many as there are coordinates or more: none is
///               condensed
/// @param loads  of the free coordinates, that act one without another [SI]
/// @returns the same model in fewer coordinates: T, K, M and f are reduced, the rest is as it was,
///          so that motions, strain energies and drawings follow from the reduced coordinates as
///          they do from q. Its `constraints` are still those of the full model.
/// @throws ModelError  for a negative number of modes.
[[nodiscard]] System reduce_members(const System& system, Index modes,
                                    const std::vector<Eigen::VectorXd>& loads = {});

/// Modal truncation with static correction (mode acceleration): q = Phi p + r s, with r what each
/// load does beyond the modes,
///   K r = f - M Phi Phi^T f.
/// At frequencies far below those left out the response is that of the full model. Loads that the
/// modes carry whole have no r.
///
/// @param modes  found modes of the same system, with Phi^T M Phi = I
/// @param loads  that act one without another [SI]
/// @returns as `reduce_members`
[[nodiscard]] System reduce_to_modes(const System& system, const ModalSolution& modes,
                                     const std::vector<Eigen::VectorXd>& loads);

}  // namespace trammel::solver
