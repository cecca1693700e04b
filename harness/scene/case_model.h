#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/input/json_view.h"
#include "solver/large/large_motion_model.h"
#include "solver/manipulator/manipulator.h"
#include "solver/manipulator/rigid_dynamics.h"
#include "solver/manipulator/trajectory.h"
#include "solver/model/effects.h"
#include "solver/model/model.h"

namespace trammel::harness {

/// What the "model" of a case describes, ready to be built at each of its poses.
struct CaseModel {
  std::optional<solver::ManipulatorDesign> manipulator;
  /// Of the platform: one pose at rest, or the points of the path.
  std::vector<solver::TrajectoryPoint> motion;
  std::optional<solver::Path> path;  ///< where there is one, every quantity has one number a point
  /// Everything else. Its indices count the manipulator's nodes first, then its own.
  solver::Model structure;
  /// Sliders, line springs and follower loads, which the linear tiers know only in part.
  solver::large_motion::LargeMotionModel joint_elements;
  solver::Effects effects = solver::Effects::all();  ///< what `build_model` keeps
  /// Statics with large displacement are wanted to six digits and without evidence.
  bool estimates_large_displacement = false;

  [[nodiscard]] std::size_t steps() const { return path ? motion.size() : 1; }
};

/// @param document  a case with its patches, which has passed the schema
/// @throws InputError  where names lead nowhere, geometry is impossible, a pose is out of reach or
///                     a combination has no meaning.
[[nodiscard]] CaseModel read_case_model(const Document& document);

/// The planar model at a pose of the path (0 where there is none), with the scene's effects, for
/// the linear tiers: sliders are linear constraints.
/// @throws ModelError  where the scene has line springs or follower loads.
[[nodiscard]] solver::Model build_model(const CaseModel& case_model, std::size_t step);

/// The same for large motion, which takes the mechanism by itself.
[[nodiscard]] solver::Model build_bare_model(const CaseModel& case_model, std::size_t step);

/// The error of a model that the solver refused, at the part that its message names.
[[nodiscard]] InputError model_error(const Document& document, const solver::ModelError& error);

/// What the analyses of the rigid manipulator take from a scene.

/// Names of the manipulator's parts in quantities.
inline const std::vector<std::string> kActiveJoints = {"A1", "A2", "A3"},
                                      kElbows = {"B1", "B2", "B3"},
                                      kBodies = {"A1-B1", "A2-B2", "A3-B3",   "B1-C1",
                                                 "B2-C2", "B3-C3", "platform"};

/// The bodies of the scene's manipulator, and gravity.
/// @throws InputError  where there is no manipulator, or something stands beside it that rigid
///                     dynamics would leave out: members, plates, bodies, masses, springs, supports
///                     or loads that are not on the platform.
[[nodiscard]] solver::RigidManipulator read_rigid_manipulator(const JsonView& analysis,
                                                              const CaseModel& case_model);

/// Loads on P and C1, C2, C3 as one wrench at P in world axes (Fx, Fy [N], moment [N m]); loads on
/// links do not count.
[[nodiscard]] Eigen::Vector3d wrench_on_platform(const CaseModel& case_model,
                                                 const solver::Pose& pose);

/// Whether every load acts at P itself, so that the wrench is the same in every pose.
[[nodiscard]] bool loads_at_P_only(const CaseModel& case_model);

}  // namespace trammel::harness
