#pragma once

#include "solver/elements/frame_element.h"

namespace trammel::solver {

/// A prismatic member of n equal elements in its own axes. Its ends keep their coordinates
/// q_b = (u1 v1 θ1 u2 v2 θ2); its inside follows them statically and, beyond that, in all modes
/// with the ends held,
///   q_i = N q_b + X p,   K_ii X = M_ii X diag(1 / mu),   X^T K_ii X = I,
/// which is a change of basis that leaves nothing out:
///   K = diag(k, I),   M = [m, P^T; P, diag(mu)],
/// k the stiffness of one element of the full length.
/// None of it depends on where the member lies.
/// Source: Craig & Bampton (1968), with every mode kept.
struct LinkSuperelement {
  Matrix6d m;  ///< mass of the ends' coordinates, the inside following statically
  Eigen::Matrix<double, Eigen::Dynamic, 6> P;  ///< mode x coordinate
  Eigen::VectorXd mu;                          ///< 1 / omega^2 of each mode [s^2]
  Index inside = 0;  ///< coordinates inside; those that carry no mass have no mode
  /// Largest |x_i^T K_ii x_j| and |x_i^T M_ii x_j| / sqrt(mu_i mu_j) of different modes, taken for
  /// zero: an eigenvalue changes by their squares.
  double coupling = 0;
};

/// @param length  of the whole member [m].
[[nodiscard]] LinkSuperelement condense(const Member& member, double length);

}  // namespace trammel::solver
