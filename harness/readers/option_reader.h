#pragma once

#include <optional>
#include <string>

#include "harness/input/json_view.h"
#include "solver/large/large_motion_model.h"
#include "solver/linalg/eigenpairs.h"
#include "solver/linear/row_balance.h"
#include "solver/manipulator/frequency_sensitivity.h"
#include "solver/model/model.h"
#include "solver/motion/equation_of_motion.h"
#include "solver/motion/harmonic.h"
#include "solver/motion/transient.h"

/// Readers of options that several analyses have in common.
namespace trammel::harness {

/// Reads a scheme of time integration: "newmark" (average acceleration), "linear-acceleration",
/// {"newmark": {"beta", "gamma"}}, {"hht": {"alpha"}}, {"generalized-alpha": {"spectral_radius"}}.
/// @throws InputError  if the numbers are not parameters of a valid scheme.
[[nodiscard]] solver::TimeScheme read_time_scheme(const JsonView& scheme);

/// Limits the number of time steps to ten million.
/// @param step  time step [s] in the case; error messages contain its JSON pointer
/// @throws InputError  if the duration contains more steps.
void limit_time_step_count(const JsonView& step, double duration);

/// Reads Rayleigh damping w1 M + w2 K: {"mass_per_s": w1, "stiffness_s": w2}; zero
/// damping if the key is absent.
[[nodiscard]] solver::RayleighDamping read_rayleigh(const std::optional<JsonView>& damping);

/// Reads the load factor over time, "load_history": {"time_s", "factor"}; constant 1 by default.
/// @throws InputError  if times decrease or the two lists differ in length.
[[nodiscard]] solver::LoadHistory read_load_history(const JsonView& analysis);

/// Reads "scheme" (newmark by default), "step_s" (0 if it is absent) and "error_control":
/// {"relative", "absolute", "finest_level"}.
[[nodiscard]] solver::TransientOptions read_time_options(const JsonView& analysis);

/// Reads the key "damping" of an analysis; no damping if it is absent.
/// @param modes  number of modes of the model, which replaces the text "all" in the case; empty if
///   the number is unknown.
/// @throws InputError  for "all" with an unknown number of modes, for more ratios than modes, or
///   for invalid numbers.
[[nodiscard]] solver::HarmonicDamping read_damping(
    const JsonView& analysis, std::optional<solver::Index> modes = std::nullopt);

[[nodiscard]] solver::EigenMethod read_eigen_method(const JsonView& analysis);

/// Reads a design parameter: {"property": "length", "links": ["A1-B1", ...], "platform": false}.
/// @throws InputError  if the selected links or platform do not have this property.
[[nodiscard]] solver::DesignParameter read_design_parameter(const JsonView& parameter);

/// Returns the name of the quantity for derivatives of natural frequencies with respect to a
/// parameter. The name contains the unit, as in "sensitivity_Hz_per_m".
[[nodiscard]] std::string frequency_sensitivity_name(solver::DesignParameter::Kind kind);

/// Add prescribed motions ("drives") to a model of large statics or large motion. For large motion,
/// `read_motion_conditions` adds damping, load history and initial velocities.
/// @throws InputError  if a name is unknown.
void read_prescribed_motions(const JsonView& analysis, const solver::Model& built,
                             solver::large_motion::LargeMotionModel& large_motion);
void read_motion_conditions(const JsonView& analysis, const solver::Model& built,
                            solver::large_motion::LargeMotionModel& large_motion);

/// Reads a law of motion: a function that returns position, velocity and acceleration at a time.
[[nodiscard]] solver::large_motion::TimeFunction read_motion_law(const JsonView& law);

/// Returns the index of the node with a name.
/// @throws InputError  if no node has this name.
[[nodiscard]] solver::Index find_node(const JsonView& name, const solver::Model& built);

}  // namespace trammel::harness
