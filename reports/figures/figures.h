#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reports/data/results.h"
#include "reports/drawing/figure.h"

namespace trammel::reports {

/// A title with the variant's behind it, unless it is the case as it stands.
[[nodiscard]] std::string titled(const std::string& what, const CaseInfo& info, const Run& run);

/// One maker for each kind of figure. Each returns nothing where there is nothing to draw.

/// The undeformed mechanism with its joints; the geometries of `further` runs (a title each) and
/// the drawing's own further poses are laid under it.
[[nodiscard]] std::optional<Figure> mechanism_figure(
    const CaseInfo& info, const Run& run,
    const std::vector<std::pair<std::string, const Drawing*>>& further);

/// Up to eight shapes of one run as small multiples: undeformed grey, deformed coloured.
[[nodiscard]] std::optional<Figure> shapes_figure(const CaseInfo& info, const Run& run);

/// What a case's "figures" entry asks for. @param problem  set to the reason where it cannot be
/// drawn (a quantity or variant that is not there, lengths that differ).
[[nodiscard]] std::optional<Figure> curves_figure(const CaseInfo& info, const PlotRequest& request,
                                                  const std::vector<const Run*>& runs,
                                                  std::string& problem);

/// The same for an entry with a "value": a quantity in classes of colour over positions, one
/// variant, with lines on it.
[[nodiscard]] std::optional<Figure> map_figure(const CaseInfo& info, const PlotRequest& request,
                                               const std::vector<const Run*>& runs,
                                               std::string& problem);

/// Log-log error over one sweep of one quantity, all its indices together.
[[nodiscard]] std::vector<Figure> convergence_figures(const CaseInfo& info, const Run& run);

/// Share of the tolerance that every check of a family uses which is expected to agree.
/// @param titles  of the cases, by id.
[[nodiscard]] std::optional<Figure> tolerance_figure(
    const std::string& family, const std::map<std::string, std::string>& titles,
    const std::vector<const Run*>& runs);

/// Differences that are known, with the band expected of each: one figure a check name.
[[nodiscard]] std::vector<Figure> discrepancy_figures(const CaseInfo& info, const Results& results,
                                                      const std::vector<const Run*>& runs);

}  // namespace trammel::reports
