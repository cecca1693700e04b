#include "solver/effects/modal_effect_estimates.h"

#include <cmath>
#include <numbers>

#include "solver/assembly/strain.h"
#include "solver/effects/energy_shares.h"
#include "solver/modes/prestressed_modes.h"
#include "solver/statics/postprocessing.h"

namespace trammel::solver {
namespace {

using Eigen::VectorXd;

/// K_G of first-order forces.
SparseMatrix first_order_geometric_stiffness(const System& system, Counters& counters) {
  const StaticSolution solution = solve_statics(system);
  counters.factorizations += solution.counters.factorizations;
  counters.solves += solution.counters.solves;
  if (!solution.outcome.solved()) return SparseMatrix(system.K.rows(), system.K.cols());
  ElasticState state;
  state.u = system.T * solution.q;
  return geometric_stiffness(
      system, prestress(system, state.u, constraint_forces(system, state), body_forces(system)));
}

class ModalPose {
 public:
  ModalPose(const Model& model, Effects applicable, Index count)
      : system_(assemble(model, applicable)) {
    const ModesOptions options{count, EigenMethod::automatic};
    const bool loaded = applicable.has(Effect::geometric_stiffening);
    modes =
        loaded ? solve_prestressed_modes(system_, options).modes : solve_modes(system_, options);
    if (!modes.outcome.solved() || !loaded || !applicable.has(Effect::gravity)) return;
    Model light = model;
    light.gravity.setZero();
    K_G_loads_ = first_order_geometric_stiffness(assemble(light, applicable), modes.counters);
  }

  /// The change of every frequency; `number` becomes the largest share.
  [[nodiscard]] VectorXd without(Effect effect, double& number) const {
    VectorXd change = VectorXd::Zero(modes.frequency.size());
    for (Index i = 0; i < change.size(); ++i) {
      const double w = 2 * std::numbers::pi * modes.frequency[i];
      if (w == 0) continue;  // a rigid motion stays one
      const double share = share_of(effect, modes.shape.col(i), w * w);
      change[i] = frequency_change_without(effect, share);
      if (std::abs(share) > std::abs(number)) number = share;
    }
    return change;
  }

  ModalSolution modes;

 private:
  [[nodiscard]] double share_of(Effect effect, const VectorXd& x, double w2) const {
    const EnergyShares shares(system_, x, w2);
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

EffectEstimates estimate_modal_effects(const std::vector<Model>& poses, Effects applicable,
                                       Index count) {
  EffectEstimates estimates;
  estimates.effects = no_estimates(applicable);
  for (const Model& model : poses) {
    const ModalPose pose(model, applicable, count);
    estimates.counters += pose.modes.counters;
    estimates.outcome = pose.modes.outcome;
    if (!pose.modes.outcome.solved()) return estimates;
    for (EffectEstimate& estimate : estimates.effects) {
      estimate.append(pose.without(estimate.effect, estimate.number));
    }
  }
  return estimates;
}

}  // namespace trammel::solver
