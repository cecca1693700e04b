#include "solver/effects/large_displacement_change.h"

#include <algorithm>
#include <cmath>

#include "solver/assembly/strain.h"
#include "solver/elements/triangle_interpolation.h"

namespace trammel::solver {

namespace {

using Eigen::VectorXd;

void add(StateChange& to, const StateChange& other) {
  to.u += other.u;
  for (std::size_t e = 0; e < to.force.size(); ++e) to.force[e] += other.force[e];
}

/// integral v'^2 / 2 dx of an element.
double chord_shortening(const LinearState& state, const FrameElement& e) {
  const Vector6d local = frame_rotation(e.direction) * detail::gather(e.coordinates, state.u);
  return state.geometric_forces(e, 1, 0, state.u).dot(local) / 2;
}

/// B^T c of the strains H^T H / 2 of a three-node triangle.
void add_plate_strains(const LinearState& state, VectorXd& force) {
  const Model& model = state.system.model;
  for (const Triangle& triangle : model.triangles) {
    if (triangle.quadratic()) continue;
    const auto coordinates = state.system.coordinates.of_triangle<6>(triangle);
    const auto local = detail::gather(coordinates, state.u);
    const TriangleInterpolation point = interpolate(model, triangle, Vector3d::Constant(1 / 3.0));
    Vector2d along_x = Vector2d::Zero(), along_y = Vector2d::Zero();
    for (Index i = 0; i < 3; ++i) {
      along_x += point.gradient(0, i) * local.segment<2>(2 * i);
      along_y += point.gradient(1, i) * local.segment<2>(2 * i);
    }
    const Vector3d strain((along_x.squaredNorm() + along_y.squaredNorm()) / 2,
                          (along_x.squaredNorm() - along_y.squaredNorm()) / 2,
                          along_x.dot(along_y));
    const TrianglePoints points = corners(model, triangle);
    const Plate& plate = model.plates[to_size(triangle.plate)];
    const Vector3d c =
        membrane_rigidity(plate.material, plate.thickness * std::abs(signed_area(points)));
    const Vector6d f = triangle_deformation(points).transpose() * c.cwiseProduct(strain);
    detail::scatter(coordinates, f, force);
  }
}

/// The rotation of an element's end; of a bar its own.
double end_rotation(const LinearState& state, const FrameElement& e, Index end) {
  const Index rotation = e.coordinates[to_size(end + 2)];
  if (rotation >= 0) return state.u[rotation];
  return (frame_chord_rotation_and_bending(e.direction, e.length) *
          detail::gather(e.coordinates, state.u))[0];
}

/// The farthest that second-order turning moves a point of a rigid body beside its arm's end.
double second_order_body_displacement(const LinearState& state) {
  double farthest = 0;
  for (const RigidBody& body : state.system.model.rigid_bodies) {
    const double turn = state.u[state.system.coordinates.node[to_size(body.reference)][2]];
    for (const Index node : body.attached) {
      const double arm = (state.system.model.nodes[to_size(node)].position -
                          state.system.model.nodes[to_size(body.reference)].position)
                             .norm();
      farthest = std::max(farthest, arm * turn * turn / 2);
    }
  }
  return farthest;
}

/// Of the same size, and zero.
Prestress without_forces(Prestress forces) {
  forces.axial.setZero();
  forces.axial_variation.setZero();
  forces.stress.setZero();
  forces.arm_moment.setZero();
  forces.offset_moment.setZero();
  return forces;
}

/// Section forces turn with their sections.
/// @returns the largest rotation [rad]
double turn_section_forces(const LinearState& state, StateChange& change) {
  const auto& frame = state.system.mesh.frame;
  double largest_rotation = 0;
  for (std::size_t e = 0; e < frame.size(); ++e) {
    for (const Index end : {Index{0}, Index{3}}) {
      const double turn = end_rotation(state, frame[e], end);
      largest_rotation = std::max(largest_rotation, std::abs(turn));
      const Vector2d f = state.base[e].segment<2>(end);
      change.force[e].segment<2>(end) += turn * Vector2d(f.y(), -f.x());
    }
  }
  return largest_rotation;
}

}  // namespace

StateChange change_by_geometric_stiffness(LinearState& state, const Prestress& forces) {
  StateChange change{-state.solve(geometric_stiffness_forces(state.system, forces, state.u)), {}};
  change.force = state.elastic(change.u);
  for (std::size_t e = 0; e < change.force.size(); ++e) {
    const auto i = static_cast<Index>(e);
    change.force[e] += state.geometric_forces(state.system.mesh.frame[e], forces.axial[i],
                                              forces.axial_variation[i], state.u);
  }
  return change;
}

StateChange change_by_large_displacement(LinearState& state, double& largest_rotation) {
  const auto& frame = state.system.mesh.frame;
  VectorXd strained = VectorXd::Zero(state.u.size());
  VectorXd force(static_cast<Index>(frame.size()));
  for (std::size_t e = 0; e < frame.size(); ++e) {
    force[static_cast<Index>(e)] = state.rigidity(frame[e])[0] * chord_shortening(state, frame[e]);
    const auto B = frame_deformation_matrix(frame[e].direction, frame[e].length);
    const Vector6d f = B.row(0).transpose() * force[static_cast<Index>(e)];
    detail::scatter(frame[e].coordinates, f, strained);
  }
  add_plate_strains(state, strained);
  StateChange change{-state.solve(strained), {}};
  change.force = state.elastic(change.u);
  Prestress induced = without_forces(state.forces);
  for (std::size_t e = 0; e < frame.size(); ++e) {
    const auto i = static_cast<Index>(e);
    change.force[e] += end_forces(frame[e], Vector3d(force[i], 0, 0));
    induced.axial[i] = change.force[e][3];
  }
  add(change, change_by_geometric_stiffness(state, induced));
  largest_rotation = turn_section_forces(state, change);
  change.undirected_displacement = second_order_body_displacement(state);
  return change;
}

}  // namespace trammel::solver
