#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reports/data/results.h"
#include "reports/drawing/figure.h"

/// Functions that plan figures. The figures are numbered and drawn later.
namespace trammel::reports {

/// Printed values of the references that a run is compared with, and the computed values with their
/// uncertainty. Empty if the run compares fewer than three entries.
[[nodiscard]] std::optional<Figure> agreement_figure(const CaseInfo& info, const Results& results,
                                                     const Run& run);

/// Errors along each sweep on logarithmic axes, one figure for each quantity with all its indices.
[[nodiscard]] std::vector<Figure> convergence_figures(const CaseInfo& info, const Run& run);

/// Processor time against error on logarithmic axes with the Pareto front. Settings without a
/// result are in a strip at the right edge.
[[nodiscard]] Figure cost_figure(const CostStudy& study);

/// @returns nullptr if there is no run of the variant.
[[nodiscard]] const Run* find_run(const std::vector<const Run*>& runs, const std::string& variant);

/// Curves that a case requests. @param problem  set to the reason if the figure cannot be drawn
[[nodiscard]] std::optional<Figure> curves_figure(const CaseInfo& info, const PlotRequest& request,
                                                  const std::vector<const Run*>& runs,
                                                  std::string& problem);

/// Automatic selection of effects: obtained change against the tolerance, one point for each scene.
[[nodiscard]] std::vector<Figure> effect_scene_figures(const std::vector<EffectScene>& scenes);

/// Processor time and counted work of calls, relative to the first. Calls with failures are marked.
[[nodiscard]] Figure history_figure(const History& history);

/// Map that a case requests: classes of a quantity over positions, with lines, for one variant.
[[nodiscard]] std::optional<Figure> map_figure(const CaseInfo& info, const PlotRequest& request,
                                               const std::vector<const Run*>& runs,
                                               std::string& problem);

/// Undeformed mechanism with its joints, drawn over its further poses.
[[nodiscard]] std::optional<Figure> mechanism_figure(const CaseInfo& info, const Run& run);

/// Instants of a motion with magnified deflections. The script of a page animates them. Empty if
/// there are fewer than two instants.
[[nodiscard]] std::optional<Figure> motion_figure(const CaseInfo& info, const Run& run);

/// Up to eight mode shapes or deformed shapes of a run, one panel each.
[[nodiscard]] std::optional<Figure> shapes_figure(const CaseInfo& info, const Run& run);

/// Difference of each check of a family from its reference, divided by the tolerance. Known
/// discrepancies are left out.
/// @param titles  of the cases, by id
[[nodiscard]] std::optional<Figure> tolerance_figure(
    const std::string& family, const std::map<std::string, std::string>& titles,
    const std::vector<const Run*>& runs);

}  // namespace trammel::reports
