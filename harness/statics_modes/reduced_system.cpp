#include "harness/statics_modes/reduced_system.h"

#include <utility>

#include "solver/linear/reduction.h"

namespace trammel::harness {

ReducedSystem reduced_system(const JsonView& analysis, solver::System system, Weight weight) {
  const auto reduction = analysis.find("reduction");
  if (!reduction) return {{}, std::move(system)};
  const Eigen::VectorXd forces_of_weight = system.T.transpose() * system.weight;
  std::vector<Eigen::VectorXd> loads = {system.f - forces_of_weight};
  if (weight == Weight::acts) loads.push_back(forces_of_weight);
  if (const auto modes = reduction->find("fixed_interface_modes"))
    return {{}, solver::reduce_members(system, modes->get<solver::Index>(), loads)};
  const solver::ModalSolution modes =
      solver::solve_modes(system, {.count = (*reduction)["modes"].get<solver::Index>()});
  if (!modes.outcome.solved()) return {modes.outcome, std::move(system)};
  try {
    return {{}, solver::reduce_to_modes(system, modes, loads)};
  } catch (const solver::ModelError& error) {
    throw reduction->error(error.what());
  }
}

}  // namespace trammel::harness
