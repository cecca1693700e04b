#include "harness/analysis/manufactured.h"

#include "solver/assembly/consistent_load.h"
#include "solver/mesh/distorted_mesh.h"
#include "solver/linalg/factorization.h"
#include "solver/linalg/refinement.h"
#include "solver/assembly/strain.h"

namespace trammel {
namespace {

/// (K - omega^2 M) q = f
ManufacturedSolution solve(System system, double omega) {
  ManufacturedSolution solution;
  solution.counters = system.counters;
  Factorization factorization;
  factorization.compute(omega == 0 ? system.K : SparseMatrix(system.K - omega * omega * system.M));
  ++solution.counters.factorizations;
  if (factorization.exists()) {
    const Operator stiffness = stiffness_operator(system);
    const Operator dynamic = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
      return stiffness(x) - omega * omega * (system.M * x);
    };
    const Refined refined =
        refined_solve(omega == 0 ? stiffness : dynamic, factorization, system.f, solution.counters);
    solution.q = refined.x;
    if (!refined.converged()) {
      solution.outcome = {Status::singular, "the condition number has eaten all digits"};
    }
  } else {
    solution.outcome = {Status::singular, "the model is free, or at a resonance"};
  }
  solution.system = std::move(system);
  return solution;
}

void support_membrane(Model& model, const manufactured::MembraneProblem& problem) {
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Vector2d& p = model.nodes[i].position;
    const auto [x, y] = manufactured::fixed_displacements(problem, p.x(), p.y());
    if (x || y)
      model.supports.push_back({model.nodes[i].name, static_cast<Index>(i), {x, y, false}});
  }
}

void load_membrane(System& system, const manufactured::MembraneProblem& problem) {
  add_body_force(system, [&](const Vector2d& p) -> Vector2d {
    const auto state = manufactured::evaluate<double>(problem, p.x(), p.y());
    return {state.body_force[0], state.body_force[1]};
  });
  add_edge_traction(system, [&](const Vector2d& p, const Vector2d& n) -> Vector2d {
    const auto s = manufactured::evaluate<double>(problem, p.x(), p.y()).stress;
    return {s[0] * n.x() + s[2] * n.y(), s[2] * n.x() + s[1] * n.y()};
  });
}

MembraneFieldPoint exact_membrane_field(const manufactured::MembraneProblem& problem, const Vector2d& p) {
  const auto s = manufactured::evaluate<double>(problem, p.x(), p.y());
  return {
      {s.displacement[0], s.displacement[1]}, s.rotation, {s.stress[0], s.stress[1], s.stress[2]}};
}

const Vector2d kBeamAxis(0.8, 0.6);

Vector2d to_world(double along, double across) {
  return along * kBeamAxis + across * Vector2d(-kBeamAxis.y(), kBeamAxis.x());
}

manufactured::BeamProblem beam_problem(const BeamTest& test) {
  const Section& s = test.section;
  return {test.field,        test.shear,           s.EA,        s.EI,           s.kappa_GA,
          s.mass_per_length, s.inertia_per_length, test.length, test.amplitude, test.omega};
}

Model beam_model(const BeamTest& test, const manufactured::BeamState<double>& tip) {
  Member member;
  member.section = member.end_section = test.section;
  member.theory = test.shear == manufactured::ShearStrain::none ? BeamTheory::euler_bernoulli
                                                                : BeamTheory::timoshenko;
  Model model =
      mesh_line({Vector2d::Zero(), test.length * kBeamAxis, test.cells, test.distortion}, member);
  model.supports.push_back({"start", 0, {true, true, true}});
  const Vector2d force = to_world(tip.axial_force, tip.shear_force);
  model.loads.push_back({test.cells, {force.x(), force.y(), tip.bending_moment}});
  return model;
}

}  // namespace

MembraneTestResult run_membrane_test(const MembraneTest& test) {
  const auto& problem = test.problem;
  const Plate plate{"membrane", {problem.E, problem.rho, problem.nu}, test.thickness};
  Model model = mesh_rectangle(
      {problem.length, problem.height, test.cells, test.six_nodes, test.distortion}, plate);
  support_membrane(model, problem);
  System system = assemble(model);
  load_membrane(system, problem);
  MembraneTestResult result{solve(std::move(system), problem.omega), {}};
  const ManufacturedSolution& solution = result.solution;
  if (!solution.outcome.solved()) return result;
  result.errors = membrane_errors(solution.system, solution.q,
                                  [&](const Vector2d& p) { return exact_membrane_field(problem, p); });
  return result;
}

BeamTestResult run_beam_test(const BeamTest& test) {
  const manufactured::BeamProblem problem = beam_problem(test);
  const auto state = [&](const Vector2d& p) {
    return manufactured::evaluate<double>(problem, kBeamAxis.dot(p));
  };
  System system = assemble(beam_model(test, manufactured::evaluate<double>(problem, test.length)));
  add_line_load(system, [&](const Vector2d& p) -> Vector3d {
    const auto s = state(p);
    const Vector2d force = to_world(s.axial_load, s.transverse_load);
    return {force.x(), force.y(), s.moment_load};
  });
  BeamTestResult result{solve(std::move(system), test.omega), {}};
  const ManufacturedSolution& solution = result.solution;
  if (!solution.outcome.solved()) return result;
  result.errors =
      beam_errors(solution.system, solution.q, [&](const Vector2d& p) -> BeamFieldPoint {
        const auto s = state(p);
        return {s.axial, s.deflection, s.rotation, s.axial_force, s.shear_force, s.bending_moment};
      });
  return result;
}

}  // namespace trammel
