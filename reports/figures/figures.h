#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reports/data/results.h"
#include "reports/drawing/figure.h"

/// The makers of figures: one for each kind, neither numbered nor drawn.
namespace trammel::reports {

/// Printed values of the references that a run is compared with, next to the computed ones with
/// their uncertainty. Nothing where a run compares fewer than three entries.
[[nodiscard]] std::optional<Figure> agreement_figure(const CaseInfo& info, const Results& results,
                                                     const Run& run);

/// Log-log error over one sweep of one quantity, all its indices together.
[[nodiscard]] std::vector<Figure> convergence_figures(const CaseInfo& info, const Run& run);

/// Time over error on logarithmic axes with the efficient front; what failed in a strip at the
/// edge.
[[nodiscard]] Figure cost_figure(const CostStudy& study);

/// @returns nullptr where no run is of this variant.
[[nodiscard]] const Run* find_run(const std::vector<const Run*>& runs, const std::string& variant);

/// What a case's "figures" entry asks for. @param problem  set to the reason where it cannot be
/// drawn (a quantity or variant that is not there, lengths that differ).
[[nodiscard]] std::optional<Figure> curves_figure(const CaseInfo& info, const PlotRequest& request,
                                                  const std::vector<const Run*>& runs,
                                                  std::string& problem);

/// What choosing effects automatically came to over many scenes: the change asked for against the
/// one obtained, and the time of deciding and running against that with all effects. None without
/// scenes.
[[nodiscard]] std::vector<Figure> effect_scene_figures(const std::vector<EffectScene>& scenes);

/// Processor time and counted work over the calls, relative to the first that has them; calls with
/// failures are marked.
[[nodiscard]] Figure history_figure(const History& history);

/// What an entry of a case's "figures" with a "value" asks for: a quantity in classes of colour
/// over positions, one variant, with lines on it.
[[nodiscard]] std::optional<Figure> map_figure(const CaseInfo& info, const PlotRequest& request,
                                               const std::vector<const Run*>& runs,
                                               std::string& problem);

/// The undeformed mechanism with its joints; the further poses of the drawing are laid under it.
[[nodiscard]] std::optional<Figure> mechanism_figure(const CaseInfo& info, const Run& run);

/// A motion of one run: a few moments laid over each other, deflections magnified; a page's script
/// lets it move. Nothing where fewer than two moments are known.
[[nodiscard]] std::optional<Figure> motion_figure(const CaseInfo& info, const Run& run);

/// Up to eight shapes of one run as small multiples: undeformed grey, deformed coloured.
[[nodiscard]] std::optional<Figure> shapes_figure(const CaseInfo& info, const Run& run);

/// Share of the tolerance that every check of a family uses which is expected to agree.
/// @param titles  of the cases, by id.
[[nodiscard]] std::optional<Figure> tolerance_figure(
    const std::string& family, const std::map<std::string, std::string>& titles,
    const std::vector<const Run*>& runs);

}  // namespace trammel::reports
