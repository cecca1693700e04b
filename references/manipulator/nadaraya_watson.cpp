#include <algorithm>

#include "references/manipulator/programs.h"
#include "references/numerics/real.h"

/// The estimator of Nadaraya and Watson (1964), which Specht (1991) calls a general regression
/// neural network, by its printed formula in extended precision:
///
///   Y(x) = sum_i Y_i exp(-D_i^2 / 2 s^2) / sum_i exp(-D_i^2 / 2 s^2).
///
/// The training sample i has the output Y_i and the distance D_i of its input from the input x, and
/// s is the smoothing parameter. Numerator and denominator are multiplied by exp(min D_i^2 / 2 s^2)
/// to avoid underflow.
namespace trammel::references {

namespace {

using Rows = std::vector<std::vector<Real>>;

/// Training sample: torques, angles and velocities of the active joints at one time.
struct Sample {
  std::vector<Real> torques, joints;
};

Sample sample_at_time(const ManipulatorNumbers& manipulator, const Arguments& trajectory,
                      const PlanarWrench& wrench, const Real& time) {
  const auto motion = platform_motion(trajectory, time);
  const auto torques = newton_euler_forces(manipulator, motion, wrench).torque;
  Sample sample{{torques.begin(), torques.end()}, std::vector<Real>(6)};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto joints = limb_joints(manipulator.limbs[i], motion);
    const Jet<Real> angle = direction_angle(joints[0], joints[1]);
    sample.joints[i] = angle.value;
    sample.joints[3 + i] = angle.rate;
  }
  return sample;
}

/// Returns the estimate of the Nadaraya-Watson estimator for the input `query`. `inputs` and
/// `outputs` have one row per training sample.
std::vector<Real> nadaraya_watson(const Rows& inputs, const Rows& outputs,
                                  const std::vector<Real>& query, const Real& sigma) {
  std::vector<Real> squared_distance;
  for (const auto& input : inputs) {
    Real sum = 0;
    for (std::size_t f = 0; f < query.size(); ++f)
      sum += (query[f] - input[f]) * (query[f] - input[f]);
    squared_distance.push_back(sum);
  }
  const Real min_squared_distance = *std::ranges::min_element(squared_distance);
  std::vector<Real> estimate(outputs.front().size(), Real(0));
  Real weights = 0;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const Real weight = exp(-(squared_distance[i] - min_squared_distance) / (2 * sigma * sigma));
    weights += weight;
    for (std::size_t j = 0; j < estimate.size(); ++j) estimate[j] += weight * outputs[i][j];
  }
  for (Real& value : estimate) value /= weights;
  return estimate;
}

}  // namespace

std::vector<Real> regression_network_program(const Arguments& arguments) {
  const Rows inputs = arguments.rows("inputs");
  const Rows outputs = arguments.rows("outputs");
  const Real sigma = arguments.has("spread")
                         ? Real(arguments.positive("spread") / (sqrt(Real(2)) * Real("0.8326")))
                         : arguments.positive("sigma");
  if (inputs.size() != outputs.size()) arguments.fail("outputs", "expected one row per input row");
  std::vector<Real> values;
  for (const auto& query : arguments.rows("queries", inputs.front().size())) {
    for (const Real& y : nadaraya_watson(inputs, outputs, query, sigma)) values.push_back(y);
  }
  return values;
}

std::vector<Real> manipulator_grnn_program(const Arguments& arguments) {
  const ManipulatorNumbers manipulator = read_planar_manipulator(arguments);
  const PlanarWrench wrench = read_wrench(arguments);
  const Arguments trajectory = trajectory_arguments(arguments);
  const Real step = arguments.positive("step_s");
  Rows inputs, outputs;
  for (int k = 0; k < arguments.natural_number("train"); ++k) {
    const Sample sample = sample_at_time(manipulator, trajectory, wrench, k * step);
    inputs.push_back(sample.torques);
    outputs.push_back(sample.joints);
  }
  const std::vector<Real> queries = arguments.numbers("queries");
  const std::string output = arguments.choice("output", "", {"angles", "velocities"});
  const std::size_t first = output == "angles" ? 0 : 3;
  std::vector<Real> values(3 * queries.size());
  for (std::size_t q = 0; q < queries.size(); ++q) {
    const Sample query = sample_at_time(manipulator, trajectory, wrench, queries[q] * step);
    const auto found = nadaraya_watson(inputs, outputs, query.torques, arguments.positive("sigma"));
    for (std::size_t j = 0; j < 3; ++j) values[j * queries.size() + q] = found[first + j];
  }
  return values;
}

}  // namespace trammel::references
