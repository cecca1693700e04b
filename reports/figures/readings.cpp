#include "reports/figures/readings.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "harness/base/find_or_add.h"
#include "reports/drawing/palette.h"
#include "reports/drawing/plot_script.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

constexpr std::size_t kMaxReadings = 5, kMaxTitle = 36;
constexpr double kMinProbability = 1e-3;  ///< of a reading that is drawn
constexpr double kMinBits = 0.01;         ///< of information that is worth a sentence

/// The row under each discrepancy, in their order.
using SameRow = std::vector<const RowProbabilities*>;

std::vector<SameRow> same_rows(const ModelProbabilities& probabilities) {
  std::vector<SameRow> out;
  for (const RowProbabilities& row : probabilities.rows) {
    const auto same = [&](const SameRow& known) { return known.front()->row == row.row; };
    harness::find_or_add(out, same, SameRow{}).push_back(&row);
  }
  return out;
}

/// Predicted over printed, less 1 [%]; an empty row where either is missing.
PlotScript::Rows differences(const RowProbabilities& row, const Numbers& values) {
  PlotScript::Rows out;
  for (std::size_t k = 0; k < std::min(row.printed.size(), values.size()); ++k) {
    if (!row.printed[k] || !values[k] || *row.printed[k] == 0) {
      out.emplace_back();
    } else {
      out.push_back({static_cast<double>(k + 1), 100 * (*values[k] / *row.printed[k] - 1)});
    }
  }
  return out;
}

double largest(const PlotScript::Rows& points) {
  double size = 0;
  for (const std::vector<double>& point : points)
    if (!point.empty()) size = std::max(size, std::abs(point[1]));
  return size;
}

std::string caption_of(const RowProbabilities& row, double worst) {
  const ReadingClass& first = row.leading.front();
  const double discrepancy = row.discrepancy.value_or(0);
  std::string text = "Under a discrepancy of " + relative(discrepancy, 2, false) +
                     " the most probable reading is " + first.title + ", with " +
                     relative(first.probability.value_or(0), 3, false) + "; it is off by up to " +
                     trimmed(worst, 2) + "\u202f%, ";
  text += worst > 300 * discrepancy ? "more than three times that: no reading explains the row."
                                    : "as such a discrepancy allows.";
  if (row.further_numbers.empty() ||
      row.further_numbers.front().expected_information_bits.value_or(0) < kMinBits)
    return text;
  return text + " Of further numbers, " + row.further_numbers.front().name +
         " would tell most between the readings: " +
         trimmed(row.further_numbers.front().expected_information_bits.value_or(0), 2) + " of " +
         trimmed(row.entropy_bits.value_or(0), 3) + " bits.";
}

Figure figure_of(const CaseInfo& info, const RowProbabilities& row) {
  PlotScript script;
  Table table;
  std::size_t shown = 1;
  while (shown < std::min(row.leading.size(), kMaxReadings) &&
         row.leading[shown].probability.value_or(0) >= kMinProbability)
    ++shown;
  const double band = 100 * row.discrepancy.value_or(0);
  const auto count_of = static_cast<double>(row.printed.size());
  std::vector<std::string> titles;
  double worst = 0, extent = 2 * band;
  table.heads = {"reading", "probability", "number", "printed_" + row.unit,
                 "predicted_" + row.unit};
  script.curve({{0.5, -band}, {count_of + 0.5, -band}, {count_of + 0.5, band}, {0.5, band}},
               "with filledcurves closed" + lc(palette::kAmber), "discrepancy");
  script.curve({{0.5, 0}, {count_of + 0.5, 0}}, "with lines lw 1.5" + lc(palette::kInk));
  titles.emplace_back("discrepancy");
  for (std::size_t i = 0; i < shown; ++i) {
    const ReadingClass& reading = row.leading[i];
    const PlotScript::Rows points = differences(row, reading.values);
    if (i == 0) worst = largest(points);
    extent = std::max(extent, largest(points));
    titles.push_back(shortened(reading.title, kMaxTitle) + " (" +
                     relative(reading.probability.value_or(0), 2, false) + ")");
    script.curve(
        points,
        "with linespoints lw 1.4 ps 1 pt " + palette::filled_point(i) + lc(palette::color(i)),
        titles.back());
    for (std::size_t k = 0; k < std::min(row.printed.size(), reading.values.size()); ++k)
      table.rows.push_back({reading.title, cell(reading.probability), static_cast<double>(k + 1),
                            cell(row.printed[k]), cell(reading.values[k])});
  }
  script.range("x", 0.5, count_of + 0.5);
  script.range("y", -1.1 * extent, 1.1 * extent);
  script.command("set xtics 1,1");
  script.axis_label("x", "number in the row");
  script.axis_label("y", "predicted over printed, less 1 (%)");
  const int key = script.key_below(titles);
  script.plot();
  const std::string caption = caption_of(row, worst);
  return {.id = slug(info.id + "-" + row.row + "-readings"),
          .title = "Most probable readings beside the printed row " + row.row,
          .caption = caption,
          .alt = "Relative differences of the most probable readings from the printed numbers. " +
                 caption,
          .height = 320 + key,
          .commands = script.commands(),
          .data = std::move(table)};
}

}  // namespace

std::vector<Figure> reading_figures(const CaseInfo& info, const std::vector<const Run*>& runs) {
  std::vector<Figure> figures;
  const auto run = std::ranges::find_if(
      runs, [](const Run* candidate) { return candidate->model_probabilities.has_value(); });
  if (run == runs.end()) return figures;
  for (const SameRow& row : same_rows(*(*run)->model_probabilities)) {
    const RowProbabilities& middle = *row[row.size() / 2];
    if (!middle.leading.empty()) figures.push_back(figure_of(info, middle));
  }
  return figures;
}

}  // namespace trammel::reports
