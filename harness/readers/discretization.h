#pragma once

#include <optional>
#include <string>

#include "harness/input/document.h"
#include "solver/model/model.h"

/// How finely a case is discretized: elements of its members and plates, steps in time.
namespace trammel::harness {

/// The analysis that has a mesh and steps: of a study the inner one.
[[nodiscard]] std::string discretized_analysis(const Document& document);
/// Its place: "/analysis/modes", "/analysis/study/analysis/modes".
[[nodiscard]] std::string analysis_pointer(const Document& document);

/// Elements of the links of a manipulator that state none: those of "model", else 1 in linear
/// statics, where nodal values are exact, and in large statics, and 4 otherwise.
[[nodiscard]] solver::Index default_elements(const Document& document);
/// Elements of a member: those that it states, those of "model", else 1 of a bar, which does not
/// bend, 8 of a tapered member, one for each 7.5 degrees of an arc and at least 4, else as links.
[[nodiscard]] solver::Index elements_of(const Document& document, const std::string& member);

enum class Refine { coarser, finer };

/// Merge patches of the case, in which every member, plate and platform has half or twice the
/// elements, or the step is twice or half as long, or the tolerance of the steps is ten times
/// larger or smaller. Nothing where there is no mesh, no step, or where a count is odd.
[[nodiscard]] std::optional<Json> mesh_patch(const Document& document, Refine refine);
[[nodiscard]] std::optional<Json> step_patch(const Document& document, Refine refine);

/// The pointer of the setting that decides the mesh or the step, for messages.
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
/// Whether steps are controlled by a tolerance.
[[nodiscard]] bool has_step_tolerance(const Document& document);

}  // namespace trammel::harness
