#include "harness/statics_modes/manufactured.h"

#include <cmath>
#include <initializer_list>
#include <limits>

#include "harness/readers/field_reader.h"
#include "harness/statics_modes/analyses.h"
#include "solver/elements/block_mesh.h"
#include "solver/linalg/factorization.h"
#include "solver/linear/element_operators.h"
#include "solver/linear/fields.h"
#include "solver/linear/row_balance.h"

namespace trammel::harness {

namespace mms = references::manufactured;

TRAMMEL_WORDS(mms::MembraneField, "clamped", "cantilever", "uniform-strain", "linear-strain");
TRAMMEL_WORDS(mms::BeamField, "smooth", "cubic");
TRAMMEL_WORDS(mms::ShearStrain, "none", "from-bending", "independent");

namespace {

/// Adds the residuals of (K - omega^2 M) q = f to `solution.evidence`. The element matrices are
/// computed again for this purpose.
void add_evidence(const solver::System& system, double omega, ManufacturedSolution& solution) {
  const Eigen::VectorXd u = system.T * solution.q;
  solver::RowBalance<double> rows(system);
  rows.add_elastic_forces(u);
  if (omega != 0) rows.add_inertia_forces(-omega * omega * u);
  rows.add_load(-system.load);
  solution.evidence.add(solver::Residual::equilibrium, rows.backward_error());
  solution.evidence.add(solver::Residual::load, rows.residual_over_load());
  solution.outcome = solver::outcome_by_evidence(solution.outcome, solution.evidence);
}

/// Solves (K - omega^2 M) q = f.
ManufacturedSolution solve(solver::System system, double omega) {
  ManufacturedSolution solution;
  solution.counters = system.counters;
  solver::Factorization factorization;
  factorization.compute(omega == 0 ? system.K
                                   : solver::SparseMatrix(system.K - omega * omega * system.M));
  ++solution.counters.factorizations;
  if (factorization.is_nonsingular()) {
    const solver::Operator stiffness = solver::stiffness_operator(system);
    const solver::Operator dynamic = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
      return stiffness(x) - omega * omega * (system.M * x);
    };
    const solver::RefinedSolution refined = solver::refined_solve(
        omega == 0 ? stiffness : dynamic, factorization, system.f, solution.counters);
    solution.q = refined.x;
    if (!refined.converged())
      solution.outcome = {solver::Status::singular, "round-off error leaves no correct digit"};
    add_evidence(system, omega, solution);
  } else {
    solution.outcome = {solver::Status::singular,
                        "the matrix is singular: the model is unsupported or at a resonance"};
  }
  solution.system = std::move(system);
  return solution;
}

void support_membrane(solver::Model& model, const mms::MembraneProblem& problem) {
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Eigen::Vector2d& p = model.nodes[i].position;
    const auto [x, y] = mms::fixed_displacements(problem, p.x(), p.y());
    if (x || y)
      model.supports.push_back({model.nodes[i].name, static_cast<solver::Index>(i), {x, y, false}});
  }
}

void load_membrane(solver::System& system, const mms::MembraneProblem& problem) {
  solver::add_body_force(system, [&](const Eigen::Vector2d& p) -> Eigen::Vector2d {
    const auto state = mms::evaluate(problem, p.x(), p.y());
    return {state.body_force[0], state.body_force[1]};
  });
  solver::add_edge_traction(
      system, [&](const Eigen::Vector2d& p, const Eigen::Vector2d& n) -> Eigen::Vector2d {
        const auto s = mms::evaluate(problem, p.x(), p.y()).stress;
        return {s[0] * n.x() + s[2] * n.y(), s[2] * n.x() + s[1] * n.y()};
      });
}

solver::MembraneFieldPoint exact_membrane_field(const mms::MembraneProblem& problem,
                                                const Eigen::Vector2d& p) {
  const auto s = mms::evaluate(problem, p.x(), p.y());
  return {
      {s.displacement[0], s.displacement[1]}, s.rotation, {s.stress[0], s.stress[1], s.stress[2]}};
}

const Eigen::Vector2d kBeamAxis(0.8, 0.6);

Eigen::Vector2d to_world(double along, double across) {
  return along * kBeamAxis + across * Eigen::Vector2d(-kBeamAxis.y(), kBeamAxis.x());
}

solver::Model beam_model(const BeamTest& test, const mms::BeamState& tip) {
  const mms::BeamProblem& problem = test.problem;
  solver::Member member;
  member.section = {.EA = problem.EA,
                    .EI = problem.EI,
                    .kappa_GA = problem.kappa_GA,
                    .mass_per_length = problem.mass_per_length,
                    .inertia_per_length = problem.inertia_per_length};
  member.end_section = member.section;
  member.theory = problem.shear == mms::ShearStrain::none ? solver::BeamTheory::euler_bernoulli
                                                          : solver::BeamTheory::timoshenko;
  solver::Model model = solver::mesh_line(
      {Eigen::Vector2d::Zero(), problem.length * kBeamAxis, test.cells, test.distortion}, member);
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
  const mms::BeamProblem& problem = test.problem;
  const auto state = [&](const Eigen::Vector2d& p) {
    return mms::evaluate(problem, kBeamAxis.dot(p));
  };
  auto system = solver::assemble(beam_model(test, mms::evaluate(problem, problem.length)));
  solver::add_line_load(system, [&](const Eigen::Vector2d& p) -> Eigen::Vector3d {
    const auto s = state(p);
    const Eigen::Vector2d force = to_world(s.axial_load, s.transverse_load);
    return {force.x(), force.y(), s.moment_load};
  });
  BeamTestResult result{solve(std::move(system), problem.omega), {}};
  const ManufacturedSolution& solution = result.solution;
  if (!solution.outcome.solved()) return result;
  result.errors = solver::beam_errors(
      solution.system, solution.q, [&](const Eigen::Vector2d& p) -> solver::BeamFieldPoint {
        const auto s = state(p);
        return {s.axial, s.deflection, s.rotation, s.axial_force, s.shear_force, s.bending_moment};
      });
  return result;
}

namespace {

/// Amplitude of the manufactured displacement, relative to the length of the model. Its value is
/// arbitrary, because all reported errors are relative.
constexpr double kAmplitudePerLength = 1e-3;

MembraneTest read_membrane(const JsonView& place) {
  const JsonView part = place["membrane"];
  const solver::Material material = read_material(part["material"]);
  const double length = part.number("length_m");
  return {{part["field"].get<mms::MembraneField>(), material.E, material.nu, material.rho, length,
           part.number("height_m"), kAmplitudePerLength * length,
           place.get("angular_frequency_rad_s", 0.0)},
          part.number("thickness_m"),
          place["cells"].get<solver::Index>(),
          part.text("triangles") == "six-node",
          place.get("distortion", 0.0)};
}

BeamTest read_beam(const JsonView& place) {
  const JsonView part = place["beam"];
  const solver::Material material = read_material(part["material"]);
  const double thickness = part.number("thickness_m"), length = part.number("length_m");
  const double area = thickness * part.number("width_m"), EA = material.E * area,
               mass = material.rho * area;
  return {{part["field"].get<mms::BeamField>(), part["shear"].get<mms::ShearStrain>(), EA,
           EA * thickness * thickness / 12,
           part.get("shear_coefficient", 5.0 / 6) * EA / (2 * (1 + material.nu)), mass,
           mass * thickness * thickness / 12, length, kAmplitudePerLength * length,
           place.get("angular_frequency_rad_s", 0.0)},
          place["cells"].get<solver::Index>(),
          place.get("distortion", 0.0)};
}

/// Norm of the error of the manufactured solution, or of its derivatives of order `derivative`.
struct ErrorNorm {
  const char* name;
  double error;
  int derivative;
};

/// Records the relative error norms with their estimated round-off errors. The estimate is the
/// resolution of a double times cells^n, for an error of derivatives of order n.
StepResult record_error_norms(const ManufacturedSolution& solution, solver::Index cells, bool draw,
                              std::initializer_list<ErrorNorm> norms, Recorder& record) {
  StepResult result{solution.outcome, solution.counters, solution.evidence};
  if (draw) result.drawing = draw_model(solution.system, false);
  if (!solution.outcome.solved()) return result;
  if (result.drawing)
    result.drawing->shapes.push_back(
        draw_shape(solution.system, solution.q, "manufactured displacement"));
  for (const auto& [name, error, derivative] : norms) {
    const double rounding =
        std::numeric_limits<double>::epsilon() * std::pow(static_cast<double>(cells), derivative);
    record.add(name, "", error, rounding / error);
  }
  return result;
}

StepResult run_membrane(const JsonView& place, bool draw, Recorder& record) {
  const MembraneTest test = read_membrane(place);
  const auto [solution, errors] = run_membrane_test(test);
  return record_error_norms(solution, test.cells, draw,
                            {{"displacement_error", errors.displacement, 1},
                             {"rotation_error", errors.rotation, 1},
                             {"stress_error", errors.stress, 1},
                             {"energy_error", errors.energy, 1}},
                            record);
}

StepResult run_beam(const JsonView& place, bool draw, Recorder& record) {
  const BeamTest test = read_beam(place);
  const auto [solution, errors] = run_beam_test(test);
  return record_error_norms(solution, test.cells, draw,
                            {{"axial_displacement_error", errors.axial_displacement, 1},
                             {"axial_force_error", errors.axial_force, 1},
                             {"deflection_error", errors.deflection, 1},
                             {"rotation_error", errors.rotation, 1},
                             {"bending_moment_error", errors.bending_moment, 2},
                             {"shear_force_error", errors.shear_force, 3},
                             {"energy_error", errors.energy, 2},
                             {"nodal_deflection_error", errors.nodal_deflection, 1},
                             {"nodal_rotation_error", errors.nodal_rotation, 1}},
                            record);
}

}  // namespace

StepResult analyze_manufactured(const Document& document, const References&, bool draw,
                                Recorder& record) {
  const JsonView manufactured = JsonView(document)["analysis"]["manufactured"];
  if (manufactured.has("membrane") == manufactured.has("beam"))
    throw manufactured.error("expected exactly one of 'membrane' and 'beam'");
  try {
    return manufactured.has("membrane") ? run_membrane(manufactured, draw, record)
                                        : run_beam(manufactured, draw, record);
  } catch (const solver::ModelError& error) {
    throw manufactured.error(error.what());
  }
}

}  // namespace trammel::harness
