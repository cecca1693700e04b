#include "solver/assembly/element_mass.h"
#include "solver/assembly/inertia.h"
#include "solver/assembly/projection.h"
#include "solver/assembly/restrict_model_effects.h"
#include "solver/assembly/strain.h"
#include "solver/assembly/system.h"
#include "solver/assembly/validate.h"
#include "solver/elements/edge_load.h"
#include "solver/linalg/symmetric_builder.h"
#include "solver/model/plane.h"

namespace trammel::solver {
namespace {

std::vector<SpringElement> spring_elements(const Model& model, const Coordinates& coordinates) {
  std::vector<SpringElement> springs;
  const auto of = [&](Index node, std::size_t k) {
    return node < 0 ? Index{-1} : coordinates.node[static_cast<std::size_t>(node)][k];
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

class Assembler {
 public:
  Assembler(Model model, Effects active, System& system) : active_(active), system_(system) {
    validate(model);
    Discretisation discretisation = discretise(model);
    system_.constraints = build_constraints(model, discretisation);
    system_.mesh = std::move(discretisation.mesh);
    system_.coordinates = std::move(discretisation.coordinates);
    system_.springs = spring_elements(model, system_.coordinates);
    system_.model = std::move(model);
    system_.T = system_.constraints.T;
  }

  void run() {
    stiffness();
    if (active_.has(Effect::inertia)) mass();
    loads();
  }

 private:
  [[nodiscard]] Index free_count() const { return system_.constraints.free_count; }
  [[nodiscard]] std::size_t entries() const {
    const auto& triangles = system_.model.triangles;
    const bool quadratic = !triangles.empty() && triangles.front().quadratic();
    return 21 * system_.mesh.frame.size() + (quadratic ? 78 : 21) * triangles.size();
  }

  [[nodiscard]] SymmetricBuilder empty_builder() const {
    SymmetricBuilder builder(free_count());
    builder.reserve(entries() + static_cast<std::size_t>(free_count()));
    // Free coordinates that carry nothing keep their place on the diagonal.
    for (Index i = 0; i < free_count(); ++i) builder.add(i, i, 0.0);
    return builder;
  }

  void stiffness() {
    SymmetricBuilder builder = empty_builder();
    Projection projection(system_.constraints, builder);
    for_each_deformation(system_, [&](const auto& coordinates, const auto& B, const auto& c) {
      projection.add(coordinates, (B.transpose() * c.asDiagonal() * B).eval());
      ++system_.counters.element_evaluations;
    });
    builder.build().swap(system_.K);
    count_stiffness();
  }

  void count_stiffness() {
    Counters& counters = system_.counters;
    for (const FrameElement& e : system_.mesh.frame) {
      const Member& member = system_.model.members[static_cast<std::size_t>(e.member)];
      if (e.is_bar()) continue;
      if (member.axially_flexible) counters.count(Effect::axial_flexibility, 1);
      if (has_shear_deformation(member.theory)) counters.count(Effect::shear, 1);
    }
    for (const Member& member : system_.model.members) {
      for (const MemberEnd& end : member.ends) {
        if (end.fixity == EndFixity::sprung) counters.count(Effect::joint_compliance, 1);
      }
    }
    counters.count(Effect::platform_flexibility,
                   static_cast<std::int64_t>(system_.model.triangles.size()));
  }

  void mass() {
    SymmetricBuilder builder = empty_builder();
    Projection projection(system_.constraints, builder);
    for_each_inertia(system_, [&](const auto& coordinates, const auto& m) {
      projection.add(coordinates, m);
      if (coordinates.size() >= 6) ++system_.counters.element_evaluations;
    });
    count_link_inertia();
    builder.build().swap(system_.M);
    system_.counters.count(Effect::inertia, 1);
  }

  void count_link_inertia() {
    for (const FrameElement& e : system_.mesh.frame) {
      if (e.section.mass_per_length == 0 && e.section.inertia_per_length == 0) continue;
      const Member& member = system_.model.members[static_cast<std::size_t>(e.member)];
      system_.counters.count(Effect::link_mass, 1);
      const bool rotary = has_rotary_inertia(member.theory) && e.section.inertia_per_length > 0;
      if (rotary) system_.counters.count(Effect::rotary_inertia, 1);
    }
  }

  template <std::size_t n, class Vector>
  void add_load(const std::array<Index, n>& coordinates, const Vector& force) {
    detail::scatter(coordinates, force, system_.load);
  }

  template <std::size_t n, class Vector>
  void add_weight(const std::array<Index, n>& coordinates, const Vector& force) {
    add_load(coordinates, force);
    detail::scatter(coordinates, force, system_.weight);
  }

  void loads() {
    const Model& model = system_.model;
    system_.load = system_.weight = Eigen::VectorXd::Zero(system_.coordinates.size);
    for (const NodalLoad& load : model.loads) {
      if (load.force[2] != 0) {  // asks for the rotation, so that a node without one is an error
        (void)system_.coordinates.number(model, {Coordinate::Kind::rotation, load.node, -1, 0});
      }
      add_load(system_.coordinates.node[static_cast<std::size_t>(load.node)], load.force);
    }
    for (const FrameElement& e : system_.mesh.frame) {
      const Member& member = model.members[static_cast<std::size_t>(e.member)];
      const Vector2d weight = e.section.mass_per_length * model.gravity;
      if (!weight.isZero(0)) {
        system_.counters.count(Effect::gravity, 1);
        system_.counters.count(Effect::link_mass, 1);
        detail::scatter(e.coordinates, element_load(e, weight), system_.weight);
      }
      const Vector2d q = member.load + weight;
      if (!q.isZero(0)) add_load(e.coordinates, element_load(e, q));
    }
    edge_loads();
    if (!model.gravity.isZero(0)) weights();
    system_.f = system_.T.transpose() * system_.load;
  }

  void edge_loads() {
    for (const EdgeLoad& load : system_.model.edge_loads) {
      const std::array<Vector2d, 3> forces = edge_forces(system_.model, load);
      for (std::size_t i = 0; i < 3; ++i) {
        if (load.nodes[i] < 0) continue;
        const auto& node = system_.coordinates.node[static_cast<std::size_t>(load.nodes[i])];
        add_load(std::array<Index, 2>{node[0], node[1]}, forces[i]);
      }
    }
  }

  void weights() {
    const Model& model = system_.model;
    system_.counters.count(Effect::gravity,
                           static_cast<std::int64_t>(model.triangles.size() + model.masses.size()));
    for_each_plate_mass(system_, [&](const auto& coordinates, const auto& m) {
      Eigen::VectorXd fall(m.cols());  // the same acceleration at every node
      for (Index i = 0; i < fall.size(); ++i) fall[i] = model.gravity[i % 2];
      add_weight(coordinates, (m * fall).eval());
    });
    for (const PointMass& point_mass : model.masses) {
      const Vector2d weight = point_mass.mass * model.gravity;
      add_weight(system_.coordinates.node[static_cast<std::size_t>(point_mass.node)],
                 Vector3d(weight.x(), weight.y(), cross(point_mass.offset, weight)));
    }
  }

  Effects active_;
  System& system_;  // no move: Eigen 3.4 copies the sparse matrices in it
};

}  // namespace

Vector6d element_load(const FrameElement& element, const Vector2d& load) {
  if (element.is_bar()) {
    Vector6d f;
    f << load * (element.length / 2), 0, load * (element.length / 2), 0;
    return f;
  }
  const Matrix6d R = frame_rotation(element.direction);
  return R.transpose() * frame_uniform_load(R.topLeftCorner<2, 2>() * load, element.length);
}

System assemble(const Model& model, Effects active) {
  System system;
  Assembler(restrict_effects(model, active), active, system).run();
  return system;
}

Eigen::MatrixX3d mesh_motion(const System& system, const Eigen::VectorXd& q) {
  const Eigen::VectorXd u = system.T * q;
  Eigen::MatrixX3d motion(static_cast<Index>(system.mesh.positions.size()), 3);
  for (Index node = 0; node < motion.rows(); ++node) {
    const auto& c = system.coordinates.node[to_size(node)];
    motion.row(node) << u[c[0]], u[c[1]], c[2] < 0 ? kNaN : u[c[2]];
  }
  return motion;
}

Eigen::MatrixX3d node_motion(const System& system, const Eigen::VectorXd& q) {
  return mesh_motion(system, q).topRows(static_cast<Index>(system.model.nodes.size()));
}

}  // namespace trammel::solver
