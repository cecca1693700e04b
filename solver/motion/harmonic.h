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
  /// Rayleigh damping of all coordinates.
  RayleighDamping rayleigh;
  /// Additional damping ratios [-] of the modes with the lowest frequencies, one ratio per mode.
  std::vector<double> modal_ratio;
};

/// Amplitudes of a harmonic response: the largest magnitudes in a vibration cycle.
struct HarmonicAmplitudes {
  Eigen::MatrixX3d displacement;     ///< rows: model nodes; columns: ux, uy [m], rotation [rad]
  Eigen::MatrixX3d resultant_start;  ///< rows: members; columns: N [N], V [N], M [N m]
  Eigen::MatrixX3d resultant_end;
  /// Largest |N / A +- M / W| at the ends of the elements of each member [Pa].
  Eigen::VectorXd member_stress;
};

/// Steady response q(t) = Re(q e^{i omega t}) to loads that vary as cos(omega t). The loads are
/// those of the model, except weight:
///
///   \f[ (K + i \omega C - \omega^2 M) q = f. \f]
///
/// The responses of rigid modes and of modes with a modal damping ratio are superposed. For the
/// part of the load that does not excite these modes, the equation is solved directly. No mode is
/// therefore truncated.
class HarmonicSolver {
 public:
  /// Computes the rigid modes and the modes with a modal damping ratio.
  /// @throws ModelError  if a ratio is negative or infinite, or the model has fewer modes than
  ///   ratios.
  HarmonicSolver(const System& system, const HarmonicDamping& damping);

  /// Returns the outcome of the computation of the modes. singular: a massless coordinate moves
  /// freely; not_converged: modes were not found.
  [[nodiscard]] const Outcome& outcome() const { return outcome_; }
  /// Returns the natural frequencies of the modes with a modal damping ratio, in the order of
  /// `HarmonicDamping::modal_ratio` [Hz].
  [[nodiscard]] Eigen::VectorXd damped_mode_frequencies() const {
    return modes_.frequency.head(damping_.ratio.size());
  }

  /// Computes the complex response of the free coordinates at a frequency [Hz].
  /// @return  empty vector if the equations are singular, and at 0 Hz for a model with rigid modes.
  [[nodiscard]] Eigen::VectorXcd at(double frequency) const;

  /// Returns the backward error of q in the equation of motion (K + i w C - w^2 M) q = f. The
  /// matrices are assembled again, and C includes modal damping.
  [[nodiscard]] double backward_error(const Eigen::VectorXcd& q, double frequency) const;

  /// Returns the largest magnitudes in a vibration cycle of the response q at a frequency [Hz].
  /// Section forces follow from the strains. They are in equilibrium with inertia forces,
  /// mass-proportional damping and loads, each multiplied by 1 / (1 + i w stiffness). Here,
  /// `stiffness` is the coefficient of the stiffness matrix in Rayleigh damping. The forces of
  /// inextensible members are the limit of the forces of extensible members with increasing
  /// stiffness.
  [[nodiscard]] HarmonicAmplitudes amplitudes(const Eigen::VectorXcd& q, double frequency) const;

  [[nodiscard]] const Counters& counters() const { return counters_; }

 private:
  /// Returns the acceleration whose inertia forces equal (i w C - w^2 M) q, where C does not
  /// include stiffness-proportional damping.
  [[nodiscard]] Eigen::VectorXcd equivalent_acceleration(const Eigen::VectorXcd& q,
                                                         double omega) const;

  /// Computes the first `damped_count` modes, which have a modal damping ratio, and the rigid modes
  /// of an unsupported model.
  void compute_modes(Index damped_count);

  const System& system_;
  ViscousDamping damping_;
  ModalSolution modes_;
  // Load amplitudes on the unconstrained coordinates.
  Eigen::VectorXd load_;
  // Modal loads Phi^T f of the superposed modes.
  Eigen::VectorXd participation_;
  // Part of the load that does not excite the superposed modes: f - M Phi Phi^T f.
  Eigen::VectorXd unsuperposed_load_;
  Outcome outcome_;
  // false: the model has zero-energy modes (it is unsupported or a mechanism).
  bool held_ = true;
  mutable Counters counters_;
};

/// Largest amplitude of a harmonic response in an interval of frequencies.
struct HarmonicPeak {
  /// Frequency of the largest amplitude [Hz].
  double frequency = 0;
  /// Largest amplitude, in the unit of the quantity.
  double amplitude = 0;
};

/// Finds the largest amplitude between the frequencies `low` and `high` [Hz]. The amplitude is
/// evaluated at equally spaced frequencies and at `resonances`, which are all natural frequencies
/// in the interval [Hz]. Peaks at other frequencies may be missed. Brent's method then computes the
/// frequency of the peak with a relative error of about 1e-8. `amplitude` returns the amplitude of
/// a response at a frequency.
[[nodiscard]] HarmonicPeak harmonic_peak(
    const HarmonicSolver& response, double low, double high, const std::vector<double>& resonances,
    const std::function<double(const Eigen::VectorXcd&, double)>& amplitude);

}  // namespace trammel::solver
