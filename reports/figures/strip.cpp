#include "reports/drawing/palette.h"
#include "reports/figures/outline.h"
#include "reports/text/number.h"

namespace trammel::reports {

int strip_height(std::size_t rows) {
  return 85 + 40 * static_cast<int>(rows);
}

double strip_y(std::size_t row) {
  return -static_cast<double>(row) - 0.72;
}

void strip_rows(PlotScript& script, const std::vector<std::string>& labels) {
  script.command("unset ytics; set border 1; set lmargin 2; set rmargin 3");
  script.command("unset grid; set grid xtics" + lc(palette::kGrid) + " lw 1 lt 1");
  script.range("y", -static_cast<double>(labels.size()), 0);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    script.label(shortened(labels[i], 58),
                 "graph 0.006, first " + shortest(-static_cast<double>(i) - 0.3) +
                     " left front font ',13.5' textcolor rgb '" + palette::kInk + "'");
    if (i > 0)
      script.command("set arrow from graph 0, first " + shortest(-static_cast<double>(i)) +
                     " to graph 1, first " + shortest(-static_cast<double>(i)) +
                     " nohead back lw 1" + lc(palette::kGrid));
  }
}

}  // namespace trammel::reports
