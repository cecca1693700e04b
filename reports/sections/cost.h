#pragma once

#include <vector>

#include "reports/data/results.h"
#include "reports/drawing/figure.h"
#include "reports/figures/gallery.h"
#include "reports/text/html.h"

namespace trammel::reports {

/// A study of accuracy and computing time with its figure.
struct CostPanel {
  const CostStudy* study = nullptr;
  Figure figure;
};

struct CostPanels {
  std::vector<CostPanel> studies;
  std::vector<Figure> effects;  ///< of the automatic choice of effects

  [[nodiscard]] std::vector<Figure*> figures();
  [[nodiscard]] bool empty() const { return studies.empty() && effects.empty(); }
};

/// A panel for each study, its figures neither numbered nor drawn.
[[nodiscard]] CostPanels plan_cost(const Results& results);

/// Accuracy and computing time, study by study, and the computing time of the runs.
[[nodiscard]] Data cost_section(const Results& results, const std::vector<Family>& families,
                                const CostPanels& panels);

}  // namespace trammel::reports
