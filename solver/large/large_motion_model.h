#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "solver/model/model.h"

/// What large motion adds to a `Model`: drives, torques, sliding joints, springs along a line,
/// follower loads, histories, damping and a start. Everything in SI units and the model's pose.
namespace trammel::solver::large_motion {

/// Value, rate and second derivative at a time or, in statics, at a load factor.
using TimeFunction = std::function<std::array<double, 3>(double)>;

/// A node's displacement or rotation, seen from another node's or the ground's (-1), prescribed as
/// a function of time; its multiplier is the force or torque that the drive takes from the
/// structure.
struct Drive {
  std::string name;
  Index node = 0;
  int direction = 2;  ///< 0: x [m], 1: y [m], 2: rotation [rad]
  TimeFunction law;
  Index from = -1;
};

/// A torque on a node as a function of time, whatever the load factor.
struct Torque {
  std::string name;
  Index node = 0;
  std::function<double(double)> law;  ///< [N m]
};

/// A node slides along a line through its position in the model's pose; the line rotates with the
/// node `rail`, or is fixed (-1).
struct Slider {
  std::string name;
  Index node = 0;
  Index rail = -1;
  double direction = 0;      ///< of the line in the model's pose [rad]
  bool keeps_angle = false;  ///< true: prismatic, the node rotates as the rail does
};

/// Spring along the line between two nodes.
struct LineSpring {
  std::string name;
  std::array<Index, 2> nodes{-1, -1};
  double stiffness = 0;  ///< [N/m]
  /// Length without force [m]; not given: the length in the model's pose.
  double rest_length = std::numeric_limits<double>::quiet_NaN();
};

/// A force and a moment on a node that rotate with the node.
struct FollowerLoad {
  Index node = 0;
  Vector3d force = Vector3d::Zero();  ///< in the model's pose [N, N, N m]
};

/// Velocity of a node at the start; those that are not given minimize the kinetic energy.
struct InitialVelocity {
  Index node = 0;
  int direction = 0;  ///< 0: x [m/s], 1: y [m/s], 2: rotation [rad/s]
  double value = 0;
};

struct LargeMotionModel {
  std::vector<Drive> drives;
  std::vector<Torque> torques;
  std::vector<Slider> sliders;
  std::vector<LineSpring> line_springs;
  std::vector<FollowerLoad> follower_loads;
  std::vector<InitialVelocity> initial_velocities;
  std::function<double(double)> load_history;  ///< factor on the loads (not gravity); empty: 1
  std::vector<double> load_breakpoints;        ///< where it bends, ascending [s]
  double mass_damping = 0;                     ///< forces -mass_damping M v [1/s]
  double strain_rate_damping = 0;              ///< stress from strain + this times strain rate [s]
};

/// @throws ModelError  where a part of the large-motion model names a node that does not exist, or
///                     its numbers have no meaning.
void validate(const LargeMotionModel& large_motion, const Model& model);

}  // namespace trammel::solver::large_motion

namespace trammel::solver {

/// Adds a revolute joint between two coincident nodes, in every tier: equal translations.
void add_pin(Model& model, const std::string& name, const std::array<Index, 2>& nodes);

/// A slider in small motion, for the linear tiers: no displacement across the line as the rail
/// carries it, n . (u - u_rail) = n . (k x (p - p_rail)) theta_rail.
void add_linear_slider(Model& model, const large_motion::Slider& slider);

}  // namespace trammel::solver

namespace trammel::solver::large_motion {

/// An element of a member with its coordinates along it: (ux, uy, theta) of each node; of a bar
/// (EI = 0) only (ux, uy) of its ends.
struct MemberElement {
  Index member = 0;
  Vector2d start = Vector2d::Zero();  ///< in the model's pose [m]
  Vector2d end = Vector2d::Zero();
  Section section;
  std::vector<Index> coordinates;
  [[nodiscard]] bool is_bar() const { return coordinates.size() == 4; }
  [[nodiscard]] double length() const { return (end - start).norm(); }
  /// Coordinates of a node.
  [[nodiscard]] std::size_t stride() const { return is_bar() ? 2 : 3; }
  [[nodiscard]] std::size_t nodes() const { return coordinates.size() / stride(); }
  /// Position of a node in the model's pose [m].
  [[nodiscard]] Vector2d position(std::size_t node) const;
};

/// Numbers the coordinates: the free ones first, then those that supports hold, so that an index at
/// or above `free` means a displacement of zero. Joints share coordinates where they can: a
/// revolute joint shares translations (so does a constraint that makes two coordinates equal), a
/// welded end and a rigid body's nodes share the rotation.
struct Layout {
  Index free = 0;
  Index total = 0;
  std::vector<std::array<Index, 3>> node;          ///< x, y, rotation (-1: the node has none)
  std::vector<std::array<Index, 2>> end_rotation;  ///< of each member's ends
  std::vector<MemberElement> elements;
  std::vector<Index> first_element;  ///< of each member, one past the last at the end
  std::vector<std::array<Index, 2>>
      mass_centre;             ///< of each point mass with an offset; else node's
  std::vector<int> direction;  ///< of each coordinate: 0: x, 1: y, 2: rotation

  [[nodiscard]] bool is_rotation(Index coordinate) const {
    return direction[static_cast<std::size_t>(coordinate)] == 2;
  }
};

}  // namespace trammel::solver::large_motion
