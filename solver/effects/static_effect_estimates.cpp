#include <algorithm>
#include <cmath>
#include <map>

#include "solver/assembly/prestress.h"
#include "solver/assembly/restrict_model_effects.h"
#include "solver/effects/effect_estimates.h"
#include "solver/elements/triangle_interpolation.h"
#include "solver/linalg/factorization.h"
#include "solver/model/numbers.h"
#include "solver/statics/postprocessing.h"
#include "solver/statics/statics.h"

namespace trammel::solver {
namespace {

using Eigen::VectorXd;

/// What a solution says, by kind: each kind is measured by its largest.
struct StateResults {
  static constexpr std::size_t kKinds = 4;  ///< displacement, rotation, force, moment
  std::array<std::vector<double>, kKinds> values;

  void append(const StateResults& other) {
    for (std::size_t k = 0; k < kKinds; ++k) {
      values[k].insert(values[k].end(), other.values[k].begin(), other.values[k].end());
    }
  }
  [[nodiscard]] double largest(std::size_t kind) const {
    double largest_value = 0;
    for (const double value : values[kind])
      largest_value = std::max(largest_value, std::abs(value));
    return largest_value;
  }
};

/// A change of the state: displacements and the forces on the elements' ends, in their axes.
struct Change {
  VectorXd u;
  std::vector<Vector6d> force;
  double undirected_displacement = 0;  ///< a further displacement, of unknown direction [m]
  double indeterminate_force = 0;      ///< a force that is lost [N]
};

/// The linear solution of a model, and how small loads change it.
class LinearState {
 public:
  LinearState(const Model& model, Effects applicable)
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

  [[nodiscard]] const Member& member_of(const FrameElement& e) const {
    return system.model.members[to_size(e.member)];
  }
  [[nodiscard]] Vector3d rigidity(const FrameElement& e) const {
    Vector3d c = frame_rigidity(e.section, member_of(e).theory, e.length);
    if (!member_of(e).axially_flexible) c[0] = 0;
    return c;
  }
  [[nodiscard]] static Vector6d local_load(const FrameElement& e, const Vector2d& load) {
    return frame_rotation(e.direction) * element_load(e, load);
  }
  [[nodiscard]] Vector6d geometric_forces(const FrameElement& e, double axial,
                                          double axial_variation, const VectorXd& motion) const {
    return geometric_stiffness_forces(e, member_of(e).theory, axial, axial_variation,
                                      detail::gather(e.coordinates, motion));
  }

  /// K^-1 of a load on the unconstrained coordinates.
  [[nodiscard]] VectorXd solve(const VectorXd& load) {
    ++counters.solves;
    return system.T * factorization_.solve(system.T.transpose() * load);
  }
  /// End forces of displacements.
  [[nodiscard]] std::vector<Vector6d> elastic(const VectorXd& motion) const {
    std::vector<Vector6d> force;
    force.reserve(system.mesh.frame.size());
    for (const FrameElement& e : system.mesh.frame) {
      const Vector3d d =
          frame_deformation(e.direction, e.length) * detail::gather(e.coordinates, motion);
      force.emplace_back(end_forces(e, rigidity(e).cwiseProduct(d)));
    }
    return force;
  }
  [[nodiscard]] static Vector6d end_forces(const FrameElement& e, const Vector3d& of_deformations) {
    return frame_deformation<double>(Vector2d::UnitX(), e.length).transpose() * of_deformations;
  }
  [[nodiscard]] double energy() const { return u.dot(internal_forces(system, u)); }
  [[nodiscard]] StateResults results_of(const VectorXd& motion,
                                        const std::vector<Vector6d>& force) const;

  System system;
  StaticSolution solution;
  VectorXd u;
  Prestress forces;
  std::vector<Vector6d> base;  ///< end forces
  Counters counters;

 private:
  Factorization factorization_;
};

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

/// How much of each of an element's three deformations is the effect's.
Vector3d part_of(const LinearState& state, const FrameElement& e, Effect effect) {
  const Member& member = state.member_of(e);
  if (effect == Effect::axial_flexibility && !e.is_bar() && member.axially_flexible) {
    return {1, 0, 0};
  }
  if (effect == Effect::shear && !e.is_bar()) {
    const double phi = shear_ratio(e.section, member.theory, e.length);
    return {0, 0, phi / (1 + phi)};
  }
  return Vector3d::Zero();
}

/// sum B^T c w d over what belongs to the effect.
VectorXd part_forces(const LinearState& state, Effect effect) {
  const System& system = state.system;
  const auto frames = static_cast<Index>(system.mesh.frame.size());
  const auto plates = frames + static_cast<Index>(system.model.triangles.size());
  Index own_springs = 0;
  for (const Spring& spring : system.model.springs) {
    own_springs += (spring.stiffness.array() != 0).count();
  }
  VectorXd force = VectorXd::Zero(system.T.rows());
  Index visited = 0;
  for_each_deformation(system, [&](const auto& coordinates, const auto& B, const auto& c) {
    const Index i = visited++;
    auto part = (c.asDiagonal() * (B * detail::gather(coordinates, state.u))).eval();
    if (i < frames) {
      const Vector3d w = part_of(state, system.mesh.frame[to_size(i)], effect);
      for (Index k = 0; k < part.size(); ++k) part[k] *= w[k];
    } else if (i < plates) {
      if (effect != Effect::platform_flexibility) return;
    } else if (effect != Effect::joint_compliance || i < plates + own_springs) {
      return;
    }
    const auto local = (B.transpose() * part).eval();
    for (std::size_t k = 0; k < coordinates.size(); ++k) {
      if (coordinates[k] >= 0) force[coordinates[k]] += local[static_cast<Index>(k)];
    }
  });
  return force;
}

Change change_without_flexibility(LinearState& state, Effect effect, double& share) {
  const VectorXd part = part_forces(state, effect);
  const double energy = state.energy();
  share = energy > 0 ? part.dot(state.u) / energy : 0;
  Change change{-state.solve(part), {}};
  change.force = state.elastic(change.u);
  for (std::size_t e = 0; e < change.force.size(); ++e) {
    const FrameElement& element = state.system.mesh.frame[e];
    const Vector3d d = frame_deformation(element.direction, element.length) *
                       detail::gather(element.coordinates, state.u);
    const Vector3d w = part_of(state, element, effect);
    change.force[e] +=
        LinearState::end_forces(element, state.rigidity(element).cwiseProduct(w).cwiseProduct(d));
  }
  return change;
}

/// Of the turning of forces with what they act in.
Change change_by_geometric_stiffness(LinearState& state, const Prestress& forces) {
  Change change{-state.solve(geometric_stiffness_forces(state.system, forces, state.u)), {}};
  change.force = state.elastic(change.u);
  for (std::size_t e = 0; e < change.force.size(); ++e) {
    const auto i = static_cast<Index>(e);
    change.force[e] += state.geometric_forces(state.system.mesh.frame[e], forces.axial[i],
                                              forces.axial_variation[i], state.u);
  }
  return change;
}

void negate(Change& change) {
  change.u = -change.u;
  for (Vector6d& force : change.force) force = -force;
}

void add(Change& to, const Change& other) {
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
    for (std::size_t k = 0; k < 6; ++k) force[coordinates[k]] += f[static_cast<Index>(k)];
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

Change change_by_large_displacement(LinearState& state, double& largest_rotation) {
  const auto& frame = state.system.mesh.frame;
  VectorXd strained = VectorXd::Zero(state.u.size());
  VectorXd force(static_cast<Index>(frame.size()));
  for (std::size_t e = 0; e < frame.size(); ++e) {
    force[static_cast<Index>(e)] = state.rigidity(frame[e])[0] * chord_shortening(state, frame[e]);
    const auto B = frame_deformation(frame[e].direction, frame[e].length);
    const Vector6d f = B.row(0).transpose() * force[static_cast<Index>(e)];
    for (std::size_t k = 0; k < 6; ++k) {
      const Index coordinate = frame[e].coordinates[k];
      if (coordinate >= 0) strained[coordinate] += f[static_cast<Index>(k)];
    }
  }
  add_plate_strains(state, strained);
  Change change{-state.solve(strained), {}};
  change.force = state.elastic(change.u);
  Prestress induced{state.forces};
  induced.axial_variation.setZero();
  induced.stress.setZero();
  induced.arm_moment.setZero();
  induced.offset_moment.setZero();
  largest_rotation = 0;
  for (std::size_t e = 0; e < frame.size(); ++e) {
    const auto i = static_cast<Index>(e);
    change.force[e] += LinearState::end_forces(frame[e], Vector3d(force[i], 0, 0));
    induced.axial[i] = change.force[e][3];
  }
  add(change, change_by_geometric_stiffness(state, induced));
  for (std::size_t e = 0; e < frame.size(); ++e) {
    for (const Index end : {Index{0}, Index{3}}) {
      const double turn = end_rotation(state, frame[e], end);
      largest_rotation = std::max(largest_rotation, std::abs(turn));
      const Vector2d f = state.base[e].segment<2>(end);
      change.force[e].segment<2>(end) += turn * Vector2d(f.y(), -f.x());
    }
  }
  change.undirected_displacement = second_order_body_displacement(state);
  return change;
}

/// Weights of the members, and of everything else.
Change change_without_weight(LinearState& state, bool of_members, double& share) {
  const System& system = state.system;
  VectorXd load = VectorXd::Zero(state.u.size());
  std::vector<Vector6d> own(system.mesh.frame.size(), Vector6d::Zero());
  for (std::size_t e = 0; e < system.mesh.frame.size(); ++e) {
    const FrameElement& element = system.mesh.frame[e];
    const Vector2d weight = element.section.mass_per_length * system.model.gravity;
    const Vector6d f = element_load(element, weight);
    for (std::size_t k = 0; k < 6; ++k) {
      if (element.coordinates[k] >= 0) load[element.coordinates[k]] += f[static_cast<Index>(k)];
    }
    if (of_members) own[e] = LinearState::local_load(element, weight);
  }
  if (!of_members) {
    Model light = system.model;
    light.gravity.setZero();
    const System without = assemble(light, Effects::all().without(Effect::inertia));
    state.counters += without.counters;
    load = system.load - without.load - load;
  }
  Change change{-state.solve(load), {}};
  const double all = state.energy();
  share = all > 0 ? std::sqrt(std::abs(load.dot(change.u)) / all) : 0;
  change.force = state.elastic(change.u);
  for (std::size_t e = 0; e < own.size(); ++e) change.force[e] += own[e];
  return change;
}

double span(const Model& model, const Member& member) {
  return (model.nodes[to_size(member.nodes[1])].position -
          model.nodes[to_size(member.nodes[0])].position)
      .norm();
}

double axial_slenderness(const LinearState& state) {
  double largest_value = 0;
  for (const Member& member : state.system.model.members) {
    const double length = span(state.system.model, member);
    largest_value =
        std::max(largest_value, member.section.EI / (member.section.EA * length * length));
  }
  return largest_value;
}

double largest_shear_ratio(const LinearState& state) {
  double largest_value = 0;
  for (const Member& member : state.system.model.members) {
    const double length = span(state.system.model, member);
    if (member.section.EI > 0) {
      largest_value = std::max(largest_value, shear_ratio(member.section, member.theory, length));
    }
  }
  return largest_value;
}

Change change_without(LinearState& state, Effect effect, double& number) {
  Change change;
  switch (effect) {
    case Effect::geometric_stiffening: {
      change = change_by_geometric_stiffness(state, state.forces);
      const double energy = state.energy();
      number = energy > 0
                   ? geometric_stiffness_forces(state.system, state.forces, state.u).dot(state.u) /
                         energy
                   : 0;
      negate(change);
      return change;
    }
    case Effect::large_displacement:
      change = change_by_large_displacement(state, number);
      negate(change);
      return change;
    case Effect::gravity:
      return change_without_weight(state, false, number);
    case Effect::link_mass:
      return change_without_weight(state, true, number);
    default:
      change = change_without_flexibility(state, effect, number);
      if (effect == Effect::axial_flexibility) {
        number = axial_slenderness(state);
        const bool lost = is_axially_overconstrained(state.system.model);
        if (lost) change.indeterminate_force = state.forces.axial.cwiseAbs().maxCoeff();
      }
      if (effect == Effect::shear) number = largest_shear_ratio(state);
      return change;
  }
}

/// What every kind of reading is measured by: its largest, but not round-off. Moments and rotations
/// are compared with forces and displacements over the size of the model.
std::array<double, StateResults::kKinds> scales_of(const StateResults& base, const Model& model) {
  constexpr double kRoundoff = 1e-9;
  Vector2d low = model.nodes.front().position, high = low;
  for (const Node& node : model.nodes) {
    low = low.cwiseMin(node.position);
    high = high.cwiseMax(node.position);
  }
  const double size = (high - low).norm();
  const double u = std::max(base.largest(0), kRoundoff * size * base.largest(1));
  const double f = std::max(base.largest(2), kRoundoff * base.largest(3) / size);
  return {u, std::max(base.largest(1), kRoundoff * u / size), f,
          std::max(base.largest(3), kRoundoff * f * size)};
}

VectorXd scaled(const StateResults& change, double undirected_displacement,
                double indeterminate_force, const std::array<double, StateResults::kKinds>& scale) {
  std::vector<double> all;
  for (std::size_t k = 0; k < StateResults::kKinds; ++k) {
    for (const double value : change.values[k]) all.push_back(scale[k] > 0 ? value / scale[k] : 0);
  }
  all.push_back(scale[0] > 0 ? undirected_displacement / scale[0] : 0);
  all.push_back(scale[2] > 0 ? indeterminate_force / scale[2] : 0);
  return Eigen::Map<const VectorXd>(all.data(), static_cast<Index>(all.size()));
}

}  // namespace

bool is_axially_overconstrained(const Model& model) {
  const Model stiff = restrict_effects(model, Effects::all().without(Effect::axial_flexibility));
  const Constraints constraints = constrain(stiff, discretise(stiff));
  for (std::size_t i = 0; i < constraints.rows.size(); ++i) {
    const bool along = constraints.rows[i].source == ConstraintRow::Source::inextensible;
    if (along && constraints.pivot[i] < 0) return true;
  }
  return false;
}

EffectEstimates estimate_static_effects(const std::vector<Model>& poses, Effects applicable) {
  struct Sum {
    double number = 0, undirected_displacement = 0, indeterminate_force = 0;
    StateResults change;
  };
  EffectEstimates estimates;
  StateResults base;
  std::map<Effect, Sum> sums;
  for (const Model& model : poses) {
    LinearState state(model, applicable);
    if (!state.solution.outcome.solved()) {
      estimates.outcome = state.solution.outcome;
      return estimates;
    }
    base.append(state.results_of(state.u, state.base));
    for (const Effect effect : applicable.list()) {
      double number = 0;
      const Change change = change_without(state, effect, number);
      Sum& sum = sums[effect];
      sum.change.append(state.results_of(change.u, change.force));
      sum.undirected_displacement =
          std::max(sum.undirected_displacement, change.undirected_displacement);
      sum.indeterminate_force = std::max(sum.indeterminate_force, change.indeterminate_force);
      if (std::abs(number) > std::abs(sum.number)) sum.number = number;
    }
    estimates.counters += state.counters;
  }
  const auto scales = scales_of(base, poses.front());
  for (const auto& [effect, sum] : sums) {
    estimates.effects.push_back(
        {effect, sum.number,
         scaled(sum.change, sum.undirected_displacement, sum.indeterminate_force, scales)});
  }
  return estimates;
}

}  // namespace trammel::solver
