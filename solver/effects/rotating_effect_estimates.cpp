#include "solver/effects/rotating_effect_estimates.h"

#include <cmath>
#include <numbers>

#include "solver/assembly/rotating_frame.h"
#include "solver/assembly/strain.h"
#include "solver/effects/energy_shares.h"

namespace trammel::solver {
namespace {

using Eigen::VectorXd;

/// One mode of the rotating frame, |x| = 1, as its two real parts.
class RotatingMode {
 public:
  RotatingMode(const System& system, const SparseMatrix& gyroscopic, const SparseMatrix& softening,
               const Eigen::VectorXcd& x, double omega)
      : system_(system), re_(x.real()), im_(x.imag()), omega_(omega) {
    mass_ = sum_over_parts([&](const VectorXd& a) { return a.dot(system.M * a); });
    // x^H (i C) x of the skew C.
    coupling_ = 2 * im_.dot(gyroscopic * re_);
    const double softened = sum_over_parts([&](const VectorXd& a) { return a.dot(softening * a); });
    const double strain = sum_over_parts(
        [&](const VectorXd& a) { return strain_products(system_, system_.T * a)(0, 0); });
    stiffened_ = omega * omega * mass_ - omega * coupling_ - strain + softened;
  }

  /// Twice the change of w that a part of the energy means, over w.
  [[nodiscard]] double scale() const { return omega_ * omega_ * mass_ - omega_ * coupling_ / 2; }

  [[nodiscard]] double share(Effect effect) const {
    switch (effect) {
      case Effect::gyroscopic:
        return omega_ * coupling_ / scale() / 2;
      case Effect::geometric_stiffening:
        return stiffened_ / scale();
      case Effect::inertia:
        return 1;
      case Effect::link_mass:
        return (kinetic(false) - kinetic(true)) * omega_ * omega_ / scale();
      case Effect::rotary_inertia:
        return kinetic(true) * omega_ * omega_ / scale();
      default:
        return sum_over_parts(
            [&](const VectorXd& a) { return EnergyShares(system_, a, scale()).elastic(effect); });
    }
  }

 private:
  template <class Form>
  [[nodiscard]] double sum_over_parts(const Form& form) const {
    return form(re_) + form(im_);
  }
  [[nodiscard]] double kinetic(bool rotary_only) const {
    return sum_over_parts(
        [&](const VectorXd& a) { return EnergyShares(system_, a, 1).kinetic(rotary_only); });
  }

  const System& system_;
  VectorXd re_, im_;
  double omega_, mass_ = 0, coupling_ = 0, stiffened_ = 0;
};

}  // namespace

EffectEstimates estimate_rotating_effects(const Model& model, Effects applicable,
                                          const RotatingOptions& options,
                                          const std::vector<double>& speeds) {
  EffectEstimates estimates;
  const System system = assemble(model);
  const SparseMatrix G = gyroscopic_matrix(system);
  const SparseMatrix S = centrifugal_softening(system, options.frame.axis);
  estimates.effects = no_estimates(applicable);
  for (const double speed : speeds) {
    RotatingOptions at_speed = options;
    at_speed.frame.speed = speed;
    const RotatingModes modes = solve_rotating_modes(system, at_speed);
    estimates.counters += modes.counters;
    estimates.outcome = modes.outcome;
    if (!modes.outcome.solved()) return estimates;
    if (!modes.stable) {
      estimates.outcome = {Status::not_converged, "a motion of the rotating frame grows"};
      return estimates;
    }
    const bool has_gyroscopic_forces =
        at_speed.gyroscopic && at_speed.frame.axis == RotationAxis::normal;
    const SparseMatrix C = (has_gyroscopic_forces ? 2 * speed : 0.0) * G;
    const SparseMatrix softening = speed * speed * S;
    for (EffectEstimate& estimate : estimates.effects) {
      VectorXd change = VectorXd::Zero(modes.frequency.size());
      for (Index i = 0; i < change.size(); ++i) {
        if (!(modes.frequency[i] > 0)) continue;
        const RotatingMode mode(system, C, softening, modes.shape.col(i),
                                2 * std::numbers::pi * modes.frequency[i]);
        const double share = mode.share(estimate.effect);
        change[i] = frequency_change_without(estimate.effect, share);
        if (std::abs(share) > std::abs(estimate.number)) estimate.number = share;
      }
      estimate.append(change);
    }
  }
  return estimates;
}

}  // namespace trammel::solver
