#include "solver/effects/linear_state.h"

#include "solver/assembly/strain.h"
#include "solver/statics/postprocessing.h"

namespace trammel::solver {

using Eigen::VectorXd;

LinearState::LinearState(const Model& model, Effects applicable)
    : system(assemble(model, applicable.without(Effect::inertia))),
      solution(solve_statics(system)) {
  counters = solution.counters;
  if (!solution.outcome.solved()) return;
  u = system.T * solution.q;
  factorization_.compute(system.K);
  ++counters.factorizations;
  ElasticState state;
  state.u = u;
  forces = prestress(system, u, constraint_forces(system, state), body_forces(system));
  base = elastic(u);
  for (std::size_t e = 0; e < system.mesh.frame.size(); ++e) {
    const FrameElement& element = system.mesh.frame[e];
    const Member& member = member_of(element);
    base[e] -=
        local_load(element, member.load + element.section.mass_per_length * system.model.gravity);
    base[e] += geometric_forces(element, forces.axial[static_cast<Index>(e)],
                                forces.axial_variation[static_cast<Index>(e)], u);
  }
}

Vector3d LinearState::rigidity(const FrameElement& e) const {
  Vector3d c = frame_rigidity(e.section, member_of(e).theory, e.length);
  if (!member_of(e).axially_flexible) c[0] = 0;
  return c;
}

Vector6d LinearState::geometric_forces(const FrameElement& e, double axial, double axial_variation,
                                       const VectorXd& motion) const {
  return geometric_stiffness_forces(e, member_of(e).theory, axial, axial_variation,
                                    detail::gather(e.coordinates, motion));
}

VectorXd LinearState::solve(const VectorXd& load) {
  ++counters.solves;
  return system.T * factorization_.solve(system.T.transpose() * load);
}

std::vector<Vector6d> LinearState::elastic(const VectorXd& motion) const {
  std::vector<Vector6d> force;
  force.reserve(system.mesh.frame.size());
  for (const FrameElement& e : system.mesh.frame) {
    const Vector3d d =
        frame_deformation_matrix(e.direction, e.length) * detail::gather(e.coordinates, motion);
    force.emplace_back(end_forces(e, rigidity(e).cwiseProduct(d)));
  }
  return force;
}

Vector6d end_forces(const FrameElement& e, const Vector3d& of_deformations) {
  return frame_deformation_matrix<double>(Vector2d::UnitX(), e.length).transpose() *
         of_deformations;
}

Vector6d local_load(const FrameElement& e, const Vector2d& load) {
  return frame_rotation(e.direction) * element_load(e, load);
}

double LinearState::twice_strain_energy() const {
  return u.dot(internal_forces(system, u));
}

StateResults LinearState::results_of(const VectorXd& motion,
                                     const std::vector<Vector6d>& force) const {
  StateResults results;
  for (std::size_t i = 0; i < system.model.nodes.size(); ++i) {
    if (system.model.nodes[i].name.empty()) continue;
    const auto& node = system.coordinates.node[i];
    results.values[0].insert(results.values[0].end(), {motion[node[0]], motion[node[1]]});
    if (node[2] >= 0) results.values[1].push_back(motion[node[2]]);
  }
  for (const auto& ends : system.coordinates.member_end) {
    for (const Index rotation : ends) {
      if (rotation >= 0) results.values[1].push_back(motion[rotation]);
    }
  }
  const auto& frame = system.mesh.frame;
  for (std::size_t e = 0; e < frame.size(); ++e) {
    const bool first = e == 0 || frame[e - 1].member != frame[e].member;
    const bool last = e + 1 == frame.size() || frame[e + 1].member != frame[e].member;
    for (const Index end : {Index{0}, Index{3}}) {
      if (!(end == 0 ? first : last)) continue;
      results.values[2].insert(results.values[2].end(), {force[e][end], force[e][end + 1]});
      results.values[3].push_back(force[e][end + 2]);
    }
  }
  return results;
}

}  // namespace trammel::solver
