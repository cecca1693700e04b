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

/// Elastic vibration of the manipulator about its nominal rigid motion along a path (Varalakshmi &
/// Srinivas 2017, Eq. 12-19; rigid platform: Eq. 20-27):
///
///   \f[ M \ddot q + (C + G) \dot q + (K + S) q = T^T F + f(t), \quad C = w_1 M + w_2 K. \f]
///
/// The actuators follow the nominal motion exactly. The displacements u = T q are elastic and
/// relative to this motion. F is the weight and the load on the platform, and f the inertia load of
/// the nominal motion. G and S contain the gyroscopic, centrifugal and Euler terms of the moving
/// links (moving_system.h). These terms form a separate effect.
namespace trammel::solver {

/// Options of an elastodynamic analysis.
struct ElastodynamicsOptions {
  ManipulatorDesign design;
  Path path;
  /// Load on the platform at its reference point P, world axes (Fx, Fy [N], M [N m]).
  Vector3d wrench = Vector3d::Zero();
  /// Factor on the wrench as a function of time; weight and inertia loads are not scaled.
  LoadHistory load_history;
  /// Acceleration of gravity in the plane of motion [m/s^2].
  Vector2d gravity = Vector2d::Zero();
  /// Coefficients w_1 [1/s] and w_2 [s] of the damping matrix C = w_1 M + w_2 K. The default values
  /// are those of Varalakshmi & Srinivas (2017), Eq. 19.
  RayleighDamping damping{.mass = 0.02, .stiffness = 0.003};

  bool nominal_inertia = true;  ///< true: include the inertia load f of the nominal motion
  bool elastic_inertia = true;  ///< true: inertia and damping; false: quasi-static motion
  bool gyroscopic = false;      ///< true: gyroscopic terms; requires `elastic_inertia`

  /// Start, end, step, scheme, error control and sample times of the integration. The elastic
  /// motion starts in quasi-static equilibrium (`quasi_static_start`) or undeformed and at rest.
  TransientOptions time;
  /// true: exact response by superposition of all modes instead of a time scheme. Superposition
  /// requires a platform at rest, so that the matrices are constant.
  bool modal_superposition = false;
};

/// Numbers that indicate the importance of inertia and gyroscopic effects: the largest values over
/// all samples. The numbers are NaN if the model has no elastic mode or its stiffness matrix is
/// singular.
struct ElastodynamicsEffects {
  double first_frequency = kNaN;  ///< lowest elastic frequency at the start [Hz]
  double damping_ratio = kNaN;    ///< damping ratio of the lowest elastic mode
  /// Ratio [-] of the inertia load f of the nominal motion to the weight and platform load F: |f| /
  /// |T^T F| in the norm of K^-1. The ratio is infinite if F is zero.
  double nominal_inertia = 0;
  /// Square of the ratio of the path frequency to the first elastic frequency [-]. The path
  /// frequency is the largest acceleration over the largest velocity of the platform.
  double elastic_inertia = 0;
  /// Twice the largest angular velocity of links and platform, divided by the first natural angular
  /// frequency [-].
  double gyroscopic = 0;
};

/// Solution of an elastodynamic analysis. Each list has one element or row per sample, in the order
/// of `time`.
struct ElastodynamicsSolution {
  /// Failure at a singular or unreachable pose, or the outcome of the time integration in
  /// `summary`.
  Outcome outcome;
  Evidence evidence;
  TransientSummary summary;
  std::vector<double> time;              ///< sample times [s]
  std::vector<TrajectoryPoint> nominal;  ///< nominal motion of the platform
  /// Displacements, reactions, section forces and stresses. Displacements are relative to the
  /// nominal position. Reactions and section forces are in equilibrium with loads, inertia and
  /// damping. The stress of a member is the largest stress at the ends of its elements. `q`
  /// contains the free coordinates.
  std::vector<StaticSolution> state;
  Eigen::MatrixX2d deflection;  ///< elastic displacement of P, world axes [m]
  /// Deflection of the platform point P without elastic inertia and damping, from K q = T^T F + f
  /// [m]; NaN if K is singular.
  Eigen::MatrixX2d quasi_static_deflection;
  /// Components of the deflection of the platform point P [m]: along its nominal velocity, and
  /// normal to this velocity, positive to the left. Both components are NaN at zero velocity.
  Eigen::VectorXd tangential_error, normal_error;
  Eigen::VectorXd platform_rotation;  ///< mean elastic rotation of the triangle C1 C2 C3 [rad]
  Eigen::MatrixX3d torque;            ///< torques of the actuators on the proximal links [N m]
  Eigen::MatrixX3d rigid_torque;      ///< torques with rigid links and free passive joints [N m]
  /// Energies of the elastic motion. The work is NaN if links are inextensible and the platform
  /// moves without gyroscopic terms. The work then depends on the choice of free coordinates.
  std::vector<MotionEnergy> energy;
  ElastodynamicsEffects effects;
};

/// Computes the elastic motion of the manipulator along its path.
/// @throws ModelError  as `build_manipulator`, `at` and `solve_transient`; also if modal
///   superposition is requested for a moving platform, or gyroscopic terms without elastic inertia.
[[nodiscard]] ElastodynamicsSolution solve_elastodynamics(const ElastodynamicsOptions& options);

/// Computes deflection, path errors, platform rotation and actuator torques from the states and the
/// nominal motion of `solution`, and stores them in `solution`.
void set_platform_motion(const ManipulatorGeometry& geometry, ElastodynamicsSolution& solution);

}  // namespace trammel::solver
