#pragma once

#include "solver/effects/effect_estimates.h"

namespace trammel::solver {

/// By linear statics: K u = f with k = sum B^T c B over the elements' deformations d = B u:
/// - A flexibility is a part w d of the deformations (w = 1 of elongation; Phi / (1 + Phi) of
///   antisymmetric bending is shear; the plate's, the joint springs' as a whole). Without it that
///   part is gone, as if the opposite were an initial strain: K du = -sum B^T c w d, exact where
///   the forces are statically determinate. Where members that do not stretch would be overheld,
///   the largest axial force counts as changed.
///   Source: unit-load method, Maxwell (1864), Mohr (1874).
/// - Geometric stiffening: K du = K_G u.   Source: S. P. Timoshenko, J. M. Gere, Theory of Elastic
///   Stability (1961); u^T K_G u / u^T K u is a ratio of energies; it is load
///   over buckling load only where u is the buckling shape.
/// - Large displacement: chords shorten by s = integral v'^2 / 2 dx, K du = -sum B^T EA s / L;
///   the axial forces that this calls up stiffen, and section forces turn with their sections; what
///   turns as a rigid body moves by R θ^2 / 2 beside.   Source: von Karman (1910).
/// - Weights: their share of the solution, which is linear.
/// @param poses  the full model at one pose or more, of the same parts
/// @param applicable  the effects to estimate
[[nodiscard]] EffectEstimates estimate_static_effects(const std::vector<Model>& poses,
                                                      Effects applicable);

}  // namespace trammel::solver
