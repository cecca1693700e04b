#include "harness/motion/grnn_samples.h"

#include <cmath>
#include <numbers>

#include "harness/scene/rigid_case_model.h"
#include "harness/statics_modes/step_result.h"

namespace trammel::harness {

Eigen::MatrixXd read_rows(const JsonView& rows) {
  const std::size_t columns = rows[0].size();
  Eigen::MatrixXd matrix(static_cast<solver::Index>(rows.size()),
                         static_cast<solver::Index>(columns));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].size() != columns) {
      throw rows[i].error("expected " + std::to_string(columns) + " numbers as in the first row");
    }
    for (std::size_t j = 0; j < columns; ++j) {
      matrix(static_cast<solver::Index>(i), static_cast<solver::Index>(j)) =
          rows[i][j].get<double>();
    }
  }
  return matrix;
}

GrnnSamples read_samples(const JsonView& samples) {
  GrnnSamples read{read_rows(samples["inputs"]), read_rows(samples["outputs"]), {}};
  if (read.inputs.rows() != read.outputs.rows()) {
    throw samples["outputs"].error("expected as many rows as inputs have, " +
                                   std::to_string(read.inputs.rows()));
  }
  for (solver::Index j = 0; j < read.outputs.cols(); ++j) {
    read.columns.push_back({"", "", std::to_string(j + 1)});
  }
  return read;
}

PathSamples samples_of_path(const solver::RigidManipulator& manipulator,
                            const CaseModel& case_model) {
  const auto count = static_cast<solver::Index>(case_model.motion.size());
  PathSamples result;
  GrnnSamples& samples = result.samples;
  samples.inputs.resize(count, 3);
  samples.outputs.resize(count, 6);
  for (const char* joint : {"A1", "A2", "A3"}) samples.columns.push_back({"angle", "_rad", joint});
  for (const char* joint : {"A1", "A2", "A3"}) {
    samples.columns.push_back({"velocity", "_rad_per_s", joint});
  }
  for (solver::Index k = 0; k < count; ++k) {
    const solver::TrajectoryPoint& point = case_model.motion[static_cast<std::size_t>(k)];
    const solver::InverseDynamics found =
        solver::inverse_dynamics(manipulator, point, wrench_on_platform(case_model, point.pose));
    if (!found.outcome.solved()) {
      result.outcome =
          outcome_at_path_point(case_model, static_cast<std::size_t>(k), found.outcome);
      return result;
    }
    samples.inputs.row(k) = found.torque.transpose();
    for (solver::Index i = 0; i < 3; ++i) {
      const double angle = found.q(i);
      const double before = k > 0 ? samples.outputs(k - 1, i) : angle;
      samples.outputs(k, i) = before + std::remainder(angle - before, 2 * std::numbers::pi);
      samples.outputs(k, 3 + i) = found.q_dot(i);
    }
  }
  return result;
}

}  // namespace trammel::harness
