#pragma once

#include <array>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "solver/model/model.h"

/// Additions to a `Model` for large motion: drives, torques, sliding joints, springs along a line,
/// follower loads, load history, damping and initial velocities. All quantities are in SI units and
/// refer to the pose of the model.
namespace trammel::solver::large_motion {

/// Prescribed displacement or rotation as a function of time, or of the load factor in statics. The
/// function returns the value and its first and second derivatives.
using TimeFunction = std::function<std::array<double, 3>(double)>;

/// Displacement or rotation of a node relative to another node or the ground (-1), prescribed as a
/// function of time. Its multiplier is the force or torque that the structure exerts on the drive.
struct Drive {
  std::string name;
  Index node = 0;
  int direction = 2;  ///< 0: x [m], 1: y [m], 2: rotation [rad]
  TimeFunction law;
  Index from = -1;
};

/// Torque on a node as a function of time, independent of the load factor.
struct Torque {
  std::string name;
  Index node = 0;
  std::function<double(double)> law;  ///< torque [N m] as a function of time [s]
};

/// Node that slides along a line through its position in the pose of the model. The line turns with
/// the node `rail`, or is fixed (-1).
struct Slider {
  std::string name;
  Index node = 0;
  Index rail = -1;
  double direction = 0;      ///< direction of the line in the pose of the model [rad]
  bool keeps_angle = false;  ///< true: prismatic joint, the node rotates with the rail
};

/// Spring along the line between two nodes.
struct LineSpring {
  std::string name;
  std::array<Index, 2> nodes{-1, -1};
  double stiffness = 0;  ///< stiffness along the line [N/m]
  /// Length of the spring without force [m]; NaN: the distance of its nodes in the pose of the
  /// model.
  double rest_length = std::numeric_limits<double>::quiet_NaN();
};

/// Force and moment on a node that rotate with the node.
struct FollowerLoad {
  Index node = 0;
  Vector3d force = Vector3d::Zero();  ///< force, moment in the pose of the model [N, N, N m]
};

/// Initial velocity of a node. Velocities that are not given minimize the kinetic energy.
struct InitialVelocity {
  Index node = 0;
  int direction = 0;  ///< 0: x [m/s], 1: y [m/s], 2: rotation [rad/s]
  double value = 0;
};

/// Additions to a `Model` for large motion: drives, joints, springs, loads, damping and initial
/// velocities.
struct LargeMotionModel {
  std::vector<Drive> drives;
  std::vector<Torque> torques;
  std::vector<Slider> sliders;
  std::vector<LineSpring> line_springs;
  std::vector<FollowerLoad> follower_loads;
  std::vector<InitialVelocity> initial_velocities;
  std::function<double(double)> load_history;  ///< factor on the loads (not gravity); empty: 1
  std::vector<double> load_breakpoints;  ///< times of jumps and kinks of the factor, ascending [s]
  double mass_damping = 0;               ///< factor of the forces -mass_damping M v [1/s]
  double strain_rate_damping = 0;        ///< tau in stress = D (strain + tau * strain rate) [s]
};

/// Checks the node indices and the numerical values of drives, loads and joints.
/// @throws ModelError  if a drive, load or joint refers to a node that does not exist or has an
///   invalid value.
void validate(const LargeMotionModel& large_motion, const Model& model);

}  // namespace trammel::solver::large_motion

namespace trammel::solver {

/// Adds a revolute joint between two coincident nodes: constraints of equal translations, which are
/// valid in small and large motion.
void add_pin(Model& model, const std::string& name, const std::array<Index, 2>& nodes);

/// Adds a sliding joint for small motion to a linear model. The displacement of the node relative
/// to the rail is zero along the normal n of the line. For displacements u, positions p and the
/// unit vector k normal to the plane:
///
///   n . (u - u_rail) = n . (k x (p - p_rail)) theta_rail.
void add_small_motion_slider(Model& model, const large_motion::Slider& slider);

}  // namespace trammel::solver

namespace trammel::solver::large_motion {

/// Element of a member with its coordinates: (ux, uy, theta) of each node. A bar (EI = 0) has only
/// (ux, uy) of its ends.
struct MemberElement {
  Index member = 0;
  Vector2d start = Vector2d::Zero();  ///< start of the element in the pose of the model [m]
  Vector2d end = Vector2d::Zero();
  Section section;
  std::vector<Index> coordinates;
  [[nodiscard]] bool is_bar() const { return coordinates.size() == 4; }
  [[nodiscard]] double length() const { return (end - start).norm(); }
  /// Returns the number of coordinates per node.
  [[nodiscard]] std::size_t coordinates_per_node() const { return is_bar() ? 2 : 3; }
  [[nodiscard]] std::size_t nodes() const { return coordinates.size() / coordinates_per_node(); }
  /// Returns the position of a node in the pose of the model [m].
  [[nodiscard]] Vector2d position(std::size_t node) const;
};

/// Numbering of the coordinates. Free coordinates come first, then coordinates held by supports. A
/// coordinate with an index >= `free` is therefore always zero. Joined members and bodies share
/// coordinates if possible:
///
/// - The nodes of a revolute joint share the translations.
/// - A welded member end and its node share the rotation.
/// - The nodes of a rigid body share the rotation of the body.
/// - Coordinates that a constraint makes equal are one coordinate.
struct Layout {
  Index free = 0;
  Index total = 0;
  std::vector<std::array<Index, 3>> node;  ///< coordinates of each node; -1: no rotation
  /// Rotation coordinates of the ends of each member.
  std::vector<std::array<Index, 2>> end_rotation;
  std::vector<MemberElement> elements;
  std::vector<Index> first_element;  ///< first element of each member, then the number of elements
  std::vector<std::array<Index, 2>>
      mass_center;             ///< coordinates of the center of each point mass (or of its node)
  std::vector<int> direction;  ///< direction of each coordinate: 0: x, 1: y, 2: rotation

  [[nodiscard]] bool is_rotation(Index coordinate) const {
    return direction[static_cast<std::size_t>(coordinate)] == 2;
  }
};

}  // namespace trammel::solver::large_motion
