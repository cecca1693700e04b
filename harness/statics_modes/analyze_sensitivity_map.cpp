#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/base/number.h"
#include "harness/base/text.h"
#include "harness/readers/option_reader.h"
#include "harness/scene/case_model.h"
#include "harness/statics_modes/analyses.h"
#include "harness/statics_modes/frequency_differences.h"
#include "solver/manipulator/sensitivity_map.h"

namespace trammel::harness {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// Sensitivities and frequencies for one orientation of the platform. The "sensitivity" in the
/// examined publication may be the value at the center, the mean or the maximum over the workspace.
struct Reading {
  double center_frequency = kNaN,
         center = kNaN;                       ///< sensitivity at the central position
  double mean_frequency = kNaN, mean = kNaN;  ///< means of frequency and sensitivity
  /// Sensitivity of largest magnitude over the positions away from the workspace boundary.
  double largest = kNaN;
};

void record_map_curves(const std::string& name, const std::string& item,
                       const std::vector<solver::Polyline>& curves, Recorder& record) {
  for (const solver::Polyline& curve : curves) {
    for (const Eigen::Vector2d& point : curve) {
      record.add(name + "_x_m", item, point.x());
      record.add(name + "_y_m", item, point.y());
    }
    record.add_missing_value(name + "_x_m", item);
    record.add_missing_value(name + "_y_m", item);
  }
}

/// Rounds a number to seven digits, which suffices for a map and halves the size of its data.
double for_map(double value) {
  if (value == 0) return value;
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 6);
  return std::round(value / unit) * unit;
}

/// Evaluates and records the sensitivity map of one orientation.
/// @param positions  true to record each position of the map
Reading evaluate_map(const solver::SensitivityMap& map, const std::string& quantity,
                     const std::string& item, double margin, bool positions, Recorder& record) {
  Reading reading{.mean_frequency = 0, .mean = 0, .largest = 0};
  double count = 0;
  for (solver::Index j = 0; j < map.grid.rows; ++j)
    for (solver::Index i = 0; i < map.grid.columns; ++i) {
      const double rate = map.derivative(j, i);
      if (!std::isfinite(rate)) continue;  // outside or on the boundary of the workspace
      if (positions) {
        const solver::Pose pose = map.grid.pose(j, i);
        record.add("position_x_m", item, for_map(pose.x));
        record.add("position_y_m", item, for_map(pose.y));
        record.add("frequency_Hz", item, for_map(map.frequency(j, i)));
        record.add(quantity, item, for_map(rate));
      }
      reading.mean_frequency += map.frequency(j, i);
      reading.mean += rate;
      ++count;
      if (map.serial_distance(j, i) < margin) continue;
      reading.largest = std::max(reading.largest, std::abs(rate));
    }
  reading.mean_frequency /= count;
  reading.mean /= count;
  return reading;
}

/// Records the increase of the magnitudes of sensitivity and frequency from the first orientation
/// to each further orientation [%].
void record_increases_from_first(const std::vector<Reading>& readings, Recorder& record) {
  const auto rise = [&](const char* name, const char* item, double Reading::*number) {
    const double first = std::abs(readings.front().*number);
    for (std::size_t k = 1; k < readings.size(); ++k)
      record.add_or_missing(name, item, 100 * (std::abs(readings[k].*number) / first - 1));
  };
  rise("sensitivity_rise_percent", "center", &Reading::center);
  rise("sensitivity_rise_percent", "mean", &Reading::mean);
  rise("sensitivity_rise_percent", "largest", &Reading::largest);
  rise("frequency_rise_percent", "center", &Reading::center_frequency);
  rise("frequency_rise_percent", "mean", &Reading::mean_frequency);
}

}  // namespace

StepResult analyze_sensitivity_map(const JsonView& analysis, const CaseModel& case_model, bool,
                                   Recorder& record) {
  if (case_model.path) throw analysis.error("this analysis requires one 'pose' (got 'trajectory')");
  static_cast<void>(
      read_rigid_manipulator(analysis, case_model));  // rejects parts other than the manipulator
  const solver::ManipulatorDesign& design = *case_model.manipulator;
  solver::DesignParameter parameter;
  if (const auto given = analysis.find("parameter")) {
    parameter = read_design_parameter(*given);
    if (!(parameter_value(design, parameter) > 0))
      throw(*given)["property"].error(
          "the manipulator does not have this property; expected another property");
    if (!solver::has_exact_derivative(parameter.kind))
      throw(*given)["property"].error("expected a length, thickness, width, E or density");
  }
  const std::string quantity = frequency_sensitivity_name(parameter.kind);
  const double margin = analysis.get("serial_margin", 0.1);
  const bool positions = analysis.get("positions", true);
  StepResult result;
  std::vector<Reading> readings;
  for (const auto& entry : analysis["orientations_deg"].entries()) {
    const auto degrees = entry.second.get<double>();
    const std::string item = "phi-" + shortest_decimal(degrees);
    solver::Pose center = case_model.motion.front().pose;
    center.phi = degrees * kDegree;
    const solver::PoseGrid grid = solver::reachable_grid(design.geometry, center.phi,
                                                         analysis["columns"].get<solver::Index>());
    const solver::SensitivityMap map = solver::map_first_frequency(design, parameter, grid);
    result.counters += map.counters;
    result.evidence.add(map.evidence);
    Reading reading = evaluate_map(map, quantity, item, margin, positions, record);
    const solver::FirstFrequency at_center = solver::first_frequency(design, parameter, center);
    result.outcome = at_center.outcome;
    result.evidence.add(at_center.evidence);
    if (!result.outcome.solved()) {
      result.outcome.reason.insert(0, "at the central position, " + item + ": ");
      return result;
    }
    reading.center_frequency = at_center.frequency;
    reading.center = at_center.derivative;
    readings.push_back(reading);
    if (positions) {
      record_map_curves("boundary", item,
                        solver::workspace_boundary(design.geometry, center.phi, 360), record);
      record_map_curves("singular", item, solver::parallel_singularities(design.geometry, grid),
                        record);
    }
    record.add_or_missing("center_frequency_Hz", "", reading.center_frequency);
    record.add_or_missing("center_" + quantity, "", reading.center);
    record.add_or_missing("mean_frequency_Hz", "", reading.mean_frequency);
    record.add_or_missing("mean_" + quantity, "", reading.mean);
    record.add_or_missing("largest_" + quantity, "", reading.largest);
  }
  record_increases_from_first(readings, record);
  return result;
}

}  // namespace trammel::harness
