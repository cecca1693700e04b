#pragma once

#include <optional>

#include "solver/kinematics.h"
#include "solver/model.h"

/// The 3-RRR builder: a geometry, a pose and the choices the paper leaves open make a Model.
namespace trammel {

struct JointChoice {
  enum class Kind { locked, free, welded, hinged, sprung, eq25_mean, eq25_sum };
  Kind kind = Kind::hinged;
  double stiffness = 0;  ///< sprung only [N m/rad]
};

struct LinkDesign {
  double thickness = 0;  ///< in the plane [m]
  double width = 0;      ///< out of the plane [m]
  Material material;
  double shear_coefficient = 5.0 / 6.0;  ///< Timoshenko only
  BeamTheory theory = BeamTheory::euler_bernoulli;
  MassMatrix mass_matrix = MassMatrix::consistent;
  Index elements = 4;
  bool axially_flexible = true;
  std::optional<double> mass;  ///< printed total, spread over the length [kg]; empty: from density
  std::optional<double> inertia;  ///< printed: J/2 at each end on top of the mass [kg m^2]
};

struct PlatformDesign {
  enum class Kind { rigid, triangles };
  Kind kind = Kind::triangles;
  double thickness = 0;  ///< [m]
  Material material;
  int refinements = 0;    ///< 0: the paper's three triangles; each splits every triangle in four
  double pin_radius = 0;  ///< > 0: P and C_i move with the smooth mean of the plate around them [m]
  std::optional<double> mass;     ///< printed [kg]; empty: from density, thickness and area
  std::optional<double> inertia;  ///< printed, about P [kg m^2]; rigid only
};

struct ManipulatorDesign {
  ManipulatorGeometry geometry;
  std::array<LinkDesign, 3> proximal, distal;
  PlatformDesign platform;
  std::array<JointChoice, 3> active, elbow, platform_joint;
};

/// Builds the planar model of a pose: nodes "A1".."A3", "B1"..., "C1"..., "P"; members
/// "A1-B1"..., "B1-C1"...; supports "A1".."A3".
/// @throws ModelError  where the pose is out of reach or a combination has no meaning.
[[nodiscard]] Model build_manipulator(const ManipulatorDesign& design, const Pose& pose);

}  // namespace trammel
