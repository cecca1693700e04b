#include <algorithm>

#include "reports/sections/sections.h"
#include "reports/text/html.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

bool chose_effects(const Run* run) {
  return std::ranges::any_of(
      run->effects, [](const EffectRow& effect) { return effect.cumulative_change.has_value(); });
}

std::string title_of(const Run& run) {
  std::string on;
  std::size_t off = 0;
  for (const EffectRow& effect : run.effects) {
    if (effect.active) add_item(on, spaced(effect.name));
    if (effect.applicable && !effect.active) ++off;
  }
  return "Computed with " + (on.empty() ? "bending alone" : on) + "; " +
         count(off, "other effect was left out", "other effects were left out");
}

Data row_of(const EffectRow& effect) {
  return object({{"effect", spaced(effect.name)},
                 {"state", effect.active ? "on" : "off"},
                 {"dimensionless_number",
                  effect.dimensionless_number ? trimmed(*effect.dimensionless_number, 3) : ""},
                 {"number_definition", effect.number_definition},
                 {"own_change", effect.own_change ? relative(*effect.own_change, 3, false) : ""},
                 {"cumulative_change",
                  effect.cumulative_change ? relative(*effect.cumulative_change, 3, false) : ""},
                 {"why", effect.why}});
}

}  // namespace

void set_effects(Data& data, const std::vector<const Run*>& runs) {
  const auto found = std::ranges::find_if(runs, chose_effects);
  Data rows = list();
  if (found != runs.end())
    for (const EffectRow& effect : (*found)->effects)
      if (effect.applicable) rows.push_back(row_of(effect));
  set(data, {{"effects_title", found == runs.end() ? "" : title_of(**found)}, {"effects", rows}});
}

}  // namespace trammel::reports
