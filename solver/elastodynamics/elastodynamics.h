#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/elastodynamics/elastodynamics_options.h"
#include "solver/model/numbers.h"
#include "solver/statics/statics.h"

/// Elastic vibration of the manipulator about its nominal rigid motion along a path (paper Eq.
/// 12-19, with the rigid platform of Eq. 20-27):
///   M(t) q.. + (C(t) + G(t)) q. + (K(t) + S(t)) q = T^T F + f(t),   C = w1 M + w2 K,
/// where the joints follow the path exactly, F is the load on the platform, f the inertia of the
/// nominal motion, and G and S the gyroscopic, centrifugal and Euler terms of the moving links
/// (moving_system.h), an effect of their own.
namespace trammel::solver {

/// Numbers without dimension that say when an effect matters; the largest over the samples. NaN
/// where there is no such number: no elastic mode was found, or the stiffness is singular.
struct ElastodynamicsEffects {
  double first_frequency = kNaN;  ///< at the start [Hz]
  double damping_ratio = kNaN;    ///< of that mode
  double nominal_inertia = 0;     ///< |f| / |T^T F| in the norm of K^-1; infinite without a load
  double elastic_inertia = 0;     ///< path frequency over the first frequency, squared
  double gyroscopic = 0;          ///< twice the fastest turning of a part over the first frequency
};

/// One entry a sample, as many as `time`.
struct ElastodynamicsSolution {
  Outcome outcome;  ///< a pose out of reach or singular; or as in `summary`
  Evidence evidence;
  TransientSummary summary;
  std::vector<double> time;              ///< [s]
  std::vector<TrajectoryPoint> nominal;  ///< of P
  /// Everything that `solve_statics` gives, in motion: displacements from the nominal position,
  /// reactions and section forces in equilibrium with inertia and damping. A member's stress is
  /// the largest at the ends of its elements. `q` are the free coordinates.
  std::vector<StaticSolution> state;
  Eigen::MatrixX2d deflection;  ///< of P, world axes [m]
  /// The same without elastic inertia and damping, K q = F + f; NaN for a mechanism.
  Eigen::MatrixX2d quasi_static_deflection;
  /// Deflection of P along the nominal velocity and to the left of it [m]; NaN at a standstill.
  Eigen::VectorXd tangential_error, normal_error;
  Eigen::VectorXd platform_rotation;  ///< mean elastic rotation of C1 C2 C3 about P [rad]
  Eigen::MatrixX3d torque;            ///< of the actuators on the proximal links: reactions [N m]
  Eigen::MatrixX3d rigid_torque;      ///< the same of rigid links with free passive joints [N m]
  /// No work where inextensible links move without gyroscopic terms: NaN.
  std::vector<MotionEnergy> energy;
  ElastodynamicsEffects effects;
};

/// @throws ModelError  as `build_manipulator`, `at` and `solve_transient`; for modal superposition
///                     of a platform that moves; for gyroscopic terms without elastic inertia.
[[nodiscard]] ElastodynamicsSolution solve_elastodynamics(const ElastodynamicsOptions& options);

}  // namespace trammel::solver
