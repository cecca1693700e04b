#include "solver/motion/rotating_frame_transient.h"

#include "solver/linalg/factorization.h"
#include "solver/linear/element_operators.h"
#include "solver/linear/free_motions.h"
#include "solver/linear/rotating_frame.h"
#include "solver/linear/second_order.h"

namespace trammel::solver {
namespace {

using Eigen::VectorXd;

/// Returns the linearized displacements of all nodes for a rotation of the model by 1 rad about the
/// center.
VectorXd unit_rotation(const System& system, const Vector2d& center) {
  VectorXd rotation = VectorXd::Zero(system.T.rows());
  for (std::size_t i = 0; i < system.coordinates.node.size(); ++i) {
    const Vector2d arm = system.mesh.positions[i] - center;
    rotation[system.coordinates.node[i][0]] = -arm.y();
    rotation[system.coordinates.node[i][1]] = arm.x();
  }
  for (std::size_t k = 0; k < system.coordinates.is_rotation.size(); ++k) {
    if (system.coordinates.is_rotation[k]) rotation[static_cast<Index>(k)] = 1;
  }
  return rotation;
}

/// Computes K_1, the geometric stiffness matrix of the centrifugal forces at 1 rad/s, by linear
/// statics.
Outcome unit_stiffening(const System& system, const RotatingFrame& unit, SparseMatrix& K_1) {
  if (Outcome determined = require_determinate_prestress(system); !determined.solved())
    return determined;
  const VectorXd force = centrifugal_forces(system, unit, VectorXd::Zero(system.T.rows()));
  const VectorXd on_q = system.T.transpose() * force;
  Factorization factorization;
  factorization.compute(system.K);
  Counters counters;
  if (Outcome held = require_no_mechanism(system, factorization, counters); !held.solved()) {
    held.reason = "the centrifugal forces have no static equilibrium: " + held.reason;
    return held;
  }
  const VectorXd u = system.T * factorization.solve(on_q);
  const BodyForces body = body_forces(system, unit, VectorXd::Zero(u.size()));
  K_1 = geometric_stiffness(system, prestress_of(system, u, force, body));
  return {};
}

}  // namespace

Outcome add_rotating_frame_terms(const System& system, const PrescribedRotation& rotation,
                                 EquationOfMotion& equation) {
  if (!system.load.isZero(0))
    throw ModelError("loads are not supported in a rotating frame: they would not rotate with it");
  const RotatingFrame unit{1, rotation.center, RotationAxis::normal};
  SparseMatrix K_1(system.K.rows(), system.K.cols());
  if (rotation.stiffening) {
    const Outcome statics = unit_stiffening(system, unit, K_1);
    if (!statics.solved()) return statics;
  }
  const SparseMatrix G = gyroscopic_matrix(system);
  const SparseMatrix added = K_1 - centrifugal_softening(system);
  SparseMatrix C = equation.C;
  if (C.size() == 0) C.resize(system.K.rows(), system.K.cols());
  // Create a common sparsity pattern. A sum of sparse matrices contains the positions of all
  // entries of its terms, including zeros.
  SparseMatrix zero = system.M + system.K + C + G + added;
  zero.coeffs().setZero();
  const auto values = [&zero](const SparseMatrix& A) {
    const SparseMatrix sum = A + zero;
    return sum.coeffs().eval();
  };
  const Eigen::ArrayXd c = values(C), k = values(system.K), g = values(G), s = values(added);
  equation.M = system.M + zero;
  equation.C = C + zero;
  equation.K = system.K + zero;
  equation.update = [speed = rotation.speed, c, k, g, s](double time, SparseMatrix&,
                                                         SparseMatrix& damping,
                                                         SparseMatrix& stiffness) {
    const auto [W, W_dot] = speed(time);
    damping.coeffs() = c + 2 * W * g;
    stiffness.coeffs() = k + W * W * s + W_dot * g;
  };
  const VectorXd centrifugal =
      system.T.transpose() * centrifugal_forces(system, unit, VectorXd::Zero(system.T.rows()));
  const VectorXd euler =
      -(system.T.transpose() * inertia_forces(system, unit_rotation(system, rotation.center)));
  equation.load = [speed = rotation.speed, centrifugal, euler](double time, VectorXd& f) {
    const auto [W, W_dot] = speed(time);
    f = W * W * centrifugal + W_dot * euler;
  };
  return {};
}

}  // namespace trammel::solver
