#pragma once

#include <optional>
#include <vector>

#include "harness/input/json_view.h"
#include "solver/large/large_motion_model.h"
#include "solver/manipulator/manipulator.h"
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

}  // namespace trammel::harness
