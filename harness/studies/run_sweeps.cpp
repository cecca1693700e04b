#include <cmath>
#include <limits>

#include "harness/analysis/analysis.h"
#include "harness/input/case.h"
#include "harness/studies/validation_uncertainty.h"

namespace trammel::harness {
namespace {

/// Requires that refinement levels are ordered from coarse to fine, with positive element sizes.
void require_ordered_levels(const JsonView& place, const std::vector<Level>& levels) {
  const std::string measures = place.get<std::string>("refinement_by", "elements");
  double before = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const double size = element_size(measures, levels[i].parameter);
    if (!(size > 0) || !(size < before) || !std::isfinite(size))
      throw place["values"][i].error("expected values from coarse to fine (got " +
                                     std::to_string(levels[i].parameter) + ")");
    before = size;
  }
}

}  // namespace

std::vector<Sweep> run_sweep_levels(const Document& document, const References& references) {
  std::vector<Sweep> sweeps;
  const auto places = JsonView(document).find("sweeps");
  if (!places) return sweeps;
  for (const auto& [name, place] : places->entries()) {
    Sweep sweep{name, {}};
    const std::vector<Level> found = sweep_levels(document, name);
    require_ordered_levels(place, found);
    for (const Level& level : found)
      sweep.levels.push_back(
          {level.parameter, analyze(level.document, references, {false}).quantities});
    sweeps.push_back(std::move(sweep));
  }
  return sweeps;
}

}  // namespace trammel::harness
