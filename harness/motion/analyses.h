#pragma once

#include "harness/scene/case_model.h"
#include "harness/statics_modes/step_result.h"
#include "solver/manipulator/elastodynamics.h"

/// Analyzes motion: kinematics, response in time and frequency, dynamics of the manipulator,
/// networks.
namespace trammel::harness {

/// Computes inverse kinematics, distances from singularities and the torques that balance the
/// loads.
AnalyseStep analyze_kinematics;

/// Computes the response in time: outputs at sample times, their peaks, energies.
AnalyseStep analyze_transient;

/// Computes amplitudes of the steady response over a range of frequencies, and their peaks.
AnalyseStep analyze_harmonic;
/// Computes geometrically exact motion in large displacement.
AnalysePath analyze_large_motion;

/// Computes torques, angles, powers and energies of the rigid manipulator along its path.
AnalysePath analyze_inverse_dynamics;

/// Integrates the motion of the rigid manipulator under constant torques or those of the path's
/// inverse dynamics.
AnalysePath analyze_forward_dynamics;

/// Computes the elastic vibration about the nominal motion along the path. Records deflection and
/// error of P, joint rotations, section forces, stresses, reactions, torques compared with those of
/// rigid links, and energies.
AnalysePath analyze_elastodynamics;

/// Evaluates a general regression neural network on samples of the inverse dynamics along the path.
/// Records smoothing, predictions, errors, skill and times.
AnalysePath analyze_grnn;
/// Evaluates the network on samples of the case, and records predictions at its queries.
AnalyseCase analyze_grnn_samples;

/// Reads the options that the analysis states, independent of the scene and its effects.
[[nodiscard]] solver::ElastodynamicsOptions read_motion_options(const JsonView& analysis);

/// Reads the motion of an elastodynamics case, with the scene's effects.
/// @throws InputError  if the scene has parts besides the manipulator or the trajectory has no
///     time.
[[nodiscard]] solver::ElastodynamicsOptions read_elastodynamics(const JsonView& analysis,
                                                                const CaseModel& case_model);

}  // namespace trammel::harness
