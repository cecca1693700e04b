#include "solver/linear/system.h"

#include "solver/elements/triangle_element.h"
#include "solver/linear/element_operators.h"
#include "solver/linear/validate.h"
#include "solver/model/model.h"

namespace trammel::solver {

namespace {

std::vector<SpringElement> spring_elements(const Model& model, const Coordinates& coordinates) {
  std::vector<SpringElement> springs;
  const auto of = [&](Index node, std::size_t k) {
    return node < 0 ? Index{-1} : coordinates.node[to_size(node)][k];
  };
  for (const Spring& spring : model.springs) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double stiffness = spring.stiffness[static_cast<Index>(k)];
      if (stiffness == 0) continue;
      springs.push_back({{of(spring.nodes[1], k), of(spring.nodes[0], k)}, stiffness});
    }
  }
  for (std::size_t i = 0; i < model.members.size(); ++i) {
    for (std::size_t end = 0; end < 2; ++end) {
      const MemberEnd& joint = model.members[i].ends[end];
      if (joint.fixity != EndFixity::sprung || joint.stiffness == 0) continue;
      springs.push_back(
          {{of(model.members[i].nodes[end], 2), coordinates.member_end[i][end]}, joint.stiffness});
    }
  }
  return springs;
}

/// Returns an empty sum of element matrices with an explicit zero at each diagonal position. The
/// sparsity pattern therefore includes the free coordinates to which no element contributes.
Projection empty_element_matrix_sum(const System& system) {
  const auto& triangles = system.model.triangles;
  const bool quadratic = !triangles.empty() && triangles.front().quadratic();
  const Index size = system.constraints.free_count;
  Projection sum(system.constraints);
  sum.reserve(21 * system.mesh.frame.size() + (quadratic ? 78 : 21) * triangles.size() +
              to_size(size));
  for (Index i = 0; i < size; ++i) sum.add(i, i, 0.0);
  return sum;
}

SparseMatrix stiffness(const System& system, Counters& counters) {
  Projection sum = empty_element_matrix_sum(system);
  for_each_deformation(system, [&](const auto& coordinates, const auto& B, const auto& c) {
    sum.add(coordinates, (B.transpose() * c.asDiagonal() * B).eval());
    ++counters.element_evaluations;
  });
  return sum.build();
}

SparseMatrix mass(const System& system, Counters& counters) {
  Projection sum = empty_element_matrix_sum(system);
  for_each_mass_matrix(system, [&](const auto& coordinates, const auto& m) {
    sum.add(coordinates, m);
    if (coordinates.size() >= 6) ++counters.element_evaluations;
  });
  return sum.build();
}

void count_effects(const System& system, bool has_inertia, Counters& counters) {
  const Model& model = system.model;
  const bool has_weight = !model.gravity.isZero(0);
  for (const FrameElement& e : system.mesh.frame) {
    const Member& member = model.members[to_size(e.member)];
    const bool has_mass = e.section.mass_per_length > 0;
    const bool turns = e.section.inertia_per_length > 0;
    if (!e.is_bar() && member.axially_flexible) counters.add(Effect::axial_flexibility, 1);
    if (!e.is_bar() && has_shear_deformation(member.theory)) counters.add(Effect::shear, 1);
    if (has_inertia && (has_mass || turns)) counters.add(Effect::link_mass, 1);
    if (has_inertia && turns && has_rotary_inertia(member.theory))
      counters.add(Effect::rotary_inertia, 1);
    if (!has_weight || !has_mass) continue;
    counters.add(Effect::gravity, 1);
    counters.add(Effect::link_mass, 1);
  }
  for (const Member& member : model.members) {
    for (const MemberEnd& end : member.ends)
      if (end.fixity == EndFixity::sprung) counters.add(Effect::joint_compliance, 1);
  }
  counters.add(Effect::platform_flexibility, std::ssize(model.triangles));
  if (has_weight)
    counters.add(Effect::gravity, std::ssize(model.triangles) + std::ssize(model.masses));
  if (has_inertia) counters.add(Effect::inertia, 1);
}

Eigen::VectorXd weight_of_system(const System& system) {
  const Vector2d& gravity = system.model.gravity;
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(system.coordinates.size);
  if (gravity.isZero(0)) return weight;
  for (const FrameElement& e : system.mesh.frame)
    detail::scatter(e.coordinates, element_load(e, e.section.mass_per_length * gravity), weight);
  for_each_plate_mass(system, [&](const auto& coordinates, const auto& m) {
    // Acceleration of gravity at every node of the triangle.
    Eigen::VectorXd fall(m.cols());
    for (Index i = 0; i < fall.size(); ++i) fall[i] = gravity[i % 2];
    detail::scatter(coordinates, (m * fall).eval(), weight);
  });
  for (const PointMass& point_mass : system.model.masses) {
    const Vector2d force = point_mass.mass * gravity;
    detail::scatter(system.coordinates.node[to_size(point_mass.node)],
                    Vector3d(force.x(), force.y(), cross(point_mass.offset, force)), weight);
  }
  return weight;
}

/// Returns the loads on nodes, members and sides of plates, converted to forces on the
/// unconstrained coordinates u.
Eigen::VectorXd applied_load(const System& system) {
  const Model& model = system.model;
  const auto& node = system.coordinates.node;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(system.coordinates.size);
  for (const NodalLoad& load : model.loads) {
    // index_of throws an exception if the node has no rotation.
    if (load.force[2] != 0) {
      (void)system.coordinates.index_of(model, {Coordinate::Kind::rotation, load.node, -1, 0});
    }
    detail::scatter(node[to_size(load.node)], load.force, sum);
  }
  for (const FrameElement& e : system.mesh.frame) {
    const Vector2d& load = model.members[to_size(e.member)].load;
    if (!load.isZero(0)) detail::scatter(e.coordinates, element_load(e, load), sum);
  }
  for (const EdgeLoad& load : model.edge_loads) {
    const std::array<Vector2d, 3> forces = edge_forces(model, load);
    for (std::size_t i = 0; i < 3; ++i) {
      if (load.nodes[i] < 0) continue;
      const auto& [x, y, rotation] = node[to_size(load.nodes[i])];
      detail::scatter(std::array{x, y}, forces[i], sum);
    }
  }
  return sum;
}

}  // namespace

Vector6d element_load(const FrameElement& element, const Vector2d& line_load) {
  if (element.is_bar()) {
    Vector6d f;
    f << line_load * (element.length / 2), 0, line_load * (element.length / 2), 0;
    return f;
  }
  const Matrix6d R = frame_transformation_matrix(element.direction);
  return R.transpose() * frame_uniform_load(R.topLeftCorner<2, 2>() * line_load, element.length);
}

System assemble(const Model& model, Effects active) {
  System system;
  system.model = restrict_effects(model, active);
  validate(system.model);
  Discretisation discretization = discretize(system.model);
  system.constraints = build_constraints(system.model, discretization);
  system.mesh = std::move(discretization.mesh);
  system.coordinates = std::move(discretization.coordinates);
  system.springs = spring_elements(system.model, system.coordinates);
  system.T = system.constraints.T;
  const bool has_inertia = active.has(Effect::inertia);
  // Use swap, because Eigen 3.4 copies on assignment.
  stiffness(system, system.counters).swap(system.K);
  if (has_inertia) mass(system, system.counters).swap(system.M);
  count_effects(system, has_inertia, system.counters);
  system.weight = weight_of_system(system);
  system.load = applied_load(system) + system.weight;
  system.f = system.T.transpose() * system.load;
  return system;
}

Eigen::MatrixX3d node_motion_from_unconstrained(const System& system, const Eigen::VectorXd& u) {
  Eigen::MatrixX3d motion(std::ssize(system.model.nodes), 3);
  for (Index node = 0; node < motion.rows(); ++node) {
    const auto& c = system.coordinates.node[to_size(node)];
    motion.row(node) << u[c[0]], u[c[1]], c[2] < 0 ? kNaN : u[c[2]];
  }
  return motion;
}

Eigen::MatrixX3d node_motion(const System& system, const Eigen::VectorXd& q) {
  return node_motion_from_unconstrained(system, system.T * q);
}

}  // namespace trammel::solver
