#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/effect_estimates.h"
#include "solver/element_mass.h"
#include "solver/prestressed_modes.h"
#include "solver/recovery.h"
#include "solver/strain.h"

namespace trammel {
namespace {

using Eigen::VectorXd;

/// Shares of the energies of one mode that belong to an effect.
class ModeShares {
 public:
  /// @param x  free coordinates, x^T M x = 1;  @param w2  x^T (K + K_G) x
  ModeShares(const System& system, const VectorXd& x, double w2)
      : system_(system), u_(system.T * x), w2_(w2) {}

  [[nodiscard]] double elastic(Effect effect) const {
    const auto frames = static_cast<Index>(system_.mesh.frame.size());
    const auto plates = frames + static_cast<Index>(system_.model.triangles.size());
    Index own_springs = 0;
    for (const Spring& spring : system_.model.springs) {
      own_springs += (spring.stiffness.array() != 0).count();
    }
    double energy = 0;
    Index visited = 0;
    for_each_deformation(system_, [&](const auto& coordinates, const auto& B, const auto& c) {
      const Index i = visited++;
      const auto d = (B * detail::gather(coordinates, u_)).eval();
      if (i < frames) {
        const FrameElement& e = system_.mesh.frame[static_cast<std::size_t>(i)];
        const Member& member = system_.model.members[static_cast<std::size_t>(e.member)];
        if (e.is_bar()) return;
        if (effect == Effect::axial_flexibility) energy += c[0] * d[0] * d[0];
        if (effect == Effect::shear) {
          const double phi = shear_ratio(e.section, member.theory, e.length);
          const Index last = d.size() - 1;
          energy += phi / (1 + phi) * c[last] * d[last] * d[last];
        }
        return;
      }
      const bool plate = i < plates && effect == Effect::platform_flexibility;
      const bool joint = i >= plates + own_springs && effect == Effect::joint_compliance;
      if (plate || joint) energy += d.dot(c.cwiseProduct(d));
    });
    return energy / w2_;
  }

  /// Of the members; or of the rotation of their sections alone.
  [[nodiscard]] double kinetic(bool rotary_only) const {
    double energy = 0;
    for (const FrameElement& e : system_.mesh.frame) {
      const Member& member = system_.model.members[static_cast<std::size_t>(e.member)];
      FrameElement part = e;
      if (rotary_only) {
        if (e.is_bar() || !has_rotary_inertia(member.theory)) continue;
        part.section.mass_per_length = 0;
      }
      const Vector6d motion = detail::gather(e.coordinates, u_);
      energy += motion.dot(world_mass(part, member) * motion);
    }
    if (rotary_only) return energy;
    for (std::size_t i = 0; i < system_.model.members.size(); ++i) {
      for (std::size_t end = 0; end < 2; ++end) {
        const Index rotation = system_.coordinates.member_end[i][end];
        if (rotation < 0) continue;
        energy += system_.model.members[i].ends[end].inertia * u_[rotation] * u_[rotation];
      }
    }
    return energy;
  }

 private:
  const System& system_;
  VectorXd u_;
  double w2_;
};

/// K_G of first-order forces.
SparseMatrix turning_stiffness(const System& system, Counters& counters) {
  const StaticSolution solution = solve_statics(system);
  counters.factorizations += solution.counters.factorizations;
  counters.solves += solution.counters.solves;
  if (!solution.outcome.solved()) return SparseMatrix(system.K.rows(), system.K.cols());
  ElasticState state;
  state.u = system.T * solution.q;
  return geometric_stiffness(
      system, prestress(system, state.u, constraint_forces(system, state), body_forces(system)));
}

/// The change of a frequency whose square loses the share (a stiffness), or whose inverse square
/// does (a flexibility, an inertia).
double softer(double share) {
  return std::sqrt(std::max(0.0, 1 - share)) - 1;
}
double faster(double share) {
  constexpr double kMost = 1 - 1e-12;
  return 1 / std::sqrt(1 - std::min(share, kMost)) - 1;
}

class ModalPose {
 public:
  ModalPose(const Model& model, Effects admitted, Index count)
      : system_(assemble(model, admitted)) {
    const ModesOptions options{count, EigenPath::automatic};
    const bool loaded = admitted.has(Effect::geometric_stiffening);
    modes =
        loaded ? solve_prestressed_modes(system_, options).modes : solve_modes(system_, options);
    if (!modes.outcome.solved() || !loaded || !admitted.has(Effect::gravity)) return;
    Model light = model;
    light.gravity.setZero();
    K_G_loads_ = turning_stiffness(assemble(light, admitted), modes.counters);
  }

  /// The change of every frequency; `number` becomes the largest share.
  [[nodiscard]] VectorXd without(Effect effect, double& number) const {
    VectorXd change = VectorXd::Zero(modes.frequency.size());
    for (Index i = 0; i < change.size(); ++i) {
      const double w = 2 * std::numbers::pi * modes.frequency[i];
      if (w == 0) continue;  // a rigid motion stays one
      const double share = share_of(effect, modes.shape.col(i), w * w);
      const bool stiffness = effect == Effect::geometric_stiffening || effect == Effect::gravity;
      change[i] = stiffness ? softer(share) : faster(share);
      if (std::abs(share) > std::abs(number)) number = share;
    }
    return change;
  }

  ModalSolution modes;

 private:
  [[nodiscard]] double share_of(Effect effect, const VectorXd& x, double w2) const {
    const ModeShares shares(system_, x, w2);
    switch (effect) {
      case Effect::rotary_inertia:
        return shares.kinetic(true);
      case Effect::link_mass:
        return shares.kinetic(false) - shares.kinetic(true);
      case Effect::geometric_stiffening:
      case Effect::gravity: {
        const double all = 1 - strain_products(system_, system_.T * x)(0, 0) / w2;
        if (K_G_loads_.rows() == 0) return all;
        const double loads = x.dot(K_G_loads_ * x) / w2;
        return effect == Effect::gravity ? all - loads : loads;
      }
      case Effect::inertia:
        return 1;
      default:
        return shares.elastic(effect);
    }
  }

  System system_;
  SparseMatrix K_G_loads_;  // of the loads without the weights
};

}  // namespace

EffectEstimates estimate_modal_effects(const std::vector<Model>& poses, Effects admitted,
                                       Index count) {
  EffectEstimates estimates;
  for (const Effect effect : admitted.list()) estimates.effects.push_back({effect, 0, {}});
  for (const Model& model : poses) {
    const ModalPose pose(model, admitted, count);
    estimates.counters += pose.modes.counters;
    estimates.outcome = pose.modes.outcome;
    if (!pose.modes.outcome.solved()) return estimates;
    for (EffectEstimate& one : estimates.effects) {
      const VectorXd change = pose.without(one.effect, one.number);
      VectorXd joined(one.change.size() + change.size());
      joined << one.change, change;
      one.change = joined;
    }
  }
  return estimates;
}

}  // namespace trammel
