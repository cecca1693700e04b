#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "solver/assembly/prestress.h"
#include "solver/assembly/system.h"
#include "solver/model/evidence.h"

namespace trammel::solver {

struct StaticsOptions {
  /// Second-order theory: (K + K_G) q = f with the geometric stiffness of the forces that the
  /// solution has itself, so that tension stiffens and compression softens (see prestress.h).
  bool second_order = false;
};

/// Statics K q = f (paper Eq. 11). Section forces N, V, M are those on a face whose normal points
/// from a member's first to its second node, x along it and y to its left: tension is positive,
/// EI v'' = M, dM/dx = -V, dV/dx = -q_y, dN/dx = -q_x.
struct StaticSolution {
  Outcome outcome;           ///< singular: the reason names the free motion in words
  Eigen::VectorXd q;         ///< free coordinates; see node_motion
  Prestress forces;          ///< second-order theory: of q, those that hold it
  double amplification = 1;  ///< of what second-order theory adds, by the loads [-]
  double estimated_correct_digits =
      0;  ///< of the largest displacement: linear_solution.h, second_order.h
  Eigen::MatrixX3d displacement;  ///< model node x (ux [m], uy [m], rotation [rad]); NaN rotation
                                  ///< where a node has none
  Eigen::MatrixX2d end_rotation;  ///< member x (first, second end) [rad]
  Eigen::MatrixX3d reaction;  ///< support x (Fx, Fy [N], moment [N m]) of the ground on the node
  Eigen::MatrixX3d resultant_start;  ///< member x (N [N], V [N], M [N m]) at its first node
  Eigen::MatrixX3d resultant_end;    ///< the same at its second node
  Eigen::VectorXd member_stress;     ///< largest |N/A| + |M|/W along each member [Pa]
  Eigen::MatrixX3d triangle_stress;  ///< triangle x (sxx, syy, sxy) at its centroid [Pa]
  /// Model node x (sxx, syy, sxy) [Pa]: mean of the stresses that its triangles have there, each
  /// weighted by its area; NaN at nodes without triangles.
  Eigen::MatrixX3d node_stress;
  double equilibrium_residual = 0;  ///< norm of reactions + loads [N]; the same for moments below
  double moment_residual = 0;       ///< about the world origin [N m]
  Evidence evidence;                ///< residuals of the state, in the theory solved
  Counters counters;
};

[[nodiscard]] StaticSolution solve_statics(const System& system,
                                           const StaticsOptions& options = {});

}  // namespace trammel::solver
