#pragma once

#include "solver/assembly/damping.h"
#include "solver/manipulator/manipulator.h"
#include "solver/manipulator/trajectory.h"
#include "solver/time/load_history.h"
#include "solver/time/transient.h"

/// What vibrates along which path, under which loads, and with which terms of the equation of
/// motion (elastodynamics.h).
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

}  // namespace trammel::solver
