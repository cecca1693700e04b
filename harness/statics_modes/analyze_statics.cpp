#include <algorithm>
#include <cmath>

#include "harness/scene/observables.h"
#include "harness/statics_modes/analyses.h"
#include "harness/statics_modes/range_warnings.h"
#include "solver/large/equilibrium.h"
#include "solver/linear/second_order.h"
#include "solver/linear/statics.h"

namespace trammel::harness {
namespace {

/// Solves statics with large displacement by geometrically exact elements.
StepResult analyze_large_displacement(const CaseModel& case_model, std::size_t step, bool draw,
                                      Recorder& record) {
  const solver::Model model = build_without_joint_elements(case_model, step);
  const auto solve = case_model.estimates_large_displacement ? solver::estimate_large_statics
                                                             : solver::solve_large_statics;
  const ModelState solution{solve(model, case_model.joint_elements)};
  StepResult result{solution.outcome, solution.counters, solution.evidence};
  if (draw)
    result.drawing = draw_model(solver::assemble(build_model(case_model, step)),
                                case_model.manipulator.has_value());
  if (!solution.outcome.solved()) return result;
  StateRecorder(model, "statics", {"bending_stress_Pa"}).record(solution, record);
  warn_of_strain(model, solution, result.warnings);
  return result;
}

}  // namespace

StepResult analyze_statics(const JsonView&, const CaseModel& case_model, std::size_t step,
                           bool draw, Recorder& record) {
  if (case_model.effects.has(solver::Effect::large_displacement))
    return analyze_large_displacement(case_model, step, draw, record);
  const solver::System system = solver::assemble(build_model(case_model, step), case_model.effects);
  ModelState solution{solver::solve_statics(
      system, {.second_order = case_model.effects.has(solver::Effect::geometric_stiffening)})};
  StepResult result{solution.outcome, solution.counters, solution.evidence};
  if (draw) result.drawing = draw_model(system, case_model.manipulator.has_value());
  if (!solution.outcome.solved()) return result;
  const double roundoff = std::pow(10.0, -solution.estimated_correct_digits);
  const double of_forces =
      std::min(1.0, roundoff + solver::relative_force_roundoff(system, solution.q));
  const solver::Model& model = system.model;
  std::vector<std::string> without;
  if (case_model.path) without = {"bending_stress_Pa"};
  // Stresses at the pins of a platform do not converge with the mesh, so node stresses are not
  // recorded.
  if (case_model.manipulator) solution.node_stress.resize(0, 3);
  StateRecorder(model, "statics", without).record(solution, record, roundoff, of_forces);
  warn_of_rotation(largest_rotation(system, system.T * solution.q), result.warnings);
  warn_of_strain(model, solution, result.warnings);
  warn_of_redundant_constraints(system, result.warnings);
  warn_of_taper(model, result.warnings);
  warn_of_near_buckling(solution, result.warnings);
  // The work of the loads is twice the strain energy.
  record.add("compliance_J", "", system.f.dot(solution.q), roundoff);
  record.add("equilibrium_residual_N", solution.equilibrium_residual);
  record.add("moment_residual_N_m", solution.moment_residual);
  record.add("estimated_correct_digits", solution.estimated_correct_digits);
  if (result.drawing)
    result.drawing->shapes.push_back(draw_shape(system, solution.q, "under the loads"));
  return result;
}

}  // namespace trammel::harness
