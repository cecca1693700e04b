#pragma once

#include "harness/scene/case_model.h"
#include "harness/statics_modes/step_result.h"
#include "solver/manipulator/elastodynamics.h"

/// Analyses of motion: kinematics, response in time and frequency, dynamics of the manipulator, and
/// neural networks that approximate the dynamics.
namespace trammel::harness {

/// Computes inverse kinematics, distances from singularities, and the torques of the active joints
/// that balance the loads.
AnalyseStep analyze_kinematics;

/// Computes the response in time: output quantities at sample times, their peaks, and energies.
AnalyseStep analyze_transient;

/// Computes amplitudes of the steady response over a range of frequencies, and their peaks.
AnalyseStep analyze_harmonic;
/// Computes the motion of a model with large displacements, by geometrically exact elements.
AnalysePath analyze_large_motion;

/// Computes torques, joint angles, powers and energies of the rigid manipulator along its path.
AnalysePath analyze_inverse_dynamics;

/// Integrates the motion of the rigid manipulator under constant torques or under the torques of
/// the inverse dynamics along the path.
AnalysePath analyze_forward_dynamics;

/// Computes the elastic vibration about the nominal motion along the path. Records deflection and
/// path error of the platform point P, joint rotations, section forces, stresses, reactions,
/// torques compared with those of rigid links, and energies.
AnalysePath analyze_elastodynamics;

/// Evaluates a general regression neural network on samples of the inverse dynamics along the path.
/// Records the smoothing parameter, predictions, errors, skill and computing times.
AnalysePath analyze_grnn;
/// Evaluates a general regression neural network on samples stated in the case, and records its
/// predictions for the queries of the case.
AnalyseCase analyze_grnn_samples;

/// Reads the options of elastodynamics that do not depend on the model and its effects.
[[nodiscard]] solver::ElastodynamicsOptions read_model_independent_options(
    const JsonView& analysis);

/// Reads the options of an elastodynamics case: path, loads at P, damping, time steps and selected
/// physical effects.
/// @throws InputError  if the model has parts other than the manipulator and loads at P, or if it
///   has no trajectory of at least two points.
[[nodiscard]] solver::ElastodynamicsOptions read_elastodynamics_options(
    const JsonView& analysis, const CaseModel& case_model);

}  // namespace trammel::harness
