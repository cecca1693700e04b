#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reports/data/results.h"
#include "reports/drawing/figure.h"

/// Functions that prepare the gnuplot commands and data of figures. The function `draw` draws the
/// figures later.
namespace trammel::reports {

/// Figure of published values and of the computed values of a run with their uncertainty. Empty if
/// fewer than three values are compared.
[[nodiscard]] std::optional<Figure> agreement_figure(const CaseInfo& info, const Results& results,
                                                     const Run& run);

/// Figures of the refinement studies (sweeps) of a run, one for each study and quantity. They show
/// the errors of the quantity against the refined parameter, on a logarithmic error axis.
[[nodiscard]] std::vector<Figure> convergence_figures(const CaseInfo& info, const Run& run);

/// Figure of fitted against theoretical orders of convergence.
[[nodiscard]] std::optional<Figure> order_figure(const std::vector<const Run*>& runs);

/// Figure of processor time against error on logarithmic axes, with the Pareto front. The caption
/// states the number of settings without a result.
[[nodiscard]] Figure cost_figure(const CostStudy& study);

/// Returns the run of a variant, or nullptr if there is no such run.
[[nodiscard]] const Run* find_run(const std::vector<const Run*>& runs, const std::string& variant);

/// Figure of curves that a case requests. @param problem  set to the reason if the figure cannot be
/// drawn
[[nodiscard]] std::optional<Figure> curves_figure(const CaseInfo& info, const PlotRequest& request,
                                                  const std::vector<const Run*>& runs,
                                                  std::string& problem);

/// Bar chart with a bar for each measured mechanical effect: the change of a run's results if the
/// effect is omitted. Empty if no effect was measured.
[[nodiscard]] std::optional<Figure> effects_figure(const CaseInfo& info, const Results& results,
                                                   const Run& run);

/// Figures of the automatic selection of effects. A point for each scene (case with candidate
/// effects) shows the change of the results due to the omitted effects, against the tolerance for
/// this change.
[[nodiscard]] std::vector<Figure> effect_scene_figures(const std::vector<EffectScene>& scenes);

/// Figure of estimated ("stated") against true discretization errors, which
/// tests/harness/studies/error_coverage_test.cpp measured.
[[nodiscard]] Figure error_coverage_figure();

/// Figure of processor time and counted work of the calls in a history file, relative to the first
/// call. Calls with failed checks are marked.
[[nodiscard]] Figure call_history_figure(const History& history);

/// Colored map of a quantity over positions for one variant, as requested by a case. The curves of
/// `request.lines` are drawn on the map.
[[nodiscard]] std::optional<Figure> map_figure(const CaseInfo& info, const PlotRequest& request,
                                               const std::vector<const Run*>& runs,
                                               std::string& problem);

/// Figure of the undeformed mechanism with its joints in the first pose. If the case has several
/// poses, the other poses are drawn behind the first.
[[nodiscard]] std::optional<Figure> mechanism_figure(const CaseInfo& info, const Run& run);

/// Figure of instants of a motion with magnified deflections, which the script page.js animates.
/// Empty if there are fewer than two instants.
[[nodiscard]] std::optional<Figure> motion_figure(const CaseInfo& info, const Run& run);

/// Figure of up to eight mode shapes or deformed shapes of a run, one panel each.
[[nodiscard]] std::optional<Figure> shapes_figure(const CaseInfo& info, const Run& run);

/// Figure of the differences of all checks of a family, divided by their tolerances. Known
/// discrepancies and statuses are omitted.
/// @param titles        titles of the cases, by case id
/// @param largest_only  true: one point for each case (its largest difference), without labels
[[nodiscard]] std::optional<Figure> tolerance_figure(
    const std::string& family, const std::map<std::string, std::string>& titles,
    const std::vector<const Run*>& runs, bool largest_only = false);

}  // namespace trammel::reports
