#include "solver/effects/static_effect_estimates.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "solver/effects/axial_constraints.h"
#include "solver/effects/energy_shares.h"
#include "solver/effects/large_displacement_change.h"
#include "solver/effects/linear_state.h"

namespace trammel::solver {

namespace {

using Eigen::VectorXd;

StateChange change_without_flexibility(LinearState& state, Effect effect, double& share) {
  const VectorXd part =
      EnergyShares(state.system, state.solution.q, state.twice_strain_energy()).forces(effect);
  const double energy = state.twice_strain_energy();
  share = energy > 0 ? part.dot(state.u) / energy : 0;
  StateChange change{-state.solve(part), {}};
  change.force = state.elastic(change.u);
  for (std::size_t e = 0; e < change.force.size(); ++e) {
    const FrameElement& element = state.system.mesh.frame[e];
    const Vector3d d = frame_deformation_matrix(element.direction, element.length) *
                       detail::gather(element.coordinates, state.u);
    const Vector3d w = deformation_share(state.system, element, effect);
    change.force[e] += end_forces(element, state.rigidity(element).cwiseProduct(w).cwiseProduct(d));
  }
  return change;
}

void negate(StateChange& change) {
  change.u = -change.u;
  for (Vector6d& force : change.force) force = -force;
}

/// Weights of the members, and of everything else.
StateChange change_without_weight(LinearState& state, bool of_members, double& share) {
  const System& system = state.system;
  VectorXd load = VectorXd::Zero(state.u.size());
  std::vector<Vector6d> own(system.mesh.frame.size(), Vector6d::Zero());
  for (std::size_t e = 0; e < system.mesh.frame.size(); ++e) {
    const FrameElement& element = system.mesh.frame[e];
    const Vector2d weight = element.section.mass_per_length * system.model.gravity;
    detail::scatter(element.coordinates, element_load(element, weight), load);
    if (of_members) own[e] = local_load(element, weight);
  }
  if (!of_members) {
    Model light = system.model;
    light.gravity.setZero();
    const System without = assemble(light, Effects::all().without(Effect::inertia));
    state.counters += without.counters;
    load = system.load - without.load - load;
  }
  StateChange change{-state.solve(load), {}};
  const double all = state.twice_strain_energy();
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

/// The largest over the members of a number that belongs to a member and its length.
template <class NumberOf>
double largest_over_members(const Model& model, const NumberOf& number_of) {
  double largest = 0;
  for (const Member& member : model.members)
    largest = std::max(largest, number_of(member, span(model, member)));
  return largest;
}

double axial_slenderness(const Member& member, double length) {
  return member.section.EI / (member.section.EA * length * length);
}

double own_shear_ratio(const Member& member, double length) {
  return member.section.EI > 0 ? shear_ratio(member.section, member.theory, length) : 0;
}

StateChange change_without(LinearState& state, Effect effect, double& number) {
  StateChange change;
  switch (effect) {
    case Effect::geometric_stiffening: {
      change = change_by_geometric_stiffness(state, state.forces);
      const double energy = state.twice_strain_energy();
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
        number = largest_over_members(state.system.model, axial_slenderness);
        const bool lost = is_axially_overconstrained(state.system.model);
        if (lost) change.indeterminate_force = state.forces.axial.cwiseAbs().maxCoeff();
      }
      if (effect == Effect::shear)
        number = largest_over_members(state.system.model, own_shear_ratio);
      return change;
  }
}

/// What every kind of result is compared with: its largest, but not round-off. Moments and
/// rotations are compared with forces and displacements over the size of the model.
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

/// Over the poses.
struct Sum {
  double number = 0, undirected_displacement = 0, indeterminate_force = 0;
  StateResults change;

  void add(const LinearState& state, const StateChange& at_pose, double number_at_pose) {
    change.append(state.results_of(at_pose.u, at_pose.force));
    undirected_displacement = std::max(undirected_displacement, at_pose.undirected_displacement);
    indeterminate_force = std::max(indeterminate_force, at_pose.indeterminate_force);
    if (std::abs(number_at_pose) > std::abs(number)) number = number_at_pose;
  }
};

}  // namespace

EffectEstimates estimate_static_effects(const std::vector<Model>& poses, Effects applicable) {
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
      const StateChange change = change_without(state, effect, number);
      sums[effect].add(state, change, number);
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
