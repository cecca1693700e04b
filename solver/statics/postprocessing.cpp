#include "solver/statics/postprocessing.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "solver/assembly/inertia.h"
#include "solver/assembly/strain.h"
#include "solver/model/numbers.h"
#include "solver/model/plane.h"

namespace trammel::solver {
namespace {

using Eigen::VectorXd;

/// Force and moment about the world origin.
struct Wrench {
  Vector2d force = Vector2d::Zero();
  double moment = 0;
  void add(const Vector2d& at, const Vector2d& f, double m = 0) {
    force += f;
    moment += m + cross(at, f);
  }
};

/// Section forces along one element: N, V and M, the forces on a face whose normal points from the
/// first to the second node; EI v'' = M, dM/dx = -V, dV/dx = -qy, dN/dx = -qx.
struct SectionForces {
  Vector3d start;
  Vector3d end;
  Vector2d load;  ///< mean (qx, qy) along and across the element, inertia among it [N/m]

  /// Between the ends: parabolas through both moments.
  [[nodiscard]] Vector3d at(double x, double length) const {
    const double straight = start[2] + (end[2] - start[2]) * x / length;
    return {start[0] - load.x() * x, start[1] - load.y() * x,
            straight - load.y() * x * (length - x) / 2};
  }
  /// dM/dx = -V at the first end; V itself is taken across the undeformed axis, and under second
  /// order theory the axial force adds its share.
  [[nodiscard]] double slope(double length) const {
    return (end[2] - start[2]) / length - load.y() * length / 2;
  }
};

Vector2d element_axes(const FrameElement& e, const Vector2d& world) {
  return {e.direction.dot(world), cross(e.direction, world)};
}

class Recovery {
 public:
  Recovery(const System& system, const RecoveredForces& forces, StaticSolution& solution)
      : system_(system), model_(system.model), forces_(forces), solution_(solution) {
    roundoff_ = force_roundoff(forces.element, box_diagonal(forces.position));
  }

  void run() {
    displacements();
    reactions();
    members();
  }

 private:
  void displacements() {
    const auto nodes = static_cast<Index>(model_.nodes.size());
    solution_.displacement.resize(nodes, 3);
    for (Index i = 0; i < nodes; ++i) {
      for (Index k = 0; k < 3; ++k) {
        const Index c =
            system_.coordinates.node[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
        solution_.displacement(i, k) = c < 0 ? kNaN : forces_.u[c];
      }
    }
    const auto members = static_cast<Index>(model_.members.size());
    solution_.end_rotation.resize(members, 2);
    for (Index i = 0; i < members; ++i) {
      for (Index end = 0; end < 2; ++end) {
        const Index c = system_.coordinates
                            .member_end[static_cast<std::size_t>(i)][static_cast<std::size_t>(end)];
        // A bar turns as a whole.
        solution_.end_rotation(i, end) = c < 0 ? chord_rotation(i) : forces_.u[c];
      }
    }
  }

  [[nodiscard]] double chord_rotation(Index member) const {
    const auto& nodes = model_.members[static_cast<std::size_t>(member)].nodes;
    const auto a = static_cast<std::size_t>(nodes[0]);
    const auto b = static_cast<std::size_t>(nodes[1]);
    const Vector2d span = forces_.position[b] - forces_.position[a];
    const Vector2d shift =
        (solution_.displacement.row(nodes[1]) - solution_.displacement.row(nodes[0])).head<2>();
    return cross(span, shift) / span.squaredNorm();
  }

  void reactions() {
    solution_.reaction.setZero(static_cast<Index>(model_.supports.size()), 3);
    for (std::size_t i = 0; i < forces_.constraints.rows.size(); ++i) {
      const ConstraintRow& row = forces_.constraints.rows[i];
      if (row.source != ConstraintRow::Source::support) continue;
      const Index u = row.terms.front().first;
      const auto& node = system_.coordinates.node[static_cast<std::size_t>(
          model_.supports[static_cast<std::size_t>(row.index)].node)];
      const Index k = u == node[0] ? 0 : u == node[1] ? 1 : 2;
      solution_.reaction(row.index, k) = forces_.multipliers[static_cast<Index>(i)];
    }
  }

  [[nodiscard]] SectionForces section_forces(Index element) const {
    const Vector6d end = forces_.element.col(element);
    const double length = system_.mesh.frame[static_cast<std::size_t>(element)].length;
    const Vector2d load = -(end.head<2>() + end.segment<2>(3)) / length;
    return {-end.head<3>(), end.tail<3>(), load};
  }

  /// |N| / A + |M| / W at a point of an element; 0 where a taper has come to its point, NaN where
  /// the section states no area or modulus, and the force is not round-off.
  [[nodiscard]] double stress(const FrameElement& e, double from_start, double x,
                              const Vector3d& forces) const {
    const Member& member = model_.members[static_cast<std::size_t>(e.member)];
    const double length = e.length * static_cast<double>(member.elements);
    const Section section = section_at(member, std::min(1.0, (from_start + x) / length));
    const bool tip = (section.area <= 0 && e.section.area > 0) ||
                     (section.section_modulus <= 0 && e.section.section_modulus > 0);
    if (tip) return 0;
    const double axial = stress_of_force(forces[0], section.area, roundoff_.force);
    const double bending = stress_of_force(forces[2], section.section_modulus, roundoff_.moment);
    return axial + bending;
  }

  /// Both ends and, under a load across, the two places where |N|/A + |M|/W can be stationary;
  /// along a taper points between as well.
  double largest_stress(const FrameElement& e, double from_start, const SectionForces& f) const {
    double largest = 0;
    const auto evaluate = [&](double x) {
      if (!(x >= 0 && x <= e.length)) return;
      largest = nan_max(largest, stress(e, from_start, x, f.at(x, e.length)));
    };
    evaluate(0);
    evaluate(e.length);
    const Member& member = model_.members[static_cast<std::size_t>(e.member)];
    const bool tapers = member.section.section_modulus != member.end_section.section_modulus ||
                        member.section.area != member.end_section.area;
    constexpr int kPoints = 16;  // of a smooth maximum between two of them less than 1 % is lost
    for (int k = 1; tapers && k < kPoints; ++k) evaluate(e.length * k / kPoints);
    if (f.load.y() != 0) {
      const double lever =
          e.section.area > 0 ? f.load.x() * e.section.section_modulus / e.section.area : 0;
      const double slope = f.slope(e.length);  // dM/dx = slope + q_y x
      evaluate((-slope - lever) / f.load.y());
      evaluate((-slope + lever) / f.load.y());
    }
    return largest;
  }

  void members() {
    const auto count = static_cast<Index>(model_.members.size());
    solution_.resultant_start.resize(count, 3);
    solution_.resultant_end.resize(count, 3);
    solution_.member_stress.setZero(count);
    double from_start = 0;
    for (std::size_t i = 0; i < system_.mesh.frame.size(); ++i) {
      const FrameElement& e = system_.mesh.frame[i];
      const bool first = i == 0 || system_.mesh.frame[i - 1].member != e.member;
      const SectionForces forces = section_forces(static_cast<Index>(i));
      if (first) from_start = 0;
      if (first) solution_.resultant_start.row(e.member) = forces.start;
      solution_.resultant_end.row(e.member) = forces.end;
      double& largest = solution_.member_stress[e.member];
      largest = nan_max(largest, largest_stress(e, from_start, forces));
      from_start += e.length;
    }
  }

  const System& system_;
  const Model& model_;
  const RecoveredForces& forces_;
  StaticSolution& solution_;
  ForceRoundoff roundoff_;
};

class Postprocessor {
 public:
  Postprocessor(const System& system, const ElasticState& state)
      : system_(system),
        model_(system.model),
        state_(state),
        u_(state.u),
        multipliers_(constraint_forces(system, state)),
        axial_(axial_forces(system, u_, multipliers_)) {}

  void run(StaticSolution& solution) const {
    std::vector<Vector2d> positions;
    for (const Node& node : model_.nodes) positions.push_back(node.position);
    recover(system_, {positions, u_, system_.constraints, multipliers_, end_forces()}, solution);
    triangles(solution);
    equilibrium(solution);
  }

  /// What the nodes do to the frame elements, in their axes.
  [[nodiscard]] Eigen::Matrix<double, 6, Eigen::Dynamic> end_forces() const {
    Eigen::Matrix<double, 6, Eigen::Dynamic> forces(6,
                                                    static_cast<Index>(system_.mesh.frame.size()));
    for (Index i = 0; i < forces.cols(); ++i) forces.col(i) = end_forces(i);
    return forces;
  }

 private:
  [[nodiscard]] Vector2d element_load(const FrameElement& e) const {
    return element_axes(e, acting_load(system_, state_, e));
  }

  /// Forces that the nodes exert on an element, in its axes: k u + k_G u + m a - f.
  [[nodiscard]] Vector6d end_forces(Index index) const {
    const FrameElement& e = system_.mesh.frame[static_cast<std::size_t>(index)];
    const Vector2d q = element_load(e);
    const Member& member = model_.members[static_cast<std::size_t>(e.member)];
    const Vector6d u = detail::gather(e.coordinates, u_);
    Vector3d s = frame_rigidity(e.section, member.theory, e.length)
                     .cwiseProduct(frame_deformation_matrix(e.direction, e.length) * u);
    s[0] = axial_[index];
    Vector6d force =
        frame_deformation_matrix(Vector2d(Vector2d::UnitX()), e.length).transpose() * s;
    if (state_.prestress) {
      const Prestress& state = *state_.prestress;
      force += geometric_stiffness_forces(e, member.theory, state.axial[index],
                                          state.axial_variation[index], u);
    }
    if (state_.acceleration.size() > 0) {
      const Vector6d a =
          frame_rotation(e.direction) * detail::gather(e.coordinates, state_.acceleration);
      force += frame_mass(e.section, member.theory, member.mass, e.length) * a;
    }
    if (e.is_bar()) {
      force.head<2>() -= q * (e.length / 2);
      force.segment<2>(3) -= q * (e.length / 2);
      return force;
    }
    return force - frame_uniform_load(q, e.length);
  }

  void triangles(StaticSolution& solution) const {
    solution.triangle_stress.resize(static_cast<Index>(model_.triangles.size()), 3);
    const auto nodes = static_cast<Index>(model_.nodes.size());
    solution.node_stress.setZero(nodes, 3);
    VectorXd area = VectorXd::Zero(nodes);
    const double h = 0.5;
    const std::array<Vector3d, 6> points = {Vector3d(1, 0, 0), Vector3d(0, 1, 0),
                                            Vector3d(0, 0, 1), Vector3d(h, h, 0),
                                            Vector3d(0, h, h), Vector3d(h, 0, h)};
    for (std::size_t i = 0; i < model_.triangles.size(); ++i) {
      const Triangle& triangle = model_.triangles[i];
      const TrianglePoints corner = corners(model_, triangle);
      const auto stress = [&](const Vector3d& at) {
        return plate_stress(system_, triangle, at, u_);
      };
      const double size = std::abs(signed_area(corner));
      solution.triangle_stress.row(static_cast<Index>(i)) = stress(Vector3d::Constant(1 / 3.0));
      for (std::size_t k = 0; k < (triangle.quadratic() ? 6 : 3); ++k) {
        solution.node_stress.row(triangle.nodes[k]) += size * stress(points[k]);
        area[triangle.nodes[k]] += size;
      }
    }
    for (Index node = 0; node < nodes; ++node) solution.node_stress.row(node) /= area[node];
  }

  /// All that the outside does to the model: loads, reactions, springs to the ground; equilibrium
  /// is that of the theory solved.
  void equilibrium(StaticSolution& solution) const {
    Wrench sum;
    const auto position = [&](Index node) -> const Vector2d& {
      return system_.mesh.positions[static_cast<std::size_t>(node)];
    };
    VectorXd load = acting_load(system_, state_);
    if (state_.prestress) {  // second-order theory: the forces turn with what they act on
      load -= geometric_stiffness_forces(system_, *state_.prestress, u_);
    }
    for (Index i = 0; i < load.size(); ++i) {
      const auto c = static_cast<std::size_t>(i);
      const Index node = system_.coordinates.node_of[c];
      const bool x = system_.coordinates.node[static_cast<std::size_t>(node)][0] == i;
      const Vector2d axis = x ? Vector2d::UnitX() : Vector2d::UnitY();
      if (system_.coordinates.is_rotation[c]) {
        sum.moment += load[i];
      } else {
        sum.add(position(node), load[i] * axis);
      }
    }
    for (std::size_t i = 0; i < model_.supports.size(); ++i) {
      const Eigen::RowVector3d r = solution.reaction.row(static_cast<Index>(i));
      sum.add(position(model_.supports[i].node), {r[0], r[1]}, r[2]);
    }
    for (const Spring& spring : model_.springs) {
      if (spring.nodes[1] >= 0) continue;
      const Eigen::RowVector3d u = solution.displacement.row(spring.nodes[0]);
      sum.add(position(spring.nodes[0]), {-spring.stiffness[0] * u[0], -spring.stiffness[1] * u[1]},
              spring.stiffness[2] == 0 ? 0.0 : -spring.stiffness[2] * u[2]);
    }
    solution.equilibrium_residual = sum.force.norm();
    solution.moment_residual = std::abs(sum.moment);
  }

  const System& system_;
  const Model& model_;
  const ElasticState& state_;
  const VectorXd& u_;
  VectorXd multipliers_;
  VectorXd axial_;
};

}  // namespace

VectorXd acting_load(const System& system, const ElasticState& state) {
  return state.load_factor * system.load +
         (state.weight_factor - state.load_factor) * system.weight;
}

Vector2d acting_load(const System& system, const ElasticState& state, const FrameElement& element) {
  const Member& member = system.model.members[static_cast<std::size_t>(element.member)];
  return state.load_factor * member.load +
         state.weight_factor * element.section.mass_per_length * system.model.gravity;
}

VectorXd constraint_forces(const System& system, const ElasticState& state) {
  if (state.constraint_forces.size() > 0) return state.constraint_forces;
  VectorXd force = internal_forces(system, state.u) - acting_load(system, state);
  if (state.prestress) force += geometric_stiffness_forces(system, *state.prestress, state.u);
  if (state.acceleration.size() > 0) force += inertia_forces(system, state.acceleration);
  return system.constraints.multipliers(force);
}

ForceRoundoff force_roundoff(const Eigen::Matrix<double, 6, Eigen::Dynamic>& ends, double size) {
  constexpr double kShare = 1e-10;  // the limit of the residual of equilibrium
  if (ends.cols() == 0) return {};
  double force = 0, moment = 0;
  for (const Index end : {0, 3}) {
    force = std::max(force, ends.middleRows<2>(end).cwiseAbs().maxCoeff());
    moment = std::max(moment, ends.row(end + 2).cwiseAbs().maxCoeff());
  }
  return {kShare * std::max(force, size > 0 ? moment / size : 0),
          kShare * std::max(moment, force * size)};
}

void recover(const System& system, const RecoveredForces& forces, StaticSolution& solution) {
  Recovery(system, forces, solution).run();
}

Eigen::Matrix<double, Eigen::Dynamic, 6> element_resultants(const System& system,
                                                            const ElasticState& state) {
  Eigen::Matrix<double, Eigen::Dynamic, 6> resultants =
      Postprocessor(system, state).end_forces().transpose();
  resultants.leftCols<3>() *= -1;
  return resultants;
}

void postprocess(const System& system, const ElasticState& state, StaticSolution& solution) {
  Postprocessor(system, state).run(solution);
}

}  // namespace trammel::solver
