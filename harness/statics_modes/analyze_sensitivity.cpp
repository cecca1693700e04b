#include <cmath>
#include <iterator>
#include <optional>

#include "harness/readers/option_reader.h"
#include "harness/scene/case_model.h"
#include "harness/statics_modes/analyses.h"
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
      throw place["property"].error(
          "the manipulator does not have this property; expected another property");
  }
  return read;
}

/// Computes derivatives of natural frequencies by finite differences: extrapolated, or by one
/// difference quotient if the case states a step.
FrequencyDifferences differences_of(const std::optional<JsonView>& method,
                                    const CaseModel& case_model,
                                    const solver::DesignParameter& parameter, solver::Index count) {
  const solver::ManipulatorDesign& design = *case_model.manipulator;
  const solver::Pose& pose = case_model.motion.front().pose;
  if (!method || method->json().is_string())
    return differentiate_frequencies(design, pose, parameter, count);
  const auto [name, numbers] = method->entries().front();
  return difference_quotient(design, pose, parameter, count, numbers.number("relative_step"),
                             name == "central-difference");
}

/// Computes derivatives of the natural frequencies. If `exactly` is true, finite differences are
/// used only for parameters without an exact derivative. Otherwise, they are used for all.
solver::FrequencySensitivity derive(const JsonView& analysis, const CaseModel& case_model,
                                    const std::vector<solver::DesignParameter>& parameters,
                                    bool exactly) {
  const auto method = analysis.find("method");
  auto count = analysis["count"].get<solver::Index>();
  solver::FrequencySensitivity all;
  if (exactly) {
    all = solver::frequency_sensitivity(*case_model.manipulator, case_model.motion.front().pose,
                                        parameters, count);
    count = all.frequency.size();
  }
  for (std::size_t p = 0; p < parameters.size() && all.outcome.solved(); ++p) {
    if (exactly && solver::has_exact_derivative(parameters[p].kind)) continue;
    const FrequencyDifferences one = differences_of(method, case_model, parameters[p], count);
    all.counters += one.counters;
    all.outcome = one.outcome;
    all.evidence.add(one.evidence);
    if (!all.outcome.solved()) break;
    if (!exactly) {
      all.frequency = one.frequency;
      all.derivative.conservativeResize(one.derivative.size(), std::ssize(parameters));
    }
    all.derivative.col(static_cast<solver::Index>(p)) = one.derivative;
    if (exactly && !one.derivative.allFinite())
      all.outcome = {solver::Status::singular,
                     "a limb is straight or folded, so that links of other lengths miss the pose"};
  }
  return all;
}

/// Records the error of a derivative of the frequencies, compared with extrapolated finite
/// differences. The error is relative to the scale of the derivative, which is frequency /
/// parameter.
void record_differences(const CaseModel& case_model, const Named& named,
                        const solver::FrequencySensitivity& found, solver::Index column,
                        Recorder& record, StepResult& result) {
  const solver::Index count = found.frequency.size();
  const auto differences = differences_of(std::nullopt, case_model, named.parameter, count);
  if (!differences.outcome.solved()) {
    result.outcome = differences.outcome;
    return;
  }
  const double value = parameter_value(*case_model.manipulator, named.parameter);
  for (solver::Index i = 0; i < count; ++i) {
    if (found.frequency[i] == 0) continue;  // rigid-body motions
    const double error = std::abs(found.derivative(i, column) - differences.derivative[i]);
    record.add("finite_difference_error", named.name, error * value / found.frequency[i]);
  }
}

}  // namespace

StepResult analyze_sensitivity(const JsonView& analysis, const CaseModel& case_model, bool draw,
                               Recorder& record) {
  if (case_model.path) throw analysis.error("this analysis requires one 'pose' (got 'trajectory')");
  static_cast<void>(
      read_rigid_manipulator(analysis, case_model));  // rejects parts other than the manipulator
  const std::vector<Named> named = read_parameters(analysis, case_model);
  std::vector<solver::DesignParameter> parameters;
  parameters.reserve(named.size());
  for (const Named& one : named) parameters.push_back(one.parameter);
  const auto method = analysis.find("method");
  const bool exactly = !method || method->json() == "energies";
  const solver::FrequencySensitivity found = derive(analysis, case_model, parameters, exactly);
  StepResult result{found.outcome, found.counters, found.evidence};
  if (draw) result.drawing = draw_model(solver::assemble(build_model(case_model, 0)), true);
  if (!found.outcome.solved()) return result;
  for (solver::Index i = 0; i < found.frequency.size(); ++i) {
    record.add("frequency_Hz", found.frequency[i]);
    if (exactly && std::isfinite(found.gap[i])) record.add("frequency_gap", found.gap[i]);
  }
  for (const solver::FrequencySet& set : found.sets)
    for (solver::Index i = 0; i < set.count; ++i) record.add("multiplicity", set.count);
  for (std::size_t p = 0; p < named.size(); ++p) {
    const auto column = static_cast<solver::Index>(p);
    const double value = parameter_value(*case_model.manipulator, named[p].parameter);
    for (solver::Index i = 0; i < found.frequency.size(); ++i) {
      const double derivative = found.derivative(i, column);
      record.add(frequency_sensitivity_name(named[p].parameter.kind), named[p].name, derivative);
      if (found.frequency[i] == 0) continue;  // rigid-body motions
      record.add("relative_sensitivity", named[p].name, derivative * value / found.frequency[i]);
    }
    if (analysis.get("differences", false))
      record_differences(case_model, named[p], found, column, record, result);
  }
  return result;
}

}  // namespace trammel::harness
