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

/// The relative change of a frequency without a flexibility or an inertia that has the share s of
/// its energy, (1 - s)^(-1/2) - 1.   Source: Rayleigh, The Theory of Sound (1894), arts. 88-90.
[[nodiscard]] double frequency_change_without(double share);

}  // namespace trammel::solver
