#pragma once

#include <Eigen/Core>

#include "solver/assembly/system.h"
#include "solver/model/effects.h"

namespace trammel::solver {

/// Shares of the energies of one motion that belong to an effect.
class EnergyShares {
 public:
  /// @param x  free coordinates;  @param energy  what the shares are of: for x^T M x = 1 the square
  ///           of the angular frequency, in statics x^T K x
  EnergyShares(const System& system, const Eigen::VectorXd& x, double energy)
      : system_(system), u_(system.T * x), energy_(energy) {}

  /// K_e x of a flexibility, on the unconstrained coordinates [N, N m].
  [[nodiscard]] Eigen::VectorXd forces(Effect effect) const;
  /// x^T K_e x over the energy.
  [[nodiscard]] double elastic(Effect effect) const;

  /// x^T M_e x of the members; or of the rotation of their sections alone.
  [[nodiscard]] double kinetic(bool rotary_only) const;

 private:
  const System& system_;
  Eigen::VectorXd u_;
  double energy_;
};

/// How much of each of an element's three deformations is the effect's; the last is antisymmetric
/// bending.
[[nodiscard]] Vector3d deformation_share(const System& system, const FrameElement& e,
                                         Effect effect);

/// The relative change of a frequency without an effect that has the share s of its energy:
/// (1 - s)^(1/2) - 1 of a stiffness, (1 - s)^(-1/2) - 1 of a flexibility or an inertia.
[[nodiscard]] double frequency_change_without(Effect effect, double share);

}  // namespace trammel::solver
