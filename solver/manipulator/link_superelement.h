#pragma once

#include "solver/elements/frame_element.h"

namespace trammel::solver {

/// Prismatic member of n equal elements in member axes. Its ends keep their coordinates q_b = (u1
/// v1 θ1 u2 v2 θ2). Its interior follows them statically and, in addition, moves in all modes with
/// held ends:
///
///   q_i = N q_b + X p,   K_ii X = M_ii X diag(1 / mu),   X^T K_ii X = I.
///
/// This is a change of basis without truncation:
///
///   \f[ K = \begin{bmatrix} k & \\ & I \end{bmatrix}, \quad
///       M = \begin{bmatrix} m & P^T \\ P & \operatorname{diag} \mu \end{bmatrix}. \f]
///
/// k is the stiffness of one element of the full length. The matrices do not depend on the position
/// of the member.
/// Source: Craig & Bampton (1968), with every mode kept.
struct LinkSuperelement {
  Matrix6d m;  ///< mass of the end coordinates with the interior following statically
  Eigen::Matrix<double, Eigen::Dynamic, 6> P;  ///< mode x coordinate
  Eigen::VectorXd mu;                          ///< 1 / omega^2 of each mode [s^2]
  Index inside = 0;  ///< number of interior coordinates; massless ones have no mode
  /// Largest |x_i^T K_ii x_j| and |x_i^T M_ii x_j| / sqrt(mu_i mu_j) of different modes. They are
  /// neglected; an eigenvalue changes by their squares.
  double coupling = 0;
};

/// Condenses a member.
/// @param member  properties and number of elements.
/// @param length  length of the full member [m].
[[nodiscard]] LinkSuperelement condense(const Member& member, double length);

}  // namespace trammel::solver
