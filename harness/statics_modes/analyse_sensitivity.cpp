#include "harness/statics_modes/analyse_sensitivity.h"

#include <cmath>

#include "harness/readers/option_reader.h"
#include "harness/scene/rigid_case_model.h"
#include "harness/statics_modes/design_change.h"
#include "harness/statics_modes/frequency_differences.h"
#include "solver/manipulator/frequency_sensitivity.h"

namespace trammel::harness {
namespace {

struct Named {
  std::string name;
  solver::DesignParameter parameter;
};

std::vector<Named> read_parameters(const JsonView& analysis, const CaseModel& case_model) {
  std::vector<Named> read;
  for (const auto& [name, place] : analysis["parameters"].entries()) {
    read.push_back({name, read_design_parameter(place)});
    if (!(parameter_value(*case_model.manipulator, read.back().parameter) > 0))
      throw place["property"].error("expected a property that the manipulator has");
  }
  return read;
}

/// Differences of each parameter in turn: extrapolated, or one quotient where the method has a
/// step.
solver::FrequencySensitivity derive_by(const JsonView& method, const CaseModel& case_model,
                                       const std::vector<solver::DesignParameter>& parameters,
                                       solver::Index count) {
  const solver::ManipulatorDesign& design = *case_model.manipulator;
  const solver::Pose& pose = case_model.motion.front().pose;
  solver::FrequencySensitivity all;
  for (std::size_t p = 0; p < parameters.size() && all.outcome.solved(); ++p) {
    FrequencyDifferences one;
    if (method.json() == "extrapolated-differences") {
      one = differentiate_frequencies(design, pose, parameters[p], count);
    } else {
      const auto [name, numbers] = method.entries().front();
      one = difference_quotient(design, pose, parameters[p], count, numbers.number("relative_step"),
                                name == "central-difference");
    }
    all.counters += one.counters;
    all.outcome = one.outcome;
    all.evidence.add(one.evidence);
    all.frequency = one.frequency;
    all.derivative.conservativeResize(one.derivative.size(), static_cast<solver::Index>(p) + 1);
    all.derivative.col(static_cast<solver::Index>(p)) = one.derivative;
  }
  return all;
}

/// Fills the columns of parameters without exact derivatives by differences.
void differentiate_numerically(const CaseModel& case_model,
                               const std::vector<solver::DesignParameter>& parameters,
                               solver::FrequencySensitivity& result) {
  for (std::size_t p = 0; p < parameters.size() && result.outcome.solved(); ++p) {
    if (solver::is_seeded(parameters[p].kind)) continue;
    const FrequencyDifferences found =
        differentiate_frequencies(*case_model.manipulator, case_model.motion.front().pose,
                                  parameters[p], result.frequency.size());
    result.outcome = found.outcome;
    result.evidence.add(found.evidence);
    result.counters += found.counters;
    if (!result.outcome.solved()) return;
    result.derivative.col(static_cast<solver::Index>(p)) = found.derivative;
    if (!found.derivative.allFinite()) {
      result.outcome = {solver::Status::singular,
                        "a limb is straight or folded: no step leaves it in reach"};
    }
  }
}

/// Error of the derivative against extrapolated differences, as a share of frequency over
/// parameter, which is what a derivative of a frequency is like.
void record_differences(const CaseModel& case_model, const Named& named,
                        const solver::FrequencySensitivity& found, solver::Index column,
                        Recorder& record, StepResult& result) {
  const solver::Index count = found.frequency.size();
  const FrequencyDifferences differences = differentiate_frequencies(
      *case_model.manipulator, case_model.motion.front().pose, named.parameter, count);
  if (!differences.outcome.solved()) {
    result.outcome = differences.outcome;
    return;
  }
  const double value = parameter_value(*case_model.manipulator, named.parameter);
  for (solver::Index i = 0; i < count; ++i) {
    if (found.frequency[i] == 0) continue;  // rigid motions
    const double error = std::abs(found.derivative(i, column) - differences.derivative[i]);
    record.add("finite_difference_error", named.name, error * value / found.frequency[i]);
  }
}

}  // namespace

StepResult analyse_sensitivity(const JsonView& analysis, const CaseModel& case_model, bool draw,
                               Recorder& record) {
  if (case_model.path) throw analysis.error("expected a model with a pose, not a trajectory");
  static_cast<void>(
      read_rigid_manipulator(analysis, case_model));  // nothing beside the manipulator
  const std::vector<Named> named = read_parameters(analysis, case_model);
  std::vector<solver::DesignParameter> parameters;
  parameters.reserve(named.size());
  for (const Named& one : named) parameters.push_back(one.parameter);
  const auto count = analysis["count"].get<solver::Index>();
  const auto method = analysis.find("method");
  const bool exactly = !method || method->json() == "energies";
  solver::FrequencySensitivity found;
  if (exactly) {
    found = solver::frequency_sensitivity(*case_model.manipulator, case_model.motion.front().pose,
                                          parameters, count);
    differentiate_numerically(case_model, parameters, found);
  } else {
    found = derive_by(*method, case_model, parameters, count);
  }
  StepResult result{found.outcome, found.counters, std::nullopt, {}, found.evidence};
  if (draw) result.drawing = draw_model(solver::assemble(build_model(case_model, 0)), true);
  if (!found.outcome.solved()) return result;
  for (solver::Index i = 0; i < found.frequency.size(); ++i) {
    record.add("frequency_Hz", "", found.frequency[i]);
    if (exactly && std::isfinite(found.gap[i])) record.add("frequency_gap", "", found.gap[i]);
  }
  for (const solver::FrequencySet& set : found.sets) {
    for (solver::Index i = 0; i < set.count; ++i) {
      record.add("multiplicity", "", static_cast<double>(set.count));
    }
  }
  for (std::size_t p = 0; p < named.size(); ++p) {
    const auto column = static_cast<solver::Index>(p);
    const double value = parameter_value(*case_model.manipulator, named[p].parameter);
    for (solver::Index i = 0; i < found.frequency.size(); ++i) {
      const double derivative = found.derivative(i, column);
      record.add(sensitivity_name(named[p].parameter.kind), named[p].name, derivative);
      if (found.frequency[i] == 0) continue;  // rigid motions
      record.add("relative_sensitivity", named[p].name, derivative * value / found.frequency[i]);
    }
    if (analysis.get("differences", false)) {
      record_differences(case_model, named[p], found, column, record, result);
    }
  }
  return result;
}

}  // namespace trammel::harness
