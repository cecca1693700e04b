#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/linear/row_balance.h"
#include "solver/linear/statics.h"
#include "solver/manipulator/manipulator.h"
#include "solver/manipulator/trajectory.h"
#include "solver/model/numbers.h"
#include "solver/motion/equation_of_motion.h"
#include "solver/motion/transient.h"

/// Elastic vibration of the manipulator about its nominal rigid motion along a path (paper Eq.
/// 12-19, with the rigid platform of Eq. 20-27):
///   M(t) q.. + (C(t) + G(t)) q. + (K(t) + S(t)) q = T^T F + f(t),   C = w1 M + w2 K,
/// where the joints follow the path exactly, F is the load on the platform, f the inertia of the
/// nominal motion, and G and S the gyroscopic, centrifugal and Euler terms of the moving links
/// (moving_system.h), an effect of their own.
namespace trammel::solver {

struct ElastodynamicsOptions {
  ManipulatorDesign design;
  Path path;
  Vector3d wrench = Vector3d::Zero();   ///< on the platform at P, world axes (Fx, Fy [N], M [N m])
  LoadHistory load_history;             ///< on the wrench, not on weight and inertia
  Vector2d gravity = Vector2d::Zero();  ///< in the plane [m/s^2]
  RayleighDamping damping{.mass = 0.02, .stiffness = 0.003};  ///< as printed, Eq. 19

  bool nominal_inertia = true;  ///< f, Eq. 14-17
  bool elastic_inertia = true;  ///< M q.., and with it damping; off: quasi-static, K q = F + f
  bool gyroscopic = false;      ///< G and S; a part of elastic inertia, without which it is refused

  /// start, end, step, scheme, error control, samples; `quasi_static_start` or at rest.
  TransientOptions time;
  /// The exact response instead of a scheme: all modes superposed. Only where the platform stands
  /// still, so that the matrices are constant.
  bool modal_superposition = false;
};

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

/// Fills deflection, path errors, platform rotation and actuator torques from states and nominal
/// motion.
void set_platform_motion(const ManipulatorGeometry& geometry, ElastodynamicsSolution& solution);

}  // namespace trammel::solver
