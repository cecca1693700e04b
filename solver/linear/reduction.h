#pragma once

#include <vector>

#include "solver/linear/modes.h"
#include "solver/linear/system.h"

namespace trammel::solver {

/// Reduces the model by component mode synthesis. The interior coordinates of a member belong to
/// the nodes that divide it into elements. They follow the other coordinates statically. In
/// addition they move in the lowest modes with held member ends:
///
///   \f[ q_i = -K_{ii}^{-1} K_{ib} q_b + X p + r s, \quad K_{ii} x = \omega^2 M_{ii} x. \f]
///
/// r is the part of K_ii^-1 f_i beyond X for each of `loads`. It makes the static response and the
/// internal forces of the members exact. Without modes and loads the method is static condensation.
/// The frequencies are those of a constrained model, which are at least those of the full model.
/// Source: Guyan (1965); Craig & Bampton (1968).
///
/// @param system  full model.
/// @param modes  number of modes of the interior of each member. If it is at least the number of
///   interior coordinates, the member is not condensed.
/// @param loads  loads on the free coordinates that act independently [SI].
/// @returns the same model in fewer coordinates: T, K, M and f are reduced, and all other data are
///   unchanged. Motions, strain energies and drawings follow from the reduced coordinates as from
///   q. `constraints` are those of the full model.
/// @throws ModelError  if the number of modes is negative.
[[nodiscard]] System reduce_members(const System& system, Index modes,
                                    const std::vector<Eigen::VectorXd>& loads = {});

/// Reduces the model to modes with static correction (mode acceleration), q = Phi p + r s. r is the
/// component of the static response to each load that the modes do not represent:
///
///   K r = f - M Phi Phi^T f.
///
/// The response equals that of the full model at frequencies far below the omitted modes. Loads
/// that the modes represent exactly have no r.
///
/// @param system  full model.
/// @param modes  modes of the same system, with Phi^T M Phi = I.
/// @param loads  loads on the free coordinates that act independently [SI].
/// @returns the reduced model, as `reduce_members`.
/// @throws ModelError  if the stiffness is singular although there are no rigid modes.
[[nodiscard]] System reduce_to_modes(const System& system, const ModalSolution& modes,
                                     const std::vector<Eigen::VectorXd>& loads);

}  // namespace trammel::solver
