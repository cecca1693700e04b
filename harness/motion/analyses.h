#pragma once

#include "harness/scene/case_model.h"
#include "harness/statics_modes/step_result.h"
#include "solver/manipulator/elastodynamics.h"

/// Analyses of motion: kinematics, response in time and frequency, dynamics of the manipulator,
/// networks.
namespace trammel::harness {

/// Inverse kinematics, distances from singularities, torques that hold the loads.
AnalyseStep analyse_kinematics;

/// Response in time: outputs at sample times, their peaks, energies.
AnalyseStep analyse_transient;

/// Amplitudes of the steady response over a range of frequencies, and their peaks.
AnalyseStep analyse_harmonic;
/// Motion in large displacement: geometrically exact.
AnalysePath analyse_large_motion;

/// Torques, angles, powers and energies of the rigid manipulator along its path.
AnalysePath analyse_inverse_dynamics;

/// From torques back to the motion: those of the inverse dynamics of the path, or constant ones.
AnalysePath analyse_forward_dynamics;

/// Elastic vibration about the nominal motion along the path: deflection and error of P, joint
/// rotations, section forces, stresses, reactions, torques compared with those of rigid links,
/// energies.
AnalysePath analyse_elastodynamics;

/// A general regression neural network on the samples of the inverse dynamics along the path:
/// smoothing, predictions, errors, skill, times.
AnalysePath analyse_grnn;
/// The same on samples of the case: predictions at its queries.
AnalyseCase analyse_grnn_samples;

/// The options that the analysis itself states, whatever the scene and its effects.
[[nodiscard]] solver::ElastodynamicsOptions read_motion_options(const JsonView& analysis);

/// The motion that a case of elastodynamics describes, with the scene's effects.
/// @throws InputError  where something stands beside the manipulator or the trajectory has no time.
[[nodiscard]] solver::ElastodynamicsOptions read_elastodynamics(const JsonView& analysis,
                                                                const CaseModel& case_model);

}  // namespace trammel::harness
