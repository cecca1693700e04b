#include "harness/statics_modes/manufactured.h"

#include "solver/elements/block_mesh.h"
#include "solver/linalg/factorization.h"
#include "solver/linear/element_operators.h"
#include "solver/linear/fields.h"
#include "solver/linear/row_balance.h"

namespace trammel::harness {
namespace {

/// Residuals of (K - omega^2 M) q = f with the matrices formed afresh.
void judge(const solver::System& system, double omega, ManufacturedSolution& solution) {
  const Eigen::VectorXd u = system.T * solution.q;
  solver::RowBalance<double> rows(system);
  rows.add_stiffness(u);
  if (omega != 0) rows.add_inertia(-omega * omega * u);
  rows.add_load(-system.load);
  solution.evidence.add(solver::Residual::equilibrium, rows.backward_error());
  solution.evidence.add(solver::Residual::load, rows.residual_over_load());
  solution.outcome = solver::outcome_by_evidence(solution.outcome, solution.evidence);
}

/// (K - omega^2 M) q = f
ManufacturedSolution solve(solver::System system, double omega) {
  ManufacturedSolution solution;
  solution.counters = system.counters;
  solver::Factorization factorization;
  factorization.compute(omega == 0 ? system.K
                                   : solver::SparseMatrix(system.K - omega * omega * system.M));
  ++solution.counters.factorizations;
  if (factorization.exists()) {
    const solver::Operator stiffness = solver::stiffness_operator(system);
    const solver::Operator dynamic = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
      return stiffness(x) - omega * omega * (system.M * x);
    };
    const solver::RefinedSolution refined = solver::refined_solve(
        omega == 0 ? stiffness : dynamic, factorization, system.f, solution.counters);
    solution.q = refined.x;
    if (!refined.converged()) {
      solution.outcome = {solver::Status::singular, "the condition number has eaten all digits"};
    }
    judge(system, omega, solution);
  } else {
    solution.outcome = {solver::Status::singular, "the model is free, or at a resonance"};
  }
  solution.system = std::move(system);
  return solution;
}

void support_membrane(solver::Model& model,
                      const references::manufactured::MembraneProblem& problem) {
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Eigen::Vector2d& p = model.nodes[i].position;
    const auto [x, y] = references::manufactured::fixed_displacements(problem, p.x(), p.y());
    if (x || y)
      model.supports.push_back({model.nodes[i].name, static_cast<solver::Index>(i), {x, y, false}});
  }
}

void load_membrane(solver::System& system,
                   const references::manufactured::MembraneProblem& problem) {
  solver::add_body_force(system, [&](const Eigen::Vector2d& p) -> Eigen::Vector2d {
    const auto state = references::manufactured::evaluate<double>(problem, p.x(), p.y());
    return {state.body_force[0], state.body_force[1]};
  });
  solver::add_edge_traction(
      system, [&](const Eigen::Vector2d& p, const Eigen::Vector2d& n) -> Eigen::Vector2d {
        const auto s = references::manufactured::evaluate<double>(problem, p.x(), p.y()).stress;
        return {s[0] * n.x() + s[2] * n.y(), s[2] * n.x() + s[1] * n.y()};
      });
}

solver::MembraneFieldPoint exact_membrane_field(
    const references::manufactured::MembraneProblem& problem, const Eigen::Vector2d& p) {
  const auto s = references::manufactured::evaluate<double>(problem, p.x(), p.y());
  return {
      {s.displacement[0], s.displacement[1]}, s.rotation, {s.stress[0], s.stress[1], s.stress[2]}};
}

const Eigen::Vector2d kBeamAxis(0.8, 0.6);

Eigen::Vector2d to_world(double along, double across) {
  return along * kBeamAxis + across * Eigen::Vector2d(-kBeamAxis.y(), kBeamAxis.x());
}

references::manufactured::BeamProblem beam_problem(const BeamTest& test) {
  const solver::Section& s = test.section;
  return {test.field,        test.shear,           s.EA,        s.EI,           s.kappa_GA,
          s.mass_per_length, s.inertia_per_length, test.length, test.amplitude, test.omega};
}

solver::Model beam_model(const BeamTest& test,
                         const references::manufactured::BeamState<double>& tip) {
  solver::Member member;
  member.section = member.end_section = test.section;
  member.theory = test.shear == references::manufactured::ShearStrain::none
                      ? solver::BeamTheory::euler_bernoulli
                      : solver::BeamTheory::timoshenko;
  solver::Model model = solver::mesh_line(
      {Eigen::Vector2d::Zero(), test.length * kBeamAxis, test.cells, test.distortion}, member);
  model.supports.push_back({"start", 0, {true, true, true}});
  const Eigen::Vector2d force = to_world(tip.axial_force, tip.shear_force);
  model.loads.push_back({test.cells, {force.x(), force.y(), tip.bending_moment}});
  return model;
}

}  // namespace

MembraneTestResult run_membrane_test(const MembraneTest& test) {
  const auto& problem = test.problem;
  const solver::Plate plate{"membrane", {problem.E, problem.rho, problem.nu}, test.thickness};
  solver::Model model = solver::mesh_rectangle(
      {problem.length, problem.height, test.cells, test.six_nodes, test.distortion}, plate);
  support_membrane(model, problem);
  solver::System system = solver::assemble(model);
  load_membrane(system, problem);
  MembraneTestResult result{solve(std::move(system), problem.omega), {}};
  const ManufacturedSolution& solution = result.solution;
  if (!solution.outcome.solved()) return result;
  result.errors = solver::membrane_errors(
      solution.system, solution.q,
      [&](const Eigen::Vector2d& p) { return exact_membrane_field(problem, p); });
  return result;
}

BeamTestResult run_beam_test(const BeamTest& test) {
  const references::manufactured::BeamProblem problem = beam_problem(test);
  const auto state = [&](const Eigen::Vector2d& p) {
    return references::manufactured::evaluate<double>(problem, kBeamAxis.dot(p));
  };
  solver::System system = solver::assemble(
      beam_model(test, references::manufactured::evaluate<double>(problem, test.length)));
  solver::add_line_load(system, [&](const Eigen::Vector2d& p) -> Eigen::Vector3d {
    const auto s = state(p);
    const Eigen::Vector2d force = to_world(s.axial_load, s.transverse_load);
    return {force.x(), force.y(), s.moment_load};
  });
  BeamTestResult result{solve(std::move(system), test.omega), {}};
  const ManufacturedSolution& solution = result.solution;
  if (!solution.outcome.solved()) return result;
  result.errors = solver::beam_errors(
      solution.system, solution.q, [&](const Eigen::Vector2d& p) -> solver::BeamFieldPoint {
        const auto s = state(p);
        return {s.axial, s.deflection, s.rotation, s.axial_force, s.shear_force, s.bending_moment};
      });
  return result;
}

}  // namespace trammel::harness
