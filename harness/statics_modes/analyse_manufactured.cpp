#include "harness/statics_modes/analyse_manufactured.h"

#include <cmath>
#include <initializer_list>
#include <limits>

#include "harness/readers/field_reader.h"
#include "harness/statics_modes/manufactured.h"

namespace trammel::harness {
namespace {

/// Every error is relative, so that the size of the field does not matter.
constexpr double kAmplitudePerLength = 1e-3;

/// @param thickness  in the plane [m]
solver::Section rectangle(const solver::Material& material, double thickness, double width,
                          double shear_coefficient) {
  solver::Section section;
  section.area = thickness * width;
  section.EA = material.E * section.area;
  section.EI = section.EA * thickness * thickness / 12;
  section.kappa_GA = shear_coefficient * section.EA / (2 * (1 + material.nu));
  section.mass_per_length = material.rho * section.area;
  section.inertia_per_length = section.mass_per_length * thickness * thickness / 12;
  section.section_modulus = section.area * thickness / 6;
  return section;
}

MembraneTest read_membrane(const JsonView& place) {
  const JsonView part = place["membrane"];
  const solver::Material material = read_material(part["material"]);
  MembraneTest test;
  const std::string field = part.text("field");
  test.problem.field = field == "clamped"      ? references::manufactured::MembraneField::clamped
                       : field == "cantilever" ? references::manufactured::MembraneField::cantilever
                       : field == "uniform-strain"
                           ? references::manufactured::MembraneField::uniform_strain
                           : references::manufactured::MembraneField::linear_strain;
  test.problem.E = material.E;
  test.problem.nu = material.nu;
  test.problem.rho = material.rho;
  test.problem.length = part.number("length_m");
  test.problem.height = part.number("height_m");
  test.problem.amplitude = kAmplitudePerLength * test.problem.length;
  test.problem.omega = place.get("angular_frequency_rad_s", 0.0);
  test.thickness = part.number("thickness_m");
  test.six_nodes = part.text("triangles") == "six-node";
  test.cells = place["cells"].get<solver::Index>();
  test.distortion = place.get("distortion", 0.0);
  return test;
}

BeamTest read_beam(const JsonView& place) {
  const JsonView part = place["beam"];
  const std::string shear = part.text("shear");
  BeamTest test;
  test.field = part.text("field") == "cubic" ? references::manufactured::BeamField::cubic
                                             : references::manufactured::BeamField::smooth;
  test.shear = shear == "none"           ? references::manufactured::ShearStrain::none
               : shear == "from-bending" ? references::manufactured::ShearStrain::from_bending
                                         : references::manufactured::ShearStrain::independent;
  test.section = rectangle(read_material(part["material"]), part.number("thickness_m"),
                           part.number("width_m"), part.get("shear_coefficient", 5.0 / 6));
  test.length = part.number("length_m");
  test.amplitude = kAmplitudePerLength * test.length;
  test.omega = place.get("angular_frequency_rad_s", 0.0);
  test.cells = place["cells"].get<solver::Index>();
  test.distortion = place.get("distortion", 0.0);
  return test;
}

/// An error in some norm, of the solution or of what `derivative` derivatives make of it.
struct ErrorNorm {
  const char* name;
  double error;
  int derivative;
};

/// Records norms that are errors already: what rounding leaves of them grows with each derivative,
/// by the number of cells.
StepResult record_norms(const ManufacturedSolution& solution, solver::Index cells, bool draw,
                        std::initializer_list<ErrorNorm> norms, Recorder& record) {
  StepResult result{solution.outcome, solution.counters, std::nullopt, {}, solution.evidence};
  if (draw) result.drawing = draw_model(solution.system, false);
  if (!solution.outcome.solved()) return result;
  if (result.drawing) {
    result.drawing->shapes.push_back(
        draw_shape(solution.system, solution.q, "manufactured displacement"));
  }
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
  return record_norms(solution, test.cells, draw,
                      {{"displacement_error", errors.displacement, 1},
                       {"rotation_error", errors.rotation, 1},
                       {"stress_error", errors.stress, 1},
                       {"energy_error", errors.energy, 1}},
                      record);
}

StepResult run_beam(const JsonView& place, bool draw, Recorder& record) {
  const BeamTest test = read_beam(place);
  const auto [solution, errors] = run_beam_test(test);
  return record_norms(solution, test.cells, draw,
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

StepResult analyse_manufactured(const Document& document, const References&, bool draw,
                                Recorder& record) {
  const JsonView manufactured = JsonView(document)["analysis"]["manufactured"];
  if (manufactured.has("membrane") == manufactured.has("beam")) {
    throw manufactured.error("expected either 'membrane' or 'beam'");
  }
  try {
    return manufactured.has("membrane") ? run_membrane(manufactured, draw, record)
                                        : run_beam(manufactured, draw, record);
  } catch (const solver::ModelError& error) {
    throw manufactured.error(error.what());
  }
}

}  // namespace trammel::harness
