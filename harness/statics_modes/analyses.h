#pragma once

#include "harness/statics_modes/step_result.h"

/// Functions for statics, buckling, modes, design derivatives and manufactured solutions.
namespace trammel::harness {

/// Computes mass, center of mass and moment of inertia of each part and of the complete model.
AnalyseStep analyze_properties;

/// Computes displacements, end rotations, reactions, section forces, stresses and residuals.
AnalyseStep analyze_statics;

/// Computes geometrically exact statics, at each load factor or at all points of the equilibrium
/// path.
AnalyseStep analyze_large_statics;

/// Computes buckling load factors, which multiply all loads, and the critical forces.
AnalyseStep analyze_buckling;

/// Computes natural frequencies at rest, under the model's loads or in a rotating frame. Along a
/// path of the platform, each mode has a separate quantity (frequency_Hz:1, ...). The modes of a
/// manipulator without other parts are computed for all poses together
/// (solver/manipulator/pose_modes.h). For other models, the modes are computed separately at each
/// point.
AnalysePath analyze_modes;

/// Computes derivatives of the natural frequencies with respect to parameters of the manipulator's
/// design.
AnalysePath analyze_sensitivity;

/// Computes the first natural frequency and its derivative with respect to a design parameter. The
/// results cover the workspace at each angle of the platform.
AnalysePath analyze_sensitivity_map;

/// Computes relative error norms of a manufactured solution on one mesh.
AnalyseCase analyze_manufactured;

}  // namespace trammel::harness
