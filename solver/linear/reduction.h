#pragma once

#include <vector>

#include "solver/linear/modes.h"
#include "solver/linear/system.h"

namespace trammel::solver {

/// Reduces a model by component mode synthesis. The interior coordinates q_i of a member are those
/// of the nodes that divide the member into elements. The interior coordinates are the sum of the
/// static response to the boundary coordinates q_b and of the lowest modes X of the member with
/// fixed boundary coordinates:
///
///   \f[ q_i = -K_{ii}^{-1} K_{ib} q_b + X p + r s, \quad K_{ii} x = \omega^2 M_{ii} x. \f]
///
/// p and s are coordinates of the reduced model. r is the part of the static response K_ii^-1 f_i
/// to each of `loads` that X does not represent. With r, the static response and the internal
/// forces of the members are exact. Without modes and loads, the method is static condensation. The
/// reduced model is more constrained than the full model, so that its frequencies are not lower.
/// Source: Guyan (1965); Craig & Bampton (1968).
///
/// @param system  full model.
/// @param modes  number of modes of the interior of each member. If this number is at least the
///   number of interior coordinates of a member, the member is not condensed.
/// @param loads  vectors of independent loads on the free coordinates [SI].
/// @returns the same model in fewer coordinates. T, K, M and f are reduced, and all other data are
///   unchanged. Functions of q also accept the reduced coordinates. `constraints` are those of the
///   full model.
/// @throws ModelError  if the number of modes is negative.
[[nodiscard]] System reduce_members(const System& system, Index modes,
                                    const std::vector<Eigen::VectorXd>& loads = {});

/// Reduces a model to mode shapes Phi with static correction (mode acceleration), q = Phi p + r s.
/// p and s are the coordinates of the reduced model. r is the component of the static response to
/// each load f that the modes do not represent:
///
///   K r = f - M Phi Phi^T f.
///
/// The response equals that of the full model at frequencies far below the omitted modes. Loads
/// that the modes represent exactly need no correction r.
///
/// @param system  full model.
/// @param modes  modes of the full model, with Phi^T M Phi = I.
/// @param loads  vectors of independent loads on the free coordinates [SI].
/// @returns the reduced model, in the form that `reduce_members` returns.
/// @throws ModelError  if the stiffness matrix is singular although there are no rigid modes.
[[nodiscard]] System reduce_to_modes(const System& system, const ModalSolution& modes,
                                     const std::vector<Eigen::VectorXd>& loads);

}  // namespace trammel::solver
