#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "solver/linear/modes.h"
#include "solver/linear/row_balance.h"
#include "solver/linear/system.h"
#include "solver/model/evidence.h"

namespace trammel::solver {

struct HarmonicDamping {
  RayleighDamping rayleigh;         ///< acts on everything
  std::vector<double> modal_ratio;  ///< and these on the first modes, one by one [-]
};

/// Amplitudes over a cycle.
struct HarmonicAmplitudes {
  Eigen::MatrixX3d displacement;     ///< model node x (ux, uy [m], rotation [rad])
  Eigen::MatrixX3d resultant_start;  ///< member x (N [N], V [N], M [N m])
  Eigen::MatrixX3d resultant_end;
  Eigen::VectorXd member_stress;  ///< largest |N / A +- M / W| at the ends of its elements [Pa]
};

/// Steady response q(t) = Re(q e^{i w t}) to the model's loads, but weight, varying as cos(w t):
///   (K + i w C - w^2 M) q = f.
/// Modes with a damping ratio and motions of the whole that deform nothing are superposed; what
/// they leave of the load is solved for directly, so that no mode is cut off.
class HarmonicSolver {
 public:
  /// @throws ModelError  for a negative or infinite ratio, or fewer modes than ratios.
  HarmonicSolver(const System& system, const HarmonicDamping& damping);

  /// singular: a mechanism; not_converged: the modes are not all found
  [[nodiscard]] const Outcome& outcome() const { return outcome_; }
  /// Of the damped modes [Hz].
  [[nodiscard]] Eigen::VectorXd frequencies() const {
    return modes_.frequency.head(damping_.ratio.size());
  }

  /// @param frequency  [Hz]
  /// @return  empty where the undamped rest resonates exactly, and at 0 Hz where nothing holds the
  ///          model
  [[nodiscard]] Eigen::VectorXcd at(double frequency) const;

  /// Backward error of (K + i w C - w^2 M) q = f with the matrices formed afresh, C with the modes'
  /// damping.
  [[nodiscard]] double backward_error(const Eigen::VectorXcd& q, double frequency) const;

  /// Section forces are those of the strains: 1 / (1 + i w stiffness) of what balances inertia,
  /// damping in proportion to mass and loads. Inextensible members bear what extensible ones bear
  /// in the limit.
  /// @param q  the response at `frequency` [Hz]
  [[nodiscard]] HarmonicAmplitudes amplitudes(const Eigen::VectorXcd& q, double frequency) const;

  [[nodiscard]] const Counters& counters() const { return counters_; }

 private:
  /// What has the inertia forces (i w C - w^2 M) q, but for damping in proportion to stiffness.
  [[nodiscard]] Eigen::VectorXcd acceleration(const Eigen::VectorXcd& q, double omega) const;

  /// Those with a ratio, and the motions of a model that is not held.
  void superpose(Index damped);

  const System& system_;
  ViscousDamping damping_;
  ModalSolution modes_;
  Eigen::VectorXd load_;               // on the unconstrained coordinates
  Eigen::VectorXd participation_;      // Phi^T f
  Eigen::VectorXd unsuperposed_load_;  // f - M Phi Phi^T f
  Outcome outcome_;
  bool held_ = true;  // nothing moves without deforming
  mutable Counters counters_;
};

struct HarmonicPeak {
  double frequency = 0;  ///< [Hz]
  double amplitude = 0;  ///< in the unit of what is looked at
};

/// The largest amplitude between two frequencies: scanned at even steps and at the resonances, then
/// closed in on by Brent's method to about 1e-8 of the frequency.
/// @param resonances  natural frequencies, all that lie between; where some are not known their
///                    peaks may be missed [Hz]
/// @param amplitude  of a response at a frequency [Hz]
[[nodiscard]] HarmonicPeak harmonic_peak(
    const HarmonicSolver& response, double low, double high, const std::vector<double>& resonances,
    const std::function<double(const Eigen::VectorXcd&, double)>& amplitude);

}  // namespace trammel::solver
