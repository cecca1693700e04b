#include "solver/large_motion/solve/large_statics.h"

#include "solver/large_motion/solve/state_results.h"
#include "solver/large_motion/solve/static_path.h"

namespace trammel::solver {

void count_tangents(const large_motion::GeometricallyExactSystem& system, std::int64_t tangents,
                    bool moving, Counters& counters) {
  const Model& model = system.model();
  const auto plates = static_cast<std::int64_t>(model.triangles.size());
  std::int64_t all = plates, stretching = 0, shearing = 0, turning = 0, heavy = 0, spring_ends = 0;
  for (const Member& member : model.members) {
    all += member.elements;
    if (member.section.mass_per_length > 0) heavy += member.elements;
    for (const MemberEnd& end : member.ends) spring_ends += end.fixity == EndFixity::sprung ? 1 : 0;
    if (!(member.section.EI > 0)) continue;
    if (member.axially_flexible) stretching += member.elements;
    if (has_shear_deformation(member.theory)) shearing += member.elements;
    const bool turns = has_rotary_inertia(member.theory) && member.section.inertia_per_length > 0;
    if (turns) turning += member.elements;
  }
  counters.element_evaluations += tangents * all;
  counters.count(Effect::large_displacement, tangents * all);
  counters.count(Effect::geometric_stiffening, tangents * all);
  counters.count(Effect::axial_flexibility, tangents * stretching);
  counters.count(Effect::shear, tangents * shearing);
  counters.count(Effect::joint_compliance, tangents * spring_ends);
  counters.count(Effect::platform_flexibility, tangents * plates);
  if (moving) {
    counters.count(Effect::inertia, tangents);
    counters.count(Effect::rotary_inertia, tangents * turning);
  }
  if (!model.gravity.isZero(0)) counters.count(Effect::gravity, all);
  if (moving || !model.gravity.isZero(0)) counters.count(Effect::link_mass, heavy);
}

StaticSolution solve_large_statics(const Model& model,
                                   const large_motion::LargeMotionModel& large_motion) {
  const large_motion::GeometricallyExactSystem system(model, large_motion);
  large_motion::StaticPathOptions options;
  options.first_step = 0.5;
  options.small_response = 0.01;
  options.keep_points = false;
  const large_motion::StaticPath path = follow_static_path(system, options);
  StaticSolution solution;
  if (path.outcome.solved()) solution = static_solution(system, path.points.back().state);
  solution.outcome = path.outcome;
  solution.evidence = path.evidence;
  solution.counters = path.counters;
  count_tangents(system, path.counters.factorizations, false, solution.counters);
  return solution;
}

StaticSolution estimate_large_statics(const Model& model,
                                      const large_motion::LargeMotionModel& large_motion) {
  // Bending and the axial forces that follow from it correct each other in turns: every second
  // correction is smaller, and those that shrink fast have six digits after ten.
  const large_motion::NewtonOptions options{
      .max_iterations = 12, .tolerance = 1e-6, .same_state = 1e300};  // never
  const large_motion::GeometricallyExactSystem system(model, large_motion);
  large_motion::Equilibrium equilibrium(system, options);
  large_motion::State state = system.reference_state();
  bool solved = equilibrium.factor(state);
  const Index unstable = equilibrium.matrix().negative_pivots();
  solved = solved && equilibrium.solve(state, 1).outcome.solved() && equilibrium.factor(state);
  if (!solved || equilibrium.matrix().negative_pivots() != unstable)
    return solve_large_statics(model, large_motion);
  StaticSolution solution = static_solution(system, state);
  solution.counters.factorizations = equilibrium.matrix().factorizations();
  solution.counters.solves = equilibrium.matrix().solves();
  count_tangents(system, solution.counters.factorizations, false, solution.counters);
  return solution;
}

}  // namespace trammel::solver
