#pragma once

#include <numbers>
#include <random>

#include "solver/manipulator/manipulator.h"
#include "solver/manipulator/rigid_dynamics.h"

/// Manipulators for tests, such as that of Table 1 of Varalakshmi and Srinivas (2017).
namespace trammel::solver {

inline ManipulatorGeometry table_1_geometry() {
  ManipulatorGeometry g;
  g.base = equilateral_base(0.5);
  g.platform = equilateral_platform(0.2);
  g.proximal = {0.2, 0.2, 0.2};
  g.distal = {0.2, 0.2, 0.2};
  return g;
}

/// Returns a geometry without symmetry: unequal links, base and platform, P off the centroid, and
/// different working modes of the limbs.
inline ManipulatorGeometry uneven_geometry() {
  ManipulatorGeometry g;
  g.base = {Vector2d{0.02, -0.01}, Vector2d{0.61, 0.03}, Vector2d{0.2, 0.47}};
  g.platform = {Vector2d{-0.07, -0.06}, Vector2d{0.11, -0.04}, Vector2d{0.02, 0.1}};
  g.proximal = {0.24, 0.27, 0.21};
  g.distal = {0.2, 0.25, 0.3};
  g.working_mode = {-1, 1, -1};
  return g;
}

/// Returns the pose at the centroid of the base.
inline Pose centered_pose(double phi = 0) {
  return {0.25, 0.25 / std::numbers::sqrt3, phi};
}

/// Returns the design of Table 1: locked actuators, welded elbows, hinged platform joints, masses
/// from density.
inline ManipulatorDesign table_1_design() {
  const Material al_1060{6.9e10, 2700, 0.33};
  LinkDesign link;
  link.thickness = 0.0015;
  link.width = 0.03;
  link.material = al_1060;
  ManipulatorDesign design;
  design.geometry = table_1_geometry();
  design.proximal.fill(link);
  design.distal.fill(link);
  design.platform.thickness = 0.0015;
  design.platform.material = al_1060;
  design.active.fill({ActiveKind::locked});
  design.elbow.fill({ElbowKind::welded});
  design.platform_joint.fill({PlatformJointKind::hinged});
  return design;
}

/// Returns the design of Table 1 with this number of elements in each link.
inline ManipulatorDesign meshed_design(Index elements,
                                       PlatformKind platform = PlatformKind::rigid) {
  ManipulatorDesign design = table_1_design();
  design.platform.kind = platform;
  for (auto* links : {&design.proximal, &design.distal})
    for (LinkDesign& link : *links) link.elements = elements;
  return design;
}

/// Returns unequal links with centers of mass off the middle, and P off the platform's center of
/// mass.
inline RigidManipulator uneven_bodies() {
  RigidManipulator m;
  m.geometry = uneven_geometry();
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<double>(k);
    m.proximal[k] = {0.02 + 0.01 * i, 0.07 + 0.02 * i, 1e-4 + 3e-5 * i};
    m.distal[k] = {0.03 - 0.005 * i, 0.12 - 0.01 * i, 2e-4 - 4e-5 * i};
  }
  m.platform = {0.12, 7e-4, Vector2d(0.01, -0.02)};
  return m;
}

/// Generator of random poses, velocities and accelerations of the platform from a seed. Poses are
/// near the middle of the workspace. Velocities are of the order of 1 m/s and 1 rad/s.
class RandomStates {
 public:
  explicit RandomStates(unsigned seed) : engine_(seed) {}
  Vector3d vector() {
    std::uniform_real_distribution<double> uniform(-1, 1);
    const double x = uniform(engine_), y = uniform(engine_);
    return {x, y, uniform(engine_)};
  }
  Pose pose() {
    const Vector3d v = vector();
    return {0.26 + 0.03 * v(0), 0.145 + 0.03 * v(1), 0.25 * v(2)};
  }
  TrajectoryPoint point() {
    TrajectoryPoint p;
    p.pose = pose();
    p.velocity = vector();
    p.acceleration = 3 * vector();
    return p;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace trammel::solver
