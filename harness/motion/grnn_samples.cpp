#include "harness/motion/grnn_samples.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "harness/readers/option_reader.h"
#include "harness/scene/rigid_case_model.h"
#include "harness/scene/tracking.h"
#include "harness/statics_modes/step_result.h"
#include "solver/large/state_results.h"
#include "solver/manipulator/rigid_dynamics.h"
#include "solver/model/numbers.h"

namespace trammel::harness {

Eigen::MatrixXd read_rows(const JsonView& rows) {
  const std::size_t columns = rows[0].size();
  Eigen::MatrixXd matrix(static_cast<solver::Index>(rows.size()),
                         static_cast<solver::Index>(columns));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Json& row = rows.json()[i];  // there may be 100,000
    if (row.size() != columns) {
      throw rows[i].error("expected " + std::to_string(columns) + " numbers as in the first row");
    }
    for (std::size_t j = 0; j < columns; ++j) {
      matrix(static_cast<solver::Index>(i), static_cast<solver::Index>(j)) = row[j].get<double>();
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
    const solver::TrajectoryPoint& point = case_model.motion[solver::to_size(k)];
    const solver::InverseDynamics found =
        solver::inverse_dynamics(manipulator, point, wrench_on_platform(case_model, point.pose));
    if (!found.outcome.solved()) {
      result.outcome = outcome_at_path_point(case_model, solver::to_size(k), found.outcome);
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

void let_links_bend(const JsonView& place, const CaseModel& case_model, PathSamples& path) {
  solver::Model model = build_bare_model(case_model, 0);
  solver::large_motion::LargeMotionModel large_motion = case_model.joint_elements;
  large_motion.strain_rate_damping = place.get("strain_rate_damping_s", 0.0);
  add_tracking(place, Tracking::torques, case_model, model, large_motion);
  release_driven_actuators(place, case_model, large_motion, model);
  const solver::large_motion::GeometricallyExactSystem system(model, large_motion);
  solver::TransientOptions options;
  options.scheme = solver::generalized_alpha(0.9);
  options.end = case_model.motion.back().time;
  options.step = place.number("step_s");
  require_step_count(place["step_s"], options.end);
  const double output_step =
      case_model.motion.size() > 1 ? case_model.motion[1].time : options.step;
  options.sample_times = solver::even_times(0, options.end, output_step);
  Eigen::MatrixXd& outputs = path.samples.outputs;
  const Eigen::RowVector3d start = outputs.row(0).head<3>();
  solver::Index k = 0;
  path.outcome =
      integrate_tracking(case_model, system, options, [&](const solver::large_motion::State& now) {
        const bool on_time =
            k < outputs.rows() &&
            std::abs(now.t - case_model.motion[solver::to_size(k)].time) < options.step / 2;
        if (!on_time) throw place.error("expected a path with points evenly spaced in time");
        const Eigen::MatrixX3d q = node_motion(system, now.q), v = node_motion(system, now.v);
        outputs.row(k++) << start + q.col(2).head<3>().transpose(), v.col(2).head<3>().transpose();
      }).outcome;
}

}  // namespace trammel::harness
