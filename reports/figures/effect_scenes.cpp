#include <algorithm>
#include <map>

#include "reports/drawing/interval.h"
#include "reports/drawing/palette.h"
#include "reports/drawing/plot_script.h"
#include "reports/figures/figures.h"
#include "reports/text/number.h"

namespace trammel::reports {
namespace {

constexpr double kSmallestDrawnChange = 1e-9;  ///< stands for less

constexpr double kSceneMargin = 1.3;  ///< no point stands on the frame

struct Scatter {
  std::string x_label, y_label;
  Interval x, y;          ///< of the axes
  PlotScript::Rows line;  ///< the limit, drawn through
  std::string line_title;
  std::map<std::string, PlotScript::Rows> points;  ///< by analysis
};

/// @returns the height of the key
int draw_scatter(PlotScript& script, const Scatter& scatter) {
  script.log_axis("x", scatter.x.low, scatter.x.high);
  script.log_axis("y", scatter.y.low, scatter.y.high);
  script.axis_label("x", scatter.x_label);
  script.axis_label("y", scatter.y_label);
  script.curve(scatter.line, "using 1:2 with lines lw 1.5 dt 2" + lc(palette::kMuted),
               scatter.line_title);
  std::vector<std::string> keys = {scatter.line_title};
  for (const auto& [analysis, rows] : scatter.points) {
    const std::size_t number = keys.size() - 1;
    script.curve(rows,
                 "using 1:2 with points ps 0.7 pt " + palette::filled_point(number) +
                     lc(palette::color(number)),
                 analysis);
    keys.push_back(analysis);
  }
  const int key_height = script.key_below(keys);
  script.plot();
  return key_height;
}

Table table_of(const std::vector<EffectScene>& scenes) {
  Table table;
  table.heads = words_in("scene analysis tolerance change minimal whole_s chosen_s deciding_s");
  for (const EffectScene& s : scenes)
    table.rows.push_back({s.scene, s.analysis, s.tolerance, s.change,
                          std::string(s.minimal ? "yes" : "no"), s.whole_s, s.chosen_s,
                          s.deciding_s});
  return table;
}

/// Time of deciding and running over that with all effects, all scenes together.
double time_share(const std::vector<EffectScene>& scenes) {
  double whole = 0, spent = 0;
  for (const EffectScene& scene : scenes) {
    whole += scene.whole_s;
    spent += scene.deciding_s + scene.chosen_s;
  }
  return whole > 0 ? spent / whole : 0;
}

}  // namespace

std::vector<Figure> effect_scene_figures(const std::vector<EffectScene>& scenes) {
  if (scenes.empty()) return {};
  Scatter scatter{
      "change asked for at most", "change obtained", {1, 0}, {1, 0}, {}, "asked for", {}};
  std::size_t within = 0, minimal = 0;
  for (const EffectScene& scene : scenes) {
    const double change = std::max(scene.change, kSmallestDrawnChange);
    scatter.points[scene.analysis].push_back({scene.tolerance, change});
    scatter.x.cover_around(scene.tolerance, kSceneMargin);
    scatter.y.cover_around(change, kSceneMargin);
    scatter.y.high = std::max(scatter.y.high, scene.tolerance * kSceneMargin);
    within += scene.change <= scene.tolerance ? 1 : 0;
    minimal += scene.minimal ? 1 : 0;
  }
  scatter.line = {{scatter.x.low, scatter.x.low}, {scatter.x.high, scatter.x.high}};
  PlotScript script;
  const int key_height = draw_scatter(script, scatter);
  const std::string caption =
      std::to_string(within) + " of " + count(scenes.size(), "scene") +
      " keep within what was asked for (below the line); in " + std::to_string(minimal) +
      " no chosen effect could be left out. Deciding and running took " +
      trimmed(time_share(scenes), 3) + " times as long as running with all effects.";
  return {{.id = "effects-obtained",
           .title = "Effects chosen automatically: change asked for and obtained",
           .caption = caption,
           .alt = "Each scene is a point: the largest change that leaving effects out makes, over "
                  "the change that was allowed. " +
                  caption,
           .height = 350 + key_height,
           .commands = script.commands(),
           .data = table_of(scenes),
           .is_linked = true}};
}

}  // namespace trammel::reports
