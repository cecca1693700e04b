#pragma once

#include "solver/elements/frame_element.h"

namespace trammel::solver {

/// Condensed prismatic member of n equal elements, in member axes. Its coordinates are q_b = (u1 v1
/// θ1 u2 v2 θ2) of its ends and the amplitudes p of the modes X with fixed ends. The interior
/// displacements q_i are the static response to q_b plus the modes:
///
///   q_i = N q_b + X p,   K_ii X = M_ii X diag(1 / mu),   X^T K_ii X = I.
///
/// All modes are kept, so that this is an exact change of basis:
///
///   \f[ K = \begin{bmatrix} k & \\ & I \end{bmatrix}, \quad
///       M = \begin{bmatrix} m & P^T \\ P & \operatorname{diag} \mu \end{bmatrix}. \f]
///
/// k is the stiffness of one element of the full length. The matrices do not depend on the position
/// and orientation of the member.
/// Source: Craig & Bampton (1968), with every mode kept.
struct LinkSuperelement {
  Matrix6d m;  ///< mass matrix of the end coordinates with a static response of the interior
  Eigen::Matrix<double, Eigen::Dynamic, 6> P;  ///< mass coupling, mode x end coordinate
  Eigen::VectorXd mu;                          ///< 1 / omega^2 of each mode with fixed ends [s^2]
  Index inside = 0;  ///< number of interior coordinates, including massless ones without mode
  /// Largest coupling of two different modes, |x_i^T K_ii x_j| or |x_i^T M_ii x_j| / sqrt(mu_i
  /// mu_j). The couplings are neglected, which changes an eigenvalue by their squares.
  double coupling = 0;
};

/// Computes the condensed matrices of a member of the given length [m].
[[nodiscard]] LinkSuperelement condense_member(const Member& member, double length);

}  // namespace trammel::solver
