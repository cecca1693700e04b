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

/// Contents of the key "model" of a case, from which a planar model is built at each pose of the
/// path.
struct CaseModel {
  std::optional<solver::ManipulatorDesign> manipulator;
  /// Motion of the platform: one pose at rest, or the points of the path.
  std::vector<solver::TrajectoryPoint> motion;
  std::optional<solver::Path> path;  ///< if present, quantities have one number per path point
  /// Parts other than the manipulator. Node indices start after the nodes of the manipulator.
  solver::Model structure;
  /// Sliders, line springs and follower loads, which linear analysis supports only in part.
  solver::large_motion::LargeMotionModel joint_elements;
  /// Physical effects that `build_model` includes.
  solver::Effects effects = solver::Effects::all();
  /// If true, statics with large displacement is solved to six digits only, and residuals of the
  /// solution are not computed.
  bool estimates_large_displacement = false;

  [[nodiscard]] std::size_t path_point_count() const { return path ? motion.size() : 1; }
};

/// Reads the "model" of a case.
/// @param document  a case with its patches, validated against the schema.
/// @throws InputError  if a name is unknown, the geometry is impossible, a pose is out of reach or
///     a combination of keys is invalid.
[[nodiscard]] CaseModel read_case_model(const Document& document);

/// Builds the planar model for linear analysis at a point of the path (0 without a path), with the
/// chosen effects. Sliders become linear constraints.
/// @throws ModelError  if the case has line springs or follower loads.
[[nodiscard]] solver::Model build_model(const CaseModel& case_model, std::size_t step);

/// Builds the planar model for large motion, in which sliders, line springs and follower loads are
/// not part of the model.
[[nodiscard]] solver::Model build_without_joint_elements(const CaseModel& case_model,
                                                         std::size_t step);

/// Converts an error of the solver about an invalid model into an input error. The input error
/// refers to the part of the case that the message names.
[[nodiscard]] InputError to_input_error(const Document& document, const solver::ModelError& error);

/// Names of joints and bodies of the manipulator, as they occur in names of quantities.
inline const std::vector<std::string> kActiveJoints = {"A1", "A2", "A3"},
                                      kElbows = {"B1", "B2", "B3"},
                                      kBodies = {"A1-B1", "A2-B2", "A3-B3",   "B1-C1",
                                                 "B2-C2", "B3-C3", "platform"};

/// Reads dimensions and mass properties of the manipulator and the gravity for rigid dynamics.
/// @throws InputError  if the case has no manipulator, or has parts that rigid dynamics would
///   ignore: members, plates, bodies, masses, springs, supports, and loads that do not act on the
///   platform.
[[nodiscard]] solver::RigidManipulator read_rigid_manipulator(const JsonView& analysis,
                                                              const CaseModel& case_model);

/// Returns the loads on P and C1, C2, C3 as one wrench at P in world axes (Fx, Fy [N], moment [N
/// m]). Loads on links are ignored.
[[nodiscard]] Eigen::Vector3d wrench_on_platform(const CaseModel& case_model,
                                                 const solver::Pose& pose);

/// Returns true if every load of the case acts at P, so that the wrench on the platform is
/// independent of the pose.
[[nodiscard]] bool loads_at_P_only(const CaseModel& case_model);

}  // namespace trammel::harness
