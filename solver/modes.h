#pragma once

#include <Eigen/Core>

#include "solver/outcome.h"
#include "solver/system.h"

namespace trammel {

enum class EigenPath { automatic, dense, sparse };

struct ModesOptions {
  Index count = 6;
  EigenPath path = EigenPath::automatic;  ///< automatic: dense below a few hundred free coordinates
};

/// Free vibration K x = w^2 M x (paper Eq. 28, 29), x^T M x = 1 (Eq. 33).
struct ModalSolution {
  Outcome outcome;  ///< not_converged: fewer modes than the inertia count says there are
  Eigen::VectorXd
      frequency;  ///< ascending, copies of repeated ones included [Hz]; rigid motions are 0
  Eigen::VectorXd roundoff;        ///< estimate of each frequency's relative round-off error [-]
  Eigen::MatrixXd shape;           ///< free coordinate x mode
  Index rigid_motions = 0;         ///< how many leading frequencies are zero
  std::string rigid_motion_words;  ///< what they are, in words
  Index inertia_count = 0;         ///< eigenvalues below the check shift, by sparse LDL^T
  Counters counters;
};

[[nodiscard]] ModalSolution solve_modes(const System& system, const ModesOptions& options);

/// Node motions of one mode: model node x (ux, uy, rotation), as in StaticSolution.
[[nodiscard]] Eigen::MatrixX3d node_motion(const System& system, const Eigen::VectorXd& q);

}  // namespace trammel
