#pragma once

#include "harness/statics_modes/step_result.h"
#include "solver/linear/rotating_frame.h"

namespace trammel::harness {

/// Modes in a steadily rotating frame, key "rotating" of the modes: at one speed, or one number a
/// speed. Not solved: the first speed without a steady state.
/// @param effects  of which Coriolis forces and stiffening by tension are decided here
[[nodiscard]] StepResult analyse_rotating(const JsonView& modes, const solver::System& system,
                                          solver::Effects effects, bool draw, Recorder& record);

/// Frequencies and growth rates of modes about a state; of several states with the mode.
/// @param roundoff  relative, of each frequency; empty where it is not known
void record_frequencies(const Eigen::VectorXd& frequency, const Eigen::VectorXd& growth_rate,
                        bool several, Recorder& record, const Eigen::VectorXd& roundoff = {});

/// All that the case says but for the effects and the speed.
[[nodiscard]] solver::RotatingOptions read_rotating_options(const JsonView& modes);
[[nodiscard]] std::vector<double> read_speeds(const JsonView& modes);

}  // namespace trammel::harness
