#include "solver/elastodynamics/motion_postprocessing.h"

#include <cmath>

#include "solver/assembly/strain.h"
#include "solver/statics/postprocessing.h"

namespace trammel::solver {
namespace {

using Eigen::VectorXd;

/// End forces of the elements, with the tension of inextensible members, which is a constraint's.
Eigen::Matrix<double, 6, Eigen::Dynamic> end_forces(const MovingSystem& moving,
                                                    const MovingSystem::Forces& forces,
                                                    const VectorXd& multipliers) {
  Eigen::Matrix<double, 6, Eigen::Dynamic> ends = forces.element;
  const auto& rows = moving.constraints().rows;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (rows[r].source != ConstraintRow::Source::inextensible) continue;
    const double tension = -multipliers[static_cast<Index>(r)];
    ends(0, rows[r].index) -= tension;
    ends(3, rows[r].index) += tension;
  }
  return ends;
}

void set_triangle_stress(const MovingSystem& moving, const VectorXd& u, StaticSolution& state) {
  const auto& triangles = moving.start().model.triangles;
  state.triangle_stress.resize(std::ssize(triangles), 3);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    TrianglePoints points;
    for (std::size_t k = 0; k < 3; ++k) points[k] = moving.position(triangles[i].nodes[k]);
    const auto local = detail::gather(moving.start().coordinates.of_triangle<6>(triangles[i]), u);
    const Plate& plate = moving.start().model.plates[to_size(triangles[i].plate)];
    state.triangle_stress.row(static_cast<Index>(i)) =
        membrane_stress(plate.material, triangle_deformation(points) * local);
  }
}

}  // namespace

StaticSolution postprocess_motion(const MovingSystem& moving, const VectorXd& q,
                                  const MovingSystem::Forces& forces, WholeBalance& balance) {
  StaticSolution state;
  state.q = q;
  const Constraints& constraints = moving.constraints();
  const VectorXd multipliers = constraints.multipliers(forces.total);
  std::vector<Vector2d> positions;
  for (Index node = 0; node < std::ssize(moving.start().mesh.positions); ++node)
    positions.push_back(moving.position(node));
  recover(moving.start(),
          {positions, forces.working.u, constraints, multipliers,
           end_forces(moving, forces, multipliers)},
          state);
  set_triangle_stress(moving, forces.working.u, state);
  const ForceSum sum = sum_forces(moving.start(), positions, forces.external, state);
  state.equilibrium_residual = sum.force.norm();
  state.moment_residual = std::abs(sum.moment);
  balance.residual =
      balance.residual.cwiseMax(Vector2d(state.equilibrium_residual, state.moment_residual));
  balance.terms = balance.terms.cwiseMax(sum.terms);
  return state;
}

}  // namespace trammel::solver
