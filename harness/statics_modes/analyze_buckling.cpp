#include <cmath>

#include "harness/readers/option_reader.h"
#include "harness/statics_modes/analyses.h"
#include "harness/statics_modes/range_warnings.h"
#include "solver/linear/buckling.h"

namespace trammel::harness {
namespace {

solver::BucklingOptions read_buckling_options(const JsonView& analysis) {
  return {analysis.get<solver::Index>("count", 3), read_eigen_method(analysis)};
}

/// Records the magnitudes of the nodal forces at a critical load factor: critical_force_N:NAME.
void record_forces(const JsonView& analysis, const std::string& mode, double factor,
                   double roundoff, Recorder& record) {
  const JsonView model = JsonView(analysis.document())["model"];
  const auto loads = model.find("loads");
  if (!loads) return;
  for (const auto& [name, place] : loads->entries()) {
    const auto force = place.find("force_N");
    if (!force) continue;
    const double size = std::hypot((*force)[0].get<double>(), (*force)[1].get<double>());
    if (size > 0) record.add("critical_force_N", name + mode, factor * size, roundoff);
  }
}

}  // namespace

StepResult analyze_buckling(const JsonView& analysis, const CaseModel& case_model, std::size_t step,
                            bool draw, Recorder& record) {
  const solver::System system = solver::assemble(build_model(case_model, step));
  const auto buckling = solver::solve_buckling(system, read_buckling_options(analysis));
  StepResult result{buckling.outcome, buckling.counters, buckling.evidence};
  if (draw) result.drawing = draw_model(system, case_model.manipulator.has_value());
  if (!buckling.outcome.solved()) return result;
  if (system.K.rows() == 0) {
    result.outcome = {solver::Status::singular,
                      "the model cannot buckle: every motion is restrained"};
    return result;
  }
  for (solver::Index i = 0; i < buckling.load_factor.size(); ++i) {
    const double factor = buckling.load_factor[i];
    const std::string mode = case_model.path ? std::to_string(i + 1) : "";
    record.add("load_factor", mode, factor, buckling.roundoff[i]);
    record_forces(analysis, mode.empty() ? "" : "." + mode, factor, buckling.roundoff[i], record);
    if (result.drawing && i < kMaxDrawnShapes)
      result.drawing->shapes.push_back(
          draw_shape(system, buckling.shape.col(i), mode_label(i, factor, "times the loads")));
  }
  if (buckling.load_factor.size() == 0)
    result.warnings.push_back(
        {"the number of load factors", 0, "",
         buckling.checked_factor > 0
             ? "K + factor K_G is positive definite up to a factor of " +
                   rounded(buckling.checked_factor, 3)
             : "the model has no loads, or they do not change its stiffness"});
  warn_of_taper(system.model, result.warnings);
  record.add("degrees_of_freedom", system.K.rows());
  return result;
}

}  // namespace trammel::harness
