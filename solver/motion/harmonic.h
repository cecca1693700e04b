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
  /// Additional damping ratios of the first modes, one ratio per mode [-].
  std::vector<double> modal_ratio;
};

/// Amplitudes of a harmonic response: largest magnitudes over a cycle.
struct HarmonicAmplitudes {
  Eigen::MatrixX3d displacement;     ///< rows: model nodes; columns: ux, uy [m], rotation [rad]
  Eigen::MatrixX3d resultant_start;  ///< rows: members; columns: N [N], V [N], M [N m]
  Eigen::MatrixX3d resultant_end;
  Eigen::VectorXd member_stress;  ///< largest |N / A +- M / W| at the ends of elements [Pa]
};

/// Steady response q(t) = Re(q e^{i omega t}) to the loads of the model, except weight, that vary
/// as cos(omega t):
///
///   \f[ (K + i \omega C - \omega^2 M) q = f. \f]
///
/// The responses of rigid modes and of modes with a modal damping ratio are superposed. The
/// equation is solved directly for the part of the load that does not excite these modes. No mode
/// is therefore truncated.
class HarmonicSolver {
 public:
  /// Computes the modes with a modal damping ratio, and rigid modes.
  /// @throws ModelError  if a ratio is negative or infinite, or there are fewer modes than ratios.
  HarmonicSolver(const System& system, const HarmonicDamping& damping);

  /// Returns the outcome of the computation of the modes. singular: the model is a mechanism;
  /// not_converged: modes were not found.
  [[nodiscard]] const Outcome& outcome() const { return outcome_; }
  /// Returns the natural frequencies of the modes with a modal damping ratio, in the order of
  /// `HarmonicDamping::modal_ratio` [Hz].
  [[nodiscard]] Eigen::VectorXd damped_mode_frequencies() const {
    return modes_.frequency.head(damping_.ratio.size());
  }

  /// Computes the complex response of the free coordinates at a frequency [Hz].
  /// @return  empty at an exact resonance of an undamped mode, and at 0 Hz for a model with rigid
  ///   modes.
  [[nodiscard]] Eigen::VectorXcd at(double frequency) const;

  /// Returns the backward error of the equation of motion (K + i w C - w^2 M) q = f. The matrices
  /// are assembled again, and C includes modal damping.
  [[nodiscard]] double backward_error(const Eigen::VectorXcd& q, double frequency) const;

  /// Returns the largest magnitudes over a cycle of the response q at a frequency [Hz]. Section
  /// forces follow from the strains. They balance inertia forces, mass-proportional damping and
  /// loads, times 1 / (1 + i w stiffness), where stiffness is the factor of stiffness-proportional
  /// damping. The forces of inextensible members are the limit of those of extensible members with
  /// increasing stiffness.
  [[nodiscard]] HarmonicAmplitudes amplitudes(const Eigen::VectorXcd& q, double frequency) const;

  [[nodiscard]] const Counters& counters() const { return counters_; }

 private:
  /// Returns the acceleration whose inertia forces are (i w C - w^2 M) q, without
  /// stiffness-proportional damping.
  [[nodiscard]] Eigen::VectorXcd equivalent_acceleration(const Eigen::VectorXcd& q,
                                                         double omega) const;

  /// Computes the first `damped_count` modes, which have a modal damping ratio, and the rigid modes
  /// of an unsupported model.
  void compute_modes(Index damped_count);

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

/// Finds the largest amplitude between the frequencies `low` and `high` [Hz]. The interval is
/// scanned at equal steps and at the `resonances`, which are all natural frequencies in the
/// interval [Hz]. Peaks at other frequencies may be missed. Brent's method then determines the peak
/// to about 1e-8 of the frequency. `amplitude` returns the amplitude of a response at a frequency.
[[nodiscard]] HarmonicPeak harmonic_peak(
    const HarmonicSolver& response, double low, double high, const std::vector<double>& resonances,
    const std::function<double(const Eigen::VectorXcd&, double)>& amplitude);

}  // namespace trammel::solver
