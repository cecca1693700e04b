#pragma once

#include <optional>
#include <string>

#include "harness/input/document.h"
#include "solver/model/model.h"

/// Discretization of a case: numbers of elements of members and plates, and time steps.
namespace trammel::harness {

/// Returns the kind of a case's analysis, such as "modes". For a parameter study, returns the kind
/// of the analysis that the study repeats.
[[nodiscard]] std::string inner_analysis_kind(const Document& document);
/// Returns the JSON pointer of the analysis that `inner_analysis_kind` names, such as
/// "/analysis/modes" or, for a study, "/analysis/study/analysis/modes".
[[nodiscard]] std::string analysis_pointer(const Document& document);

/// Returns the default number of elements of a link or member: the key "elements" of "model" if
/// present. Without this key, the number is 1 in linear statics (where nodal values are exact) and
/// in statics with large displacement. In other analyses, it is 4.
[[nodiscard]] solver::Index default_element_count(const Document& document);
/// Returns the number of elements of a member, in this order of precedence:
/// - the number stated by the member, or by "model".
/// - 1 for a bar, which does not bend.
/// - 8 for a tapered member.
/// - one element for each 7.5 degrees of an arc, and at least 4.
/// - the number returned by `default_element_count`.
[[nodiscard]] solver::Index element_count_of(const Document& document, const std::string& member);

enum class Refine { coarser, finer };

/// Return merge patches of the case for a finer or coarser discretization:
/// - mesh: twice or half the elements of every member, plate and platform
/// - step: half or twice the time step. With automatic step control: a tenth or ten times the
///   tolerance of the control. With "error_control", the largest step "step_s" is halved or doubled
///   as well. `largest_step` is used if the case has no "step_s". A finer step of large
///   motion also halves the interval "output_step_s" between recorded times.
///
/// The result is empty if the case has no mesh or time step, and if an odd number of elements would
/// be halved.
[[nodiscard]] std::optional<Json> mesh_patch(const Document& document, Refine refine);
[[nodiscard]] std::optional<Json> time_step_patch(const Document& document, Refine refine,
                                                  double largest_step = 0);

/// Return the JSON pointer of the key that determines the mesh or the time step, for messages.
[[nodiscard]] std::string mesh_pointer(const Document& document);
[[nodiscard]] std::string time_step_pointer(const Document& document);
/// Returns true if results at a given time do not depend on the time step: in modal superposition,
/// and in elastodynamics without elastic inertia (quasi-static equilibria).
[[nodiscard]] bool has_exact_steps(const Document& document);
/// Returns true if the time steps are controlled by an error tolerance.
[[nodiscard]] bool has_step_tolerance(const Document& document);

}  // namespace trammel::harness
