#pragma once

#include <string>
#include <vector>

#include "reports/drawing/plot_script.h"

namespace trammel::reports {

/// Rows one under another, each with its label above its own line: long names need no margin, and
/// a phone can show them. Row 0 is the uppermost.

/// Height of the drawing for so many rows.
[[nodiscard]] int strip_height(std::size_t rows);

/// Sets the y axis and writes the labels.
void strip_rows(PlotScript& script, const std::vector<std::string>& labels);

/// Where the marks of a row stand.
[[nodiscard]] double strip_y(std::size_t row);

}  // namespace trammel::reports
