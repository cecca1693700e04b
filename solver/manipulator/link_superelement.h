#pragma once

#include "solver/elements/frame_element.h"

namespace trammel::solver {

/// Condensed prismatic member of n equal elements, in member axes. Its coordinates are the
/// displacements q_b = (u1 v1 θ1 u2 v2 θ2) of its ends and the amplitudes p of the modes X with
/// fixed ends. The interior displacements q_i are the sum of the static response to q_b and the
/// modes:
///
///   q_i = N q_b + X p,   K_ii X = M_ii X diag(1 / mu),   X^T K_ii X = I.
///
/// All modes are kept, so that the condensation is an exact change of basis:
///
///   \f[ K = \begin{bmatrix} k & \\ & I \end{bmatrix}, \quad
///       M = \begin{bmatrix} m & P^T \\ P & \operatorname{diag} \mu \end{bmatrix}. \f]
///
/// k is the stiffness of one element that has the length of the member. The matrices do not depend
/// on the position and orientation of the member. Source: Craig & Bampton (1968), here with every
/// mode kept.
struct LinkSuperelement {
  /// Mass matrix of the end coordinates with static response of the interior.
  Matrix6d m;
  Eigen::Matrix<double, Eigen::Dynamic, 6> P;  ///< mass coupling of mode (row) and end coordinate
  Eigen::VectorXd mu;                          ///< 1 / omega^2 of each mode with fixed ends [s^2]
  /// Number of interior coordinates, including massless coordinates, which have no mode.
  Index inside = 0;
  /// Largest coupling of two different modes, |x_i^T K_ii x_j| or |x_i^T M_ii x_j| / sqrt(mu_i
  /// mu_j). All couplings are neglected. The resulting relative error of an eigenvalue is of the
  /// order of the squared coupling.
  double coupling = 0;
};

/// Computes the condensed matrices of a member of the given length [m].
[[nodiscard]] LinkSuperelement condense_member(const Member& member, double length);

}  // namespace trammel::solver
