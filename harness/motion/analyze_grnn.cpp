#include <Eigen/Core>
#include <algorithm>
#include <boost/math/interpolators/makima.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "harness/motion/analyses.h"
#include "harness/readers/option_reader.h"
#include "harness/scene/case_model.h"
#include "harness/scene/tracking.h"
#include "harness/statics_modes/step_result.h"
#include "solver/grnn/grnn_validation.h"
#include "solver/large/state_results.h"
#include "solver/manipulator/forward_dynamics.h"
#include "solver/manipulator/rigid_dynamics.h"
#include "solver/model/numbers.h"

namespace trammel::harness {

TRAMMEL_WORDS(solver::InputScaling, "none", "deviation", "range");
TRAMMEL_WORDS(solver::FoldOrder, "interleaved", "shuffled", "blocks");
TRAMMEL_WORDS(solver::Split, "first", "interleaved", "shuffled");

namespace {

struct GrnnOutput {
  std::string quantity;  ///< "angle" or "velocity"; empty for samples of a case
  std::string unit;      ///< suffix of the quantity's name, such as "_rad"; empty if it has no unit
  std::string item;      ///< active joint A1, A2 or A3, or the number of the column
};

struct GrnnSamples {
  Eigen::MatrixXd inputs;           ///< one row per sample
  Eigen::MatrixXd outputs;          ///< one row per sample
  std::vector<GrnnOutput> columns;  ///< description of each column of `outputs`
};

/// Samples as in Varalakshmi and Srinivas (2017), Section 4.3, one for each point of the path.
/// Inputs are the torques of the inverse dynamics. Outputs are the angles and velocities of the
/// active joints. Angles are continuous in time: they do not jump by 2 pi.
struct PathSamples {
  solver::Outcome outcome;  ///< outcome of the first path point without a solution
  GrnnSamples samples;
};

/// Reads a matrix row by row.
/// @throws InputError  if rows differ in length.
Eigen::MatrixXd read_matrix_rows(const JsonView& rows) {
  const std::size_t columns = rows[0].size();
  Eigen::MatrixXd matrix(static_cast<solver::Index>(rows.size()),
                         static_cast<solver::Index>(columns));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Json& row = rows.json()[i];  // avoids a JsonView for each of up to 100,000 numbers
    if (row.size() != columns)
      throw rows[i].error("expected " + std::to_string(columns) +
                          " numbers as in the first row (got another count)");
    for (std::size_t j = 0; j < columns; ++j)
      matrix(static_cast<solver::Index>(i), static_cast<solver::Index>(j)) = row[j].get<double>();
  }
  return matrix;
}

/// Reads the "inputs" and "outputs" of a case's samples.
/// @throws InputError  if rows differ in length, or inputs and outputs differ in number.
GrnnSamples read_samples(const JsonView& samples) {
  GrnnSamples read{read_matrix_rows(samples["inputs"]), read_matrix_rows(samples["outputs"]), {}};
  if (read.inputs.rows() != read.outputs.rows())
    throw samples["outputs"].error("expected the number of rows of 'inputs', " +
                                   std::to_string(read.inputs.rows()));
  for (solver::Index j = 0; j < read.outputs.cols(); ++j)
    read.columns.push_back({"", "", std::to_string(j + 1)});
  return read;
}

PathSamples create_path_samples(const solver::RigidManipulator& manipulator,
                                const CaseModel& case_model) {
  const auto count = static_cast<solver::Index>(case_model.motion.size());
  PathSamples result;
  GrnnSamples& samples = result.samples;
  samples.inputs.resize(count, 3);
  samples.outputs.resize(count, 6);
  for (const char* joint : {"A1", "A2", "A3"}) samples.columns.push_back({"angle", "_rad", joint});
  for (const char* joint : {"A1", "A2", "A3"})
    samples.columns.push_back({"velocity", "_rad_per_s", joint});
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
      const double angle = found.q(i), before = k > 0 ? samples.outputs(k - 1, i) : angle;
      samples.outputs(k, i) = before + std::remainder(angle - before, 2 * std::numbers::pi);
      samples.outputs(k, 3 + i) = found.q_dot(i);
    }
  }
  return result;
}

/// Replaces the joint angles and velocities in the samples by those of a manipulator with
/// geometrically exact flexible links under the same torques.
/// @param place  "flexible_links" of the case
/// @throws InputError  if the manipulator cannot track the path (see `add_tracking`), or if the
///   points of the path are not evenly spaced in time.
void sample_flexible_motion(const JsonView& place, const CaseModel& case_model, PathSamples& path) {
  solver::Model model = build_without_joint_elements(case_model, 0);
  solver::large_motion::LargeMotionModel large_motion = case_model.joint_elements;
  large_motion.strain_rate_damping = place.get("strain_rate_damping_s", 0.0);
  add_tracking(place, Tracking::torques, case_model, model, large_motion);
  release_driven_actuators(place, case_model, large_motion, model);
  const solver::large_motion::GeometricallyExactSystem system(model, large_motion);
  solver::TransientOptions options;
  options.scheme = solver::generalized_alpha(0.9);
  options.end = case_model.motion.back().time;
  options.step = place.number("step_s");
  limit_time_step_count(place["step_s"], options.end);
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
        if (!on_time)
          throw place.error(
              "flexible links require points of the trajectory at equal time intervals");
        const Eigen::MatrixX3d q = node_motion(system, now.q), v = node_motion(system, now.v);
        outputs.row(k++) << start + q.col(2).head<3>().transpose(), v.col(2).head<3>().transpose();
      }).outcome;
}

/// Sets the smoothing parameter of the network: the value stated in the case, or the value with the
/// least cross-validation error.
void choose_smoothing_parameter(const JsonView& analysis, solver::Grnn& network, Recorder& record) {
  if (analysis.has("sigma") == analysis.has("spread") && analysis.has("sigma"))
    throw analysis.error("expected at most one of 'sigma' and 'spread' (got both)");
  if (analysis.has("sigma")) {
    network.sigma = analysis.number("sigma");
  } else if (analysis.has("spread")) {
    network.sigma = solver::sigma_of_newgrnn_spread(analysis.number("spread"));
  } else {
    const JsonView search = analysis.has("search") ? analysis["search"] : analysis;
    const solver::Index count = search.get<solver::Index>("count", 41);
    const bool given = search.has("from");
    const solver::SigmaSearch found = solver::search_sigma(
        network,
        given ? solver::logarithmic_grid(search.number("from"), search.number("to"), count)
              : solver::default_sigma_grid(network, count),
        {.folds = search.get<solver::Index>("folds", 0),
         .order = search.get("order", solver::FoldOrder::interleaved),
         .seed = search.get<std::uint64_t>("seed", 1)});
    network.sigma = found.sigma;
    record.add("cross_validation_error", found.error);
    record.add("sigma_bracketed", found.bracketed ? 1 : 0);
    record.add("sigmas_tried", found.evaluations);
    for (solver::Index k = 0; k < found.grid.size(); ++k) {
      record.add("grid_sigma", found.grid(k));
      record.add("grid_error", found.grid_error(k));
    }
  }
  record.add("sigma", network.sigma);
}

struct Parts {
  std::vector<solver::Index> training, held_out;
};

Parts parts_of(const std::vector<bool>& trains) {
  Parts parts;
  for (std::size_t i = 0; i < trains.size(); ++i)
    (trains[i] ? parts.training : parts.held_out).push_back(static_cast<solver::Index>(i));
  return parts;
}

/// Scales of the network's outputs over all samples. Errors divided by these scales are comparable
/// between outputs.
struct OutputScales {
  Eigen::RowVectorXd deviation, range;
  explicit OutputScales(const Eigen::MatrixXd& outputs)
      : deviation(outputs.cols()),
        range(outputs.colwise().maxCoeff() - outputs.colwise().minCoeff()) {
    for (solver::Index j = 0; j < outputs.cols(); ++j) {
      const Eigen::ArrayXd centered = outputs.col(j).array() - outputs.col(j).mean();
      deviation(j) = std::sqrt(centered.square().mean());
      if (range(j) == 0) range(j) = deviation(j) = 1;  // avoids division by 0 for a constant output
    }
  }
};

/// Returns the root mean square of the errors of all samples and outputs. The errors of each output
/// are divided by its standard deviation.
double rms(const Eigen::MatrixXd& error, const OutputScales& scales) {
  const Eigen::MatrixXd relative = error * scales.deviation.cwiseInverse().asDiagonal();
  return std::sqrt(relative.squaredNorm() / static_cast<double>(relative.size()));
}

Eigen::MatrixXd rows(const Eigen::MatrixXd& all, const std::vector<solver::Index>& which) {
  return all(which, Eigen::all);
}

void record_sample_errors(const std::string& part, const std::vector<solver::Index>& which,
                          const GrnnSamples& samples, const Eigen::MatrixXd& error,
                          const OutputScales& scales, Recorder& record) {
  if (which.empty()) return;
  const Eigen::MatrixXd own = rows(error, which);
  for (solver::Index j = 0; j < own.cols(); ++j) {
    const GrnnOutput& column = samples.columns[solver::to_size(j)];
    for (solver::Index i = 0; i < own.rows(); ++i)
      record.add(part + "_" + column.quantity + "_error" + column.unit, column.item, own(i, j));
  }
  record.add(part + "_rms_error", rms(own, scales));
  const Eigen::MatrixXd of_range = own * scales.range.cwiseInverse().asDiagonal();
  record.add(part + "_largest_error_of_range", of_range.cwiseAbs().maxCoeff());
}

/// Records the skill against two trivial predictors: the mean of the training samples, and the
/// nearest sample.
///   skill = 1 - (rms error / rms error of the trivial predictor)^2
/// A perfect prediction has skill 1. A prediction as good as the trivial predictor has skill 0.
void record_prediction_skill(const solver::Grnn& network, const GrnnSamples& samples,
                             const std::vector<solver::Index>& which, double error,
                             const OutputScales& scales, Recorder& record) {
  const Eigen::MatrixXd queries = rows(samples.inputs, which);
  const Eigen::MatrixXd expected = rows(samples.outputs, which);
  const auto against = [&](const char* name, double sigma) {
    solver::Grnn trivial = network;
    trivial.sigma = sigma;
    const double baseline_error = rms(solver::predict(trivial, queries) - expected, scales);
    record.add("held_out_rms_error", name, baseline_error);
    record.add("skill_score_against", name,
               1 - (error / baseline_error) * (error / baseline_error));
  };
  against("mean", 1e150);
  against("nearest", 1e-300);
}

/// Measures the computing time of predictions at every point of the path, both in one batch and one
/// by one. Also measures the computations that the network replaces: forward dynamics to the next
/// point of the path, and inverse dynamics.
std::vector<EvaluationTime> time_predictions_and_solves(const solver::Grnn& network,
                                                        const solver::RigidManipulator& manipulator,
                                                        const CaseModel& case_model,
                                                        const GrnnSamples& samples) {
  const std::size_t count = case_model.motion.size();
  double sink = 0;  // uses each result, so that the compiler cannot remove its computation
  std::vector<EvaluationTime> timings;
  timings.push_back(measure_evaluation("prediction_in_a_batch", count, [&] {
    sink += solver::predict(network, samples.inputs).sum();
  }));
  timings.push_back(measure_evaluation("prediction_one_by_one", count, [&] {
    for (solver::Index k = 0; k < samples.inputs.rows(); ++k)
      sink += solver::predict(network, samples.inputs.row(k))(0, 0);
  }));
  timings.push_back(measure_evaluation("inverse_dynamics", count, [&] {
    for (const solver::TrajectoryPoint& point : case_model.motion)
      sink +=
          solver::inverse_dynamics(manipulator, point, wrench_on_platform(case_model, point.pose))
              .torque(0);
  }));
  if (count < 2 || !loads_at_P_only(case_model)) return timings;
  const Eigen::Vector3d wrench = wrench_on_platform(case_model, case_model.motion.front().pose);
  timings.push_back(measure_evaluation("forward_dynamics_to_the_next_point", count - 1, [&] {
    for (std::size_t k = 0; k + 1 < count; ++k) {
      const double from = case_model.motion[k].time, to = case_model.motion[k + 1].time;
      const auto row = static_cast<solver::Index>(k);
      const auto torque = [&](double time) -> Eigen::Vector3d {
        const double s = (time - from) / (to - from);
        return ((1 - s) * samples.inputs.row(row) + s * samples.inputs.row(row + 1)).transpose();
      };
      const solver::ForwardDynamics next =
          solver::forward_dynamics(manipulator, case_model.motion[k], torque, {to}, wrench);
      if (next.outcome.solved()) sink += next.motion.back().pose.x;
    }
  }));
  if (!std::isfinite(sink)) timings.clear();
  return timings;
}

void record_predictions(const GrnnSamples& samples, const Eigen::MatrixXd& predicted,
                        const std::vector<bool>& trains, Recorder& record) {
  for (solver::Index j = 0; j < predicted.cols(); ++j) {
    const GrnnOutput& column = samples.columns[solver::to_size(j)];
    for (solver::Index k = 0; k < predicted.rows(); ++k) {
      record.add("active_" + column.quantity + column.unit, column.item, samples.outputs(k, j));
      record.add("predicted_" + column.quantity + column.unit, column.item, predicted(k, j));
    }
  }
  for (const bool trains_here : trains) record.add("in_training_set", trains_here ? 1 : 0);
}

/// Records the platform's position for predicted angles of the active joints, by forward kinematics
/// that starts from the true pose. The position is NaN if the platform cannot be assembled.
void record_positions(const solver::ManipulatorGeometry& geometry, const CaseModel& case_model,
                      const Eigen::MatrixXd& predicted, Recorder& record) {
  for (std::size_t k = 0; k < case_model.motion.size(); ++k) {
    const auto row = static_cast<solver::Index>(k);
    const std::array<double, 3> active = {predicted(row, 0), predicted(row, 1), predicted(row, 2)};
    const auto found = solver::forward_kinematics(geometry, active, case_model.motion[k].pose);
    const bool solved = found.outcome.solved();
    record.add_or_missing("predicted_position_x_m", "P", solved ? found.pose.x : std::nan(""));
    record.add_or_missing("predicted_position_y_m", "P", solved ? found.pose.y : std::nan(""));
  }
}

/// Predicts the outputs over time without torques, by a modified Akima spline through the training
/// points. Before the first and after the last training point, the prediction follows the tangents
/// of the spline at its ends.
Eigen::MatrixXd spline_over_time(const CaseModel& case_model, const Eigen::MatrixXd& outputs,
                                 const std::vector<solver::Index>& training) {
  std::vector<double> times;
  for (const auto k : training) times.push_back(case_model.motion[solver::to_size(k)].time);
  Eigen::MatrixXd predicted(outputs.rows(), outputs.cols());
  for (solver::Index j = 0; j < outputs.cols(); ++j) {
    const Eigen::VectorXd values = outputs(training, j);
    const boost::math::interpolators::makima<std::vector<double>> spline(
        std::vector<double>(times), {values.begin(), values.end()});
    for (solver::Index k = 0; k < outputs.rows(); ++k) {
      const double time = case_model.motion[solver::to_size(k)].time;
      const double inside = std::clamp(time, times.front(), times.back());
      predicted(k, j) = spline(inside) + (time - inside) * spline.prime(inside);
    }
  }
  return predicted;
}

}  // namespace

StepResult analyze_grnn(const JsonView& analysis, const CaseModel& case_model, bool draw,
                        Recorder& record) {
  const solver::RigidManipulator manipulator = read_rigid_manipulator(analysis, case_model);
  if (!case_model.path) throw analysis.error("expected a model with 'trajectory', or 'samples'");
  StepResult result;
  PathSamples path = create_path_samples(manipulator, case_model);
  const auto flexible = analysis.find("flexible_links");
  if (flexible && path.outcome.solved()) sample_flexible_motion(*flexible, case_model, path);
  result.outcome = path.outcome;
  if (!result.outcome.solved()) return result;
  const GrnnSamples& samples = path.samples;
  const solver::Index count = samples.inputs.rows();
  const solver::Index train = analysis.get<solver::Index>("train", count);
  if (train > count)
    throw analysis["train"].error("expected at most the number of points of the trajectory, " +
                                  std::to_string(count));
  const std::vector<bool> trains =
      solver::training_mask(count, train, analysis.get("split", solver::Split::first),
                            analysis.get<std::uint64_t>("seed", 1));
  const Parts parts = parts_of(trains);
  const bool spline = analysis.get<std::string>("surrogate", "network") == "spline";
  solver::Grnn network;
  Eigen::MatrixXd predicted;
  if (spline) {
    constexpr solver::Index kFewest = 4;
    if (train < kFewest)
      throw analysis["train"].error("a spline requires at least 4 training points (got fewer)");
    predicted = spline_over_time(case_model, samples.outputs, parts.training);
  } else {
    network = solver::make_grnn(rows(samples.inputs, parts.training),
                                rows(samples.outputs, parts.training), 1,
                                analysis.get("scaling", solver::InputScaling::none));
    choose_smoothing_parameter(analysis, network, record);
    predicted = solver::predict(network, samples.inputs);
  }
  const Eigen::MatrixXd error = predicted - samples.outputs;
  const OutputScales scales(samples.outputs);
  record_predictions(samples, predicted, trains, record);
  record_positions(manipulator.geometry, case_model, predicted, record);
  record_sample_errors("training", parts.training, samples, error, scales, record);
  record_sample_errors("held_out", parts.held_out, samples, error, scales, record);
  if (!parts.held_out.empty() && !spline)
    record_prediction_skill(network, samples, parts.held_out,
                            rms(rows(error, parts.held_out), scales), scales, record);
  if (!spline) record.add("kernel_evaluations", train);
  if (draw) {
    result.drawing = draw_manipulator(manipulator.geometry, case_model.motion);
    if (spline) return result;
    result.timings = time_predictions_and_solves(network, manipulator, case_model, samples);
  }
  return result;
}

StepResult analyze_grnn_samples(const Document& document, const References&, bool,
                                Recorder& record) {
  const JsonView analysis = JsonView(document)["analysis"]["grnn"];
  if (!analysis.has("samples"))
    throw analysis.error("expected 'samples', or a model with 'trajectory'");
  const GrnnSamples samples = read_samples(analysis["samples"]);
  const Eigen::MatrixXd queries = read_matrix_rows(analysis["queries"]);
  if (queries.cols() != samples.inputs.cols())
    throw analysis["queries"].error("expected rows of " + std::to_string(samples.inputs.cols()) +
                                    " numbers, as in 'inputs'");
  try {
    solver::Grnn network = solver::make_grnn(samples.inputs, samples.outputs, 1,
                                             analysis.get("scaling", solver::InputScaling::none));
    choose_smoothing_parameter(analysis, network, record);
    const Eigen::MatrixXd predicted = solver::predict(network, queries);
    for (solver::Index k = 0; k < predicted.rows(); ++k)
      for (solver::Index j = 0; j < predicted.cols(); ++j)
        record.add("prediction", samples.columns[solver::to_size(j)].item, predicted(k, j));
  } catch (const solver::ModelError& error) {
    throw analysis.error(std::string("expected a valid network: ") + error.what());
  }
  return {};
}

}  // namespace trammel::harness
