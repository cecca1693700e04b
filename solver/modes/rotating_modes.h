#pragma once

#include <Eigen/Core>

#include "solver/assembly/rotating_frame.h"
#include "solver/assembly/system.h"
#include "solver/linalg/eigenpairs.h"
#include "solver/model/evidence.h"

namespace trammel::solver {

struct RotatingOptions {
  RotatingFrame frame;
  Index count = 6;
  EigenMethod method =
      EigenMethod::automatic;  ///< of a stable state; an unstable one is always dense
  bool gyroscopic = true;      ///< false: leaves G out
  bool stiffening = true;      ///< false: leaves K_G out
  /// K_G from the forces in the steady state; false: from those of linear statics under the
  /// centrifugal forces on the undeformed frame, as the classical equations of blades have it.
  bool prestress_at_steady_state = true;
};

/// Small vibration of a frame that rotates steadily, seen from it, about its steady state:
///   (K + K_G - W^2 S) q = f + W^2 f_c,   and with that K_G
///   (K + K_G - W^2 S + i w 2 W G - w^2 M) x = 0
/// (rotating_frame.h for S, G, f_c). The supports rotate with the frame; the geometry is the
/// undeformed one.
///
/// Stable states have real w: a Hermitian problem in 1 / w, of which none is missed, for the matrix
/// above at a w just beyond the last has as many negative pivots as there are below it.
struct RotatingModes {
  Outcome outcome;              ///< singular: a mechanism; not_converged: see the reason
  Eigen::VectorXd q;            ///< steady state, free coordinates; see node_motion
  bool stable = true;           ///< false where a motion grows
  Eigen::VectorXd frequency;    ///< ascending [Hz]; 0 for what grows without turning over
  Eigen::VectorXd growth_rate;  ///< of each [1/s]; 0 in a stable state
  Eigen::MatrixXcd shape;       ///< free coordinate x mode, q(t) = Re(x e^{i w t}), |x| = 1
  Evidence evidence;
  Counters counters;
};

[[nodiscard]] RotatingModes solve_rotating_modes(const System& system,
                                                 const RotatingOptions& options);

}  // namespace trammel::solver
