#pragma once

#include "harness/statics_modes/step_result.h"

/// Analyses of statics, buckling, modes, design derivatives and manufactured solutions.
namespace trammel::harness {

/// Masses, their centers and moments of inertia, of each part and of the model.
AnalyseStep analyse_properties;

/// Displacements, end rotations, reactions, section forces, stresses, residuals.
AnalyseStep analyse_statics;

/// Statics in large motion, at each load factor or along the full path: geometrically exact.
AnalyseStep analyse_large_statics;

/// Multiples of all loads together at which the model buckles, and the forces at these multiples.
AnalyseStep analyse_buckling;

/// Natural frequencies, at rest, under the model's loads or in a rotating frame. Along a path there
/// is one quantity per mode, frequency_Hz:1 ... The modes of a manipulator without other parts
/// follow its pose (solver/manipulator/pose_modes.h); any other modes are computed at each point.
AnalysePath analyse_modes;

/// Derivatives of the natural frequencies with respect to parameters of the manipulator's design.
AnalysePath analyse_sensitivity;

/// The first frequency and one derivative over the workspace, at each orientation.
AnalysePath analyse_sensitivity_map;

/// Relative error norms of a manufactured solution on one mesh; needs no scene.
AnalyseCase analyse_manufactured;

}  // namespace trammel::harness
