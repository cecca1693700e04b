#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "harness/scene/case_model.h"
#include "solver/manipulator/rigid_dynamics.h"

/// What a network learns from and is asked about.
namespace trammel::harness {

struct GrnnOutput {
  std::string quantity;  ///< angle, velocity; empty for samples without a meaning
  std::string unit;      ///< as quantities' names carry it: "_rad"; empty where there is none
  std::string item;      ///< A1, ... or the number of the column
};

struct GrnnSamples {
  Eigen::MatrixXd inputs;           ///< sample x input
  Eigen::MatrixXd outputs;          ///< sample x output
  std::vector<GrnnOutput> columns;  ///< of the outputs
};

/// Samples as a case gives them, "inputs" and "outputs".
/// @throws InputError  where rows are not equally long, or not equally many.
[[nodiscard]] GrnnSamples read_samples(const JsonView& samples);

/// @throws InputError  where rows are not equally long.
[[nodiscard]] Eigen::MatrixXd read_rows(const JsonView& rows);

/// The paper's samples (Section 4.3): inputs are the torques of the inverse dynamics at each point
/// of the scene's path, outputs the angles and velocities of the active joints. Angles are
/// continued over the jump at pi.
struct PathSamples {
  solver::Outcome outcome;  ///< of the first point without a solution
  GrnnSamples samples;
};
[[nodiscard]] PathSamples samples_of_path(const solver::RigidManipulator& manipulator,
                                          const CaseModel& case_model);

/// The same torques on flexible links, geometrically exact: angles and velocities become theirs.
/// @param place  "flexible_links" of the case
/// @throws InputError  as `add_tracking`, and where points of the path are not evenly spaced.
void let_links_bend(const JsonView& place, const CaseModel& case_model, PathSamples& path);

}  // namespace trammel::harness
