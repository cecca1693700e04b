#include <algorithm>
#include <map>

#include "reports/drawing/interval.h"
#include "reports/drawing/palette.h"
#include "reports/drawing/plot_script.h"
#include "reports/figures/figures.h"
#include "reports/text/number.h"

namespace trammel::reports {
namespace {

constexpr double kSmallestDrawnChange = 1e-9;  ///< smaller changes are drawn here
constexpr double kSceneMargin = 1.3;           ///< factor between the points and the frame

Table table_of(const std::vector<EffectScene>& scenes) {
  Table table;
  table.heads = words_in("scene analysis tolerance change minimal whole_s chosen_s deciding_s");
  for (const EffectScene& s : scenes)
    table.rows.push_back({s.scene, s.analysis, s.tolerance, s.change,
                          std::string(s.minimal ? "yes" : "no"), s.whole_s, s.chosen_s,
                          s.deciding_s});
  return table;
}

/// Returns the numbers of scenes within their tolerance and with a minimal selection, and the time
/// of selecting effects and running over that of running with all effects.
std::string conclusion(const std::vector<EffectScene>& scenes) {
  std::size_t within = 0, minimal = 0;
  double all_effects_s = 0, selected_s = 0;
  for (const EffectScene& scene : scenes) {
    if (scene.change <= scene.tolerance) ++within;
    if (scene.minimal) ++minimal;
    all_effects_s += scene.whole_s;
    selected_s += scene.deciding_s + scene.chosen_s;
  }
  return std::to_string(within) + " of " + count(scenes.size(), "scene") +
         " stay within the tolerance (below the line). In " + std::to_string(minimal) +
         ", no selected effect could be left out. Selecting and running took " +
         trimmed(all_effects_s > 0 ? selected_s / all_effects_s : 0, 3) +
         " times as long as running with all effects.";
}

}  // namespace

std::vector<Figure> effect_scene_figures(const std::vector<EffectScene>& scenes) {
  if (scenes.empty()) return {};
  Interval x{1, 0}, y{1, 0};
  std::map<std::string, PlotScript::Rows> points;
  for (const EffectScene& scene : scenes) {
    const double change = std::max(scene.change, kSmallestDrawnChange);
    points[scene.analysis].push_back({scene.tolerance, change});
    x.cover_around(scene.tolerance, kSceneMargin);
    y.cover_around(change, kSceneMargin);
    y.high = std::max(y.high, scene.tolerance * kSceneMargin);
  }
  PlotScript script;
  script.log_axis("x", x.low, x.high);
  script.log_axis("y", y.low, y.high);
  script.axis_label("x", "tolerance: requested largest change");
  script.axis_label("y", "obtained change");
  std::vector<std::string> keys = {"tolerance"};
  script.curve({{x.low, x.low}, {x.high, x.high}},
               "using 1:2 with lines lw 1.5 dt 2" + lc(palette::kMuted), keys.front());
  for (const auto& [analysis, rows] : points) {
    const std::size_t number = keys.size() - 1;
    script.curve(rows,
                 "using 1:2 with points ps 0.7 pt " + palette::filled_point(number) +
                     lc(palette::color(number)),
                 analysis);
    keys.push_back(analysis);
  }
  const int key_height = script.key_below(keys);
  script.plot();
  const std::string plotted =
      "Change of the results without the omitted effects against the tolerance, one point per "
      "scene. ";
  return {{.id = "effects-obtained",
           .title = "Automatic selection of effects: obtained change against tolerance",
           .caption = plotted + conclusion(scenes),
           .alt = plotted + conclusion(scenes),
           .height = 350 + key_height,
           .commands = script.commands(),
           .data = table_of(scenes),
           .is_linked = true}};
}

}  // namespace trammel::reports
