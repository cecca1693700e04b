#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/linear/system.h"
#include "solver/manipulator/elastodynamics.h"
#include "solver/model/effects.h"
#include "solver/model/evidence.h"

namespace trammel::solver {

/// What a scene would lose without an effect, to first order.
struct EffectEstimate {
  Effect effect{};
  double number = 0;  ///< without dimension: why it is so
  double change = 0;  ///< of the results, relative
};

struct EffectEstimates {
  Outcome outcome;  ///< without a linear solution there are no estimates
  std::vector<EffectEstimate> effects;
  /// At most what large displacement changes of the motion without vibration; relative.
  double large_displacement_bound = 0;
  /// What that means for the motion: the factor of such a change, and what is beside it.
  double large_displacement_growth = 1, large_displacement_beside = 0;
  std::vector<double> extreme_times;  ///< of the response [s]
  Counters counters;
};

// What a motion would lose without an effect, to first order. Numbers without dimension: with the
// first angular frequency w1 and damping ratio z, how fast the path turns W, the time T.

/// Elastodynamics along a path, at some poses of it and where the response is largest. The
/// quasi-static response q_s, K q_s = F + f, and its rates say what is left out as a small load
/// would:
///   inertia -K^-1 (M q_s.. + C q_s.), damping -K^-1 C q_s., gyroscopic forces -K^-1 (G q_s. + S
///   q_s), weights and masses of links by the loads that they are; a flexibility by the load K_e
///   q_s of its part K_e of K, and its share of the strain energy (springs in series). C = w2 K in
///   world axes drags along what turns: members that stretch give way by w2 theta. of their
///   deflection;
/// each by the largest translation and, where loads change, in the norm of K, over the largest q_s,
/// times the amplification of a steady vibration, 1 / sqrt((1 - r^2)^2 + (2 z r)^2), r = W / w1,
/// where that is larger than one.
/// Inertia and damping count 1 + exp(-pi z) times: what starts on q_s swings about the response
/// beside it. What the start or the motion sets vibrating, a share v of q_s, loses step with itself
/// by the change of its frequency w that the effect means (Rayleigh), for as long as it lasts, the
/// smaller of T and 1 / (e z w); undamped it does not die away, by 1 - exp(-z w T); gyroscopic
/// forces turn modes into each other at the rate x_i^T (G + S / w_i) x_j / 2, for no longer than
/// they keep step, 1 / |w_i - w_j|. From a start on q_s it is the first mode with what inertia
/// makes of q_s; where load and inertia set in at once, the first 16 modes, each with its share of
/// q_s, and what is left twice: translations are added, energies are orthogonal. Platform and
/// joints have modes of their own, of w1 / sqrt(share of the strain energy) at least: from rest
/// they stay flexible, from q_s such a mode takes up at most the speed W, 2 W / w of the force.
/// Where a harmonic of the path may resonate with a mode, (W / w)^2 > 0.1, the response consists of
/// vibrations of the mean age min(T / 2, 1 / (z w)), which lose step in that time; loads that are
/// left out grow at most min(1 / (2 z), w1 T / 2) times. A change c by large displacement is that
/// many times larger where the response is, and changes frequencies by c / 2.
///   Source: quasi-static expansion, e.g. L. Meirovitch, Analytical Methods in Vibrations (1967).
/// @param options  the whole motion, gyroscopic terms included; what `applicable` lacks is not
/// there
[[nodiscard]] EffectEstimates estimate_motion_effects(const ElastodynamicsOptions& options,
                                                      Effects applicable);

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
