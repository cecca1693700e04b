#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "solver/linear/modes.h"
#include "solver/linear/row_balance.h"
#include "solver/linear/system.h"
#include "solver/model/evidence.h"

namespace trammel::solver {

/// Damping of a harmonic response.
struct HarmonicDamping {
  RayleighDamping rayleigh;  ///< acts on all coordinates
  /// Additional damping ratios of the first modes, one by one [-].
  std::vector<double> modal_ratio;
};

/// Amplitudes over a cycle.
struct HarmonicAmplitudes {
  Eigen::MatrixX3d displacement;     ///< model node x (ux, uy [m], rotation [rad])
  Eigen::MatrixX3d resultant_start;  ///< member x (N [N], V [N], M [N m])
  Eigen::MatrixX3d resultant_end;
  Eigen::VectorXd member_stress;  ///< largest |N / A +- M / W| at the ends of elements [Pa]
};

/// Steady response q(t) = Re(q e^{i omega t}) to the loads of the model, except weight, that vary
/// as cos(omega t):
///
///   \f[ (K + i \omega C - \omega^2 M) q = f. \f]
///
/// Modes with a damping ratio and rigid modes are superposed. The equation is solved directly for
/// the remaining load, so that no mode is truncated.
class HarmonicSolver {
 public:
  /// Computes the required modes.
  /// @throws ModelError  if a ratio is negative or infinite, or there are fewer modes than ratios.
  HarmonicSolver(const System& system, const HarmonicDamping& damping);

  /// Returns the outcome. singular: a mechanism; not_converged: some modes were not found.
  [[nodiscard]] const Outcome& outcome() const { return outcome_; }
  /// Returns the frequencies of the damped modes [Hz].
  [[nodiscard]] Eigen::VectorXd frequencies() const {
    return modes_.frequency.head(damping_.ratio.size());
  }

  /// Computes the complex response of the free coordinates.
  /// @param frequency  [Hz].
  /// @return  empty at an exact resonance of an undamped mode, and at 0 Hz for a model with rigid
  ///   modes.
  [[nodiscard]] Eigen::VectorXcd at(double frequency) const;

  /// Returns the backward error of (K + i w C - w^2 M) q = f. The matrices are computed again, and
  /// C includes modal damping.
  [[nodiscard]] double backward_error(const Eigen::VectorXcd& q, double frequency) const;

  /// Returns amplitudes over a cycle. Section forces follow from the strains. They balance inertia,
  /// mass-proportional damping and loads, times 1 / (1 + i w stiffness). The forces of inextensible
  /// members are the limit of those of extensible members with increasing stiffness.
  /// @param q  response at `frequency`.
  /// @param frequency  [Hz].
  [[nodiscard]] HarmonicAmplitudes amplitudes(const Eigen::VectorXcd& q, double frequency) const;

  [[nodiscard]] const Counters& counters() const { return counters_; }

 private:
  /// Returns the acceleration whose inertia forces are (i w C - w^2 M) q, without
  /// stiffness-proportional damping.
  [[nodiscard]] Eigen::VectorXcd acceleration(const Eigen::VectorXcd& q, double omega) const;

  /// Computes the modes with a damping ratio, and the rigid modes of an unsupported model.
  void compute_modes(Index damped);

  const System& system_;
  ViscousDamping damping_;
  ModalSolution modes_;
  Eigen::VectorXd load_;               // on the unconstrained coordinates
  Eigen::VectorXd participation_;      // Phi^T f
  Eigen::VectorXd unsuperposed_load_;  // f - M Phi Phi^T f
  Outcome outcome_;
  bool held_ = true;  // false: the model has zero-energy modes (unsupported or a mechanism)
  mutable Counters counters_;
};

/// Peak of a harmonic response.
struct HarmonicPeak {
  double frequency = 0;  ///< [Hz]
  double amplitude = 0;  ///< in the unit of the quantity
};

/// Finds the largest amplitude between two frequencies. The interval is scanned at equal steps and
/// at the resonances. Brent's method then determines the peak to about 1e-8 of the frequency.
/// @param response  solver of the response.
/// @param low  lowest frequency [Hz].
/// @param high  highest frequency [Hz].
/// @param resonances  all natural frequencies in the interval [Hz]; peaks at unlisted ones may be
///   missed.
/// @param amplitude  amplitude of a response at a frequency [Hz].
[[nodiscard]] HarmonicPeak harmonic_peak(
    const HarmonicSolver& response, double low, double high, const std::vector<double>& resonances,
    const std::function<double(const Eigen::VectorXcd&, double)>& amplitude);

}  // namespace trammel::solver
