#include <cmath>

#include "harness/analysis_kinds.h"
#include "harness/design_parameter.h"
#include "harness/rigid_scene.h"
#include "solver/frequency_differences.h"

namespace trammel {
namespace {

struct Named {
  std::string name;
  DesignParameter parameter;
};

std::vector<Named> read_parameters(const Cursor& parameters) {
  std::vector<Named> read;
  for (const auto& [name, place] : parameters.entries()) {
    read.push_back({name, read_design_parameter(place)});
  }
  return read;
}

/// Error of the derivative against extrapolated differences, as a share of frequency over
/// parameter, which is what a derivative of a frequency is like.
void record_differences(const Scene& scene, const Named& named, const FrequencySensitivity& found,
                        Index column, Recorder& record, StepResult& result) {
  const Index count = found.frequency.size();
  const FrequencyDifferences differences = differentiate_frequencies(
      *scene.manipulator, scene.motion.front().pose, named.parameter, count);
  if (!differences.outcome.solved()) {
    result.outcome = differences.outcome;
    return;
  }
  const double value = parameter_value(*scene.manipulator, named.parameter);
  for (Index i = 0; i < count; ++i) {
    if (found.frequency[i] == 0) continue;  // rigid motions
    const double error = std::abs(found.derivative(i, column) - differences.derivative[i]);
    record.add("difference_error", named.name, error * value / found.frequency[i]);
  }
}

}  // namespace

StepResult analyse_sensitivity(const Cursor& analysis, const Scene& scene, bool draw,
                               Recorder& record) {
  if (scene.path) throw analysis.error("expected a model with a pose, not a trajectory");
  static_cast<void>(read_rigid_manipulator(analysis, scene));  // nothing beside the manipulator
  const std::vector<Named> named = read_parameters(analysis["parameters"]);
  std::vector<DesignParameter> parameters;
  parameters.reserve(named.size());
  for (const Named& one : named) parameters.push_back(one.parameter);
  const FrequencySensitivity found = frequency_sensitivity(
      *scene.manipulator, scene.motion.front().pose, parameters, analysis["count"].get<Index>());
  StepResult result{found.outcome, found.counters, std::nullopt};
  if (draw) result.drawing = draw_model(assemble(build_model(scene, 0)), true);
  if (!found.outcome.solved()) return result;
  for (Index i = 0; i < found.frequency.size(); ++i) {
    record.add("frequency_Hz", "", found.frequency[i]);
    if (std::isfinite(found.gap[i])) record.add("frequency_gap", "", found.gap[i]);
  }
  for (const FrequencySet& set : found.sets) {
    for (Index i = 0; i < set.count; ++i) {
      record.add("multiplicity", "", static_cast<double>(set.count));
    }
  }
  for (std::size_t p = 0; p < named.size(); ++p) {
    const auto column = static_cast<Index>(p);
    const double value = parameter_value(*scene.manipulator, named[p].parameter);
    for (Index i = 0; i < found.frequency.size(); ++i) {
      const double derivative = found.derivative(i, column);
      record.add(sensitivity_name(named[p].parameter.quantity), named[p].name, derivative);
      if (found.frequency[i] == 0) continue;  // rigid motions
      record.add("relative_sensitivity", named[p].name, derivative * value / found.frequency[i]);
    }
    if (analysis.get("differences", false)) {
      record_differences(scene, named[p], found, column, record, result);
    }
  }
  return result;
}

}  // namespace trammel
