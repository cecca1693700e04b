#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/assembly/system.h"
#include "solver/model/effects.h"
#include "solver/model/outcome.h"

/// What a scene would lose without an effect, to first order, from one solution of it: an effect
/// that is small enters the solution as a small load, so that one factorization answers for all.
///
/// Statics, K u = f with k = sum B^T c B over the elements' deformations d = B u:
/// - A flexibility is a part w d of the deformations (w = 1 of elongation; Phi / (1 + Phi) of
///   antisymmetric bending is shear; the plate's, the joint springs' as a whole). Without it that
///   part is gone, as if the opposite were an initial strain: K du = -sum B^T c w d, exact where
///   the forces are statically determinate. Where members that do not stretch would be overheld,
///   the largest axial force counts as changed.
///   Source: unit-load method, Maxwell (1864), Mohr (1874).
/// - Geometric stiffening: K du = K_G u.   Source: S. P. Timoshenko, J. M. Gere, Theory of Elastic
///   Stability (1961); u^T K_G u / u^T K u estimates load over buckling load.
/// - Large displacement: chords shorten by s = integral v'^2 / 2 dx, K du = -sum B^T EA s / L;
///   the axial forces that this calls up stiffen, and section forces turn with their sections; what
///   turns as a rigid body moves by R θ^2 / 2 beside.   Source: von Karman (1910).
/// - Weights: their share of the solution, which is linear.
/// Modes, with x^T M x = 1 and the share e of the strain energy or k of the kinetic energy: a
/// flexibility left out changes the frequency by (1 - e)^(-1/2) - 1 (springs in series), an inertia
/// by (1 - k)^(-1/2) - 1, a geometric stiffness with the share g by (1 - g)^(1/2) - 1.
///   Source: Rayleigh, The Theory of Sound (1894), arts. 88-90.
namespace trammel::solver {

/// Of one effect.
struct EffectEstimate {
  Effect effect{};
  /// The dimensionless number that tells why, as `number_of` in words; the largest over the poses.
  double number = 0;
  /// Without the effect less with it, of every displacement, rotation, force and moment over the
  /// largest of its kind, or of every frequency over itself. A sum over effects is their joint
  /// change.
  Eigen::VectorXd change;
  [[nodiscard]] double size() const { return change.size() > 0 ? change.cwiseAbs().maxCoeff() : 0; }
};

struct EffectEstimates {
  Outcome outcome;  ///< without a linear solution there are no estimates
  std::vector<EffectEstimate> effects;
  Counters counters;
};

/// @param poses  the full model at one pose or more, of the same parts
/// @param admitted  the effects to estimate
[[nodiscard]] EffectEstimates estimate_static_effects(const std::vector<Model>& poses,
                                                      Effects applicable);
/// @param count  modes, from the lowest
[[nodiscard]] EffectEstimates estimate_modal_effects(const std::vector<Model>& poses,
                                                     Effects applicable, Index count);

/// Whether the members, if they did not stretch, would be held more than once along themselves, as
/// a beam between two walls: their forces are then not determined, and the geometrically exact tier
/// has no solution, for a beam that bends between walls must stretch.
[[nodiscard]] bool is_axially_overconstrained(const Model& model);

/// What an analysis can do with, and what it cannot do without.
struct EffectScope {
  Effects applicable;
  Effects required;
  /// By effect: those that are nothing without it, as the mass of links in statics without gravity.
  std::array<Effects, kEffectCount> dependents{};

  /// The set less the effect and all that it carries.
  [[nodiscard]] Effects without(Effects set, Effect effect) const;
};

/// The smallest set, going by the estimates, whose joint change stays within nine tenths of the
/// tolerance: to second order the estimates err by their square and less.
[[nodiscard]] Effects choose_effects(const EffectEstimates& estimates, const EffectScope& scope,
                                     double tolerance);

}  // namespace trammel::solver
