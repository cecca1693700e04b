#pragma once

#include <optional>
#include <string>

#include "harness/input/document.h"
#include "solver/model/model.h"

/// Discretization of a case: elements of its members and plates, steps in time.
namespace trammel::harness {

/// Returns the analysis with a mesh and steps; for a study, the inner analysis.
[[nodiscard]] std::string discretized_analysis(const Document& document);
/// Returns the pointer of that analysis: "/analysis/modes", "/analysis/study/analysis/modes".
[[nodiscard]] std::string analysis_pointer(const Document& document);

/// Returns the number of elements of links that specify none: that of "model" if present; else 1 in
/// linear statics, where nodal values are exact, and in large statics; else 4.
[[nodiscard]] solver::Index default_elements(const Document& document);
/// Returns the number of elements of a member, in this order of precedence:
/// - the number stated by the member, or by "model".
/// - 1 for a bar, which does not bend.
/// - 8 for a tapered member.
/// - one element for each 7.5 degrees of an arc, and at least 4.
/// - the default of links.
[[nodiscard]] solver::Index elements_of(const Document& document, const std::string& member);

enum class Refine { coarser, finer };

/// Return merge patches of the case for a finer or coarser discretization:
/// - mesh: twice or half the elements of every member, plate and platform
/// - step: half or twice the step, or a tenth or ten times the tolerance of the steps
///
/// The result is empty without a mesh or step, or if a number to be halved is odd.
[[nodiscard]] std::optional<Json> mesh_patch(const Document& document, Refine refine);
[[nodiscard]] std::optional<Json> step_patch(const Document& document, Refine refine);

/// Return the pointer of the setting that determines the mesh or the step, for messages.
[[nodiscard]] std::string mesh_pointer(const Document& document);
[[nodiscard]] std::string step_pointer(const Document& document);
/// The number of recorded times of a transient response, or of frequencies of a harmonic one.
struct Sampling {
  std::string pointer;
  solver::Index intervals = 0;
};
[[nodiscard]] std::optional<Sampling> sampling_of(const Document& document);
/// Patch that records at `intervals` equal intervals.
[[nodiscard]] Json sampling_patch(const Document& document, solver::Index intervals);
/// Returns whether a tolerance controls the steps.
[[nodiscard]] bool has_step_tolerance(const Document& document);

}  // namespace trammel::harness
