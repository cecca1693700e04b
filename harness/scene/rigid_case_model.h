#pragma once

#include <string>
#include <vector>

#include "harness/scene/case_model.h"
#include "solver/manipulator/rigid_dynamics.h"

/// What the analyses of the rigid manipulator take from a scene.
namespace trammel::harness {

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
