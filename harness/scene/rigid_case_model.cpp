#include <algorithm>

#include "harness/scene/case_model.h"
#include "solver/model/model.h"
#include "solver/model/numbers.h"

namespace trammel::harness {
namespace {

constexpr solver::Index first_C = 6, P = 9;  // order of nodes: A1..A3, B1..B3, C1..C3, P

}  // namespace

solver::RigidManipulator read_rigid_manipulator(const JsonView& analysis,
                                                const CaseModel& case_model) {
  if (!case_model.manipulator) throw analysis.error("expected a model with 'manipulator'");
  const JsonView model = JsonView(analysis.document())["model"];
  for (const char* kind :
       {"members", "plates", "rigid_bodies", "point_masses", "springs", "supports"}) {
    const auto parts = model.find(kind);
    if (!parts || parts->size() == 0) continue;
    throw parts->error("this analysis does not support parts other than the manipulator");
  }
  if (const auto loads = model.find("loads")) {
    const auto names = loads->entries();
    for (std::size_t i = 0; i < names.size(); ++i) {
      const solver::Index node = case_model.structure.loads[i].node;
      if (node >= first_C && node <= P) continue;
      throw names[i].second["node"].error(
          "a load requires a node of the platform: P, C1, C2 or C3");
    }
  }
  solver::RigidManipulator manipulator = solver::rigid_manipulator(*case_model.manipulator);
  manipulator.gravity = case_model.structure.gravity;
  return manipulator;
}

Eigen::Vector3d wrench_on_platform(const CaseModel& case_model, const solver::Pose& pose) {
  Eigen::Vector3d wrench = Eigen::Vector3d::Zero();
  for (const solver::NodalLoad& load : case_model.structure.loads) {
    if (load.node < first_C || load.node > P) continue;
    wrench += load.force;
    if (load.node == P) continue;
    const auto corner = solver::to_size(load.node - first_C);
    wrench.z() +=
        solver::cross(solver::rotated(case_model.manipulator->geometry.platform[corner], pose.phi),
                      load.force.head<2>());
  }
  return wrench;
}

bool loads_at_P_only(const CaseModel& case_model) {
  return std::ranges::all_of(case_model.structure.loads,
                             [](const solver::NodalLoad& load) { return load.node == P; });
}

}  // namespace trammel::harness
