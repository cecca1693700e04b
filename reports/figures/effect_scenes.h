#pragma once

#include <vector>

#include "reports/data/results.h"
#include "reports/drawing/figure.h"

namespace trammel::reports {

/// What choosing effects automatically came to over many scenes: the change asked for against the
/// one obtained, and the time of deciding and running against that with all effects. None without
/// scenes.
[[nodiscard]] std::vector<Figure> effect_scene_figures(const std::vector<EffectScene>& scenes);

}  // namespace trammel::reports
