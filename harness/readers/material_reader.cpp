#include "harness/readers/material_reader.h"

namespace trammel::harness {

Eigen::Vector2d read_point(const JsonView& point) {
  return {point[0].get<double>(), point[1].get<double>()};
}

Eigen::Vector3d read_force(const JsonView& load) {
  if (!load.has("force_N") && !load.has("moment_N_m"))
    throw load.error("the load is empty; expected 'force_N' or 'moment_N_m'");
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  if (const auto given = load.find("force_N")) force.head<2>() = read_point(*given);
  force.z() = load.get("moment_N_m", 0.0);
  return force;
}

solver::Material read_material(const JsonView& material) {
  return {material.number("E_Pa"), material.number("rho_kg_m3"), material.number("nu")};
}

solver::BeamTheory read_beam_theory(const JsonView& part) {
  const std::string word = part.get<std::string>("beam", "euler-bernoulli");
  return solver::beam_theory(word == "timoshenko" || word == "shear",
                             word == "timoshenko" || word == "rayleigh");
}

solver::MassMatrix read_mass_matrix(const JsonView& part) {
  const std::string word = part.get<std::string>("mass_matrix", "consistent");
  return word == "lumped" ? solver::MassMatrix::lumped : solver::MassMatrix::consistent;
}

bool read_axial(const JsonView& part) {
  return part.get<std::string>("axial", "flexible") == "flexible";
}

}  // namespace trammel::harness
