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

/// Options that several analyses have in common.
namespace trammel::harness {

/// A word or an object with one key: "newmark" (average acceleration), "linear-acceleration",
/// {"newmark": {"beta", "gamma"}}, {"hht": {"alpha"}}, {"generalized-alpha": {"spectral_radius"}}.
/// @throws InputError  where the numbers make no scheme.
[[nodiscard]] solver::TimeScheme read_time_scheme(const JsonView& scheme);

/// @param step  a time
/// @throws InputError  where the duration has more than ten million of it.
void require_step_count(const JsonView& step, double duration);

/// {"mass_per_s": w1, "stiffness_s": w2}; none where it is absent.
[[nodiscard]] solver::RayleighDamping read_rayleigh(const std::optional<JsonView>& damping);

/// "load_history": {"time_s", "factor"}; 1 throughout where it is absent.
/// @throws InputError  for times that descend and numbers that are not as many.
[[nodiscard]] solver::LoadHistory read_load_history(const JsonView& analysis);

/// "scheme" (newmark by default), "step_s", "error_control": {"relative", "absolute",
/// "finest_level"}.
[[nodiscard]] solver::TransientOptions read_time_options(const JsonView& analysis);

/// Key "damping" of an analysis; none where it has none.
/// @param modes  how many "all" are, where they are known
/// @throws InputError  for "all" where they are not, more ratios than modes, or numbers without
///                     meaning.
[[nodiscard]] solver::HarmonicDamping read_damping(
    const JsonView& analysis, std::optional<solver::Index> modes = std::nullopt);

/// Key "eigensolver" of an analysis: automatic, dense or sparse.
[[nodiscard]] solver::EigenMethod read_eigen_method(const JsonView& analysis);

/// {"property": "length", "links": ["A1-B1", ...], "platform": false}
/// @throws InputError  where it names no number: the length or width of a platform alone.
[[nodiscard]] solver::DesignParameter read_design_parameter(const JsonView& parameter);

/// "sensitivity_Hz_per_m", by the parameter's unit.
[[nodiscard]] std::string sensitivity_name(solver::DesignParameter::Kind kind);

/// Adds the drives of a large-statics or large-motion analysis, and of the second its damping, its
/// history of the loads and its start.
/// @throws InputError  where a name leads nowhere.
void read_drives(const JsonView& analysis, const solver::Model& built,
                 solver::large_motion::LargeMotionModel& large_motion);
void read_history(const JsonView& analysis, const solver::Model& built,
                  solver::large_motion::LargeMotionModel& large_motion);

/// A motion over time: place, speed and acceleration.
[[nodiscard]] solver::large_motion::TimeFunction read_law(const JsonView& law);

/// The node of that name. @throws InputError  where there is none.
[[nodiscard]] solver::Index find_node(const JsonView& name, const solver::Model& built);

}  // namespace trammel::harness
