#include "solver/elastodynamics/motion_postprocessing.h"

#include <cmath>

#include "solver/assembly/strain.h"
#include "solver/model/plane.h"
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

/// Reactions, loads, weight, inertia and the drag of damping by mass are in equilibrium.
void check_equilibrium(const MovingSystem& moving, const VectorXd& external, StaticSolution& state,
                       WholeBalance& balance) {
  const Model& model = moving.start().model;
  const Coordinates& coordinates = moving.start().coordinates;
  Vector2d force = Vector2d::Zero();
  double moment = 0;
  Vector2d terms = Vector2d::Zero();
  const auto add = [&](const Vector2d& at, const Vector2d& f, double m) {
    force += f;
    moment += m + cross(at, f);
    terms[0] += f.norm();
    terms[1] += std::abs(m) + at.norm() * f.norm();
  };
  for (std::size_t node = 0; node < coordinates.node.size(); ++node) {
    const auto& c = coordinates.node[node];
    add(moving.position(static_cast<Index>(node)), {external[c[0]], external[c[1]]},
        c[2] < 0 ? 0 : external[c[2]]);
  }
  for (std::size_t i = 0; i < model.members.size(); ++i) {
    for (std::size_t end = 0; end < 2; ++end) {
      const Index own = coordinates.member_end[i][end];
      if (own >= 0 && own != coordinates.node[to_size(model.members[i].nodes[end])][2])
        moment += external[own];
    }
  }
  for (std::size_t i = 0; i < model.supports.size(); ++i) {
    const Eigen::RowVector3d r = state.reaction.row(static_cast<Index>(i));
    add(moving.position(model.supports[i].node), {r[0], r[1]}, r[2]);
  }
  state.equilibrium_residual = force.norm();
  state.moment_residual = std::abs(moment);
  balance.residual = balance.residual.cwiseMax(Vector2d(force.norm(), std::abs(moment)));
  balance.terms = balance.terms.cwiseMax(terms);
}

}  // namespace

StaticSolution postprocess_motion(const MovingSystem& moving, const VectorXd& q,
                                  const MovingSystem::Forces& forces, WholeBalance& balance) {
  StaticSolution state;
  state.q = q;
  const Constraints& constraints = moving.constraints();
  const VectorXd multipliers = constraints.multipliers(forces.total);
  std::vector<Vector2d> positions;
  for (Index node = 0; node < std::ssize(moving.start().model.nodes); ++node)
    positions.push_back(moving.position(node));
  recover(moving.start(),
          {positions, forces.working.u, constraints, multipliers,
           end_forces(moving, forces, multipliers)},
          state);
  set_triangle_stress(moving, forces.working.u, state);
  check_equilibrium(moving, forces.external, state, balance);
  return state;
}

}  // namespace trammel::solver
