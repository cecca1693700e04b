#include <algorithm>
#include <cmath>

#include "reports/drawing/palette.h"
#include "reports/figures/figures.h"
#include "reports/figures/outline.h"
#include "reports/text/number.h"
#include "reports/text/quantity.h"

namespace trammel::reports {

namespace {

/// Cell of a colored map: the value of a quantity at a position, and the index of its color.
struct Cell {
  double x, y, value;
  std::size_t color = 0;
};

struct Field {
  std::vector<Cell> cells;  ///< row by row, each from left to right
  double dx = 0, dy = 0;
};

/// Returns the smallest nonzero difference of two of the coordinates.
double spacing(std::vector<double> values) {
  std::ranges::sort(values);
  const double extent = values.back() - values.front();
  double min_gap = extent;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double gap = values[i] - values[i - 1];
    if (gap > 1e-9 * extent) min_gap = std::min(min_gap, gap);
  }
  return min_gap;
}

Field read_field(const std::vector<double>& x, const std::vector<double>& y,
                 const std::vector<double>& value) {
  Field field;
  std::vector<double> xs, ys;
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (!Number(x[i]) || !Number(y[i]) || !Number(value[i])) continue;
    field.cells.push_back({x[i], y[i], value[i]});
    xs.push_back(x[i]);
    ys.push_back(y[i]);
  }
  if (field.cells.empty()) return field;
  field.dx = spacing(xs);
  field.dy = spacing(ys);
  if (field.dx == 0) field.dx = field.dy;  // one column or row: cells are square
  if (field.dy == 0) field.dy = field.dx;
  std::ranges::sort(field.cells, [&](const Cell& a, const Cell& b) {
    return std::abs(a.y - b.y) > 0.5 * field.dy ? a.y < b.y : a.x < b.x;
  });
  return field;
}

/// Returns the limits between the value ranges of a map that have different colors, rounded to two
/// digits. The ranges contain about equal numbers of cells.
std::vector<double> limits_of_color_classes(std::vector<double> sorted) {
  std::ranges::sort(sorted);
  const std::size_t classes = palette::kSequence.size();
  std::vector<double> limits;
  for (std::size_t k = 1; k < classes; ++k) {
    const double limit = sorted[k * sorted.size() / classes];
    const double unit =
        limit == 0 ? 1 : std::pow(10.0, std::floor(std::log10(std::abs(limit))) - 1);
    const double rounded = std::round(limit / unit) * unit;
    if (limits.empty() || rounded > limits.back()) limits.push_back(rounded);
  }
  return limits;
}

/// Returns the boxes of a map for each color. Each box is a row with the coordinates of its center
/// and its edges. Adjacent cells with the same color in one row of the map share one box.
std::vector<PlotScript::Rows> boxes(const Field& field) {
  std::vector<PlotScript::Rows> by_color(palette::kSequence.size());
  for (std::size_t from = 0; from < field.cells.size();) {
    const Cell& first = field.cells[from];
    std::size_t to = from + 1;
    while (to < field.cells.size() && field.cells[to].color == first.color &&
           std::abs(field.cells[to].y - first.y) < 0.5 * field.dy &&
           field.cells[to].x - field.cells[to - 1].x < 1.5 * field.dx) {
      ++to;
    }
    const double left = first.x - 0.5 * field.dx, right = field.cells[to - 1].x + 0.5 * field.dx;
    by_color[first.color].push_back({0.5 * (left + right), first.y, left, right,
                                     first.y - 0.5 * field.dy, first.y + 0.5 * field.dy});
    from = to;
  }
  return by_color;
}

std::string name_of_color_class(const std::vector<double>& limits, std::size_t k) {
  if (limits.empty()) return "all";
  if (k == 0) return "below " + trimmed(limits.front(), 2);
  if (k == limits.size()) return "above " + trimmed(limits.back(), 2);
  return trimmed(limits[k - 1], 2) + " to " + trimmed(limits[k], 2);
}

const Run* run_for(const PlotRequest& request, const std::vector<const Run*>& runs) {
  return find_run(runs, request.variants.empty() ? "base" : request.variants.front());
}

/// Returns the values of all maps of the case that show the same quantity, so that a color has the
/// same meaning in all these maps.
std::vector<double> values_of_all_maps(const CaseInfo& info, const PlotRequest& request,
                                       const std::vector<const Run*>& runs, const Field& own) {
  const auto name = [](const PlotRequest& map) { return map.value.substr(0, map.value.find(':')); };
  std::vector<double> values;
  for (const Cell& cell : own.cells) values.push_back(cell.value);
  for (const PlotRequest& other : info.figures) {
    if (other.id == request.id || name(other) != name(request)) continue;
    const Run* run = run_for(other, runs);
    const std::vector<double>* numbers = run ? run->quantity(other.value) : nullptr;
    if (!numbers) continue;
    for (const Number number : *numbers)
      if (number) values.push_back(*number);
  }
  return values;
}

PlotScript::Rows rows_of_line(const std::vector<double>& x, const std::vector<double>& y) {
  PlotScript::Rows rows;
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
    if (Number(x[i]) && Number(y[i])) {
      rows.push_back({x[i], y[i]});
    } else if (!rows.empty() && !rows.back().empty()) {
      rows.emplace_back();
    }
  }
  return rows;
}

void draw_lines(PlotScript& script, const PlotRequest& request, const Run& run,
                std::vector<std::string>& titles) {
  for (std::size_t i = 0; i < request.lines.size(); ++i) {
    const PlotRequest::Line& line = request.lines[i];
    const std::vector<double>* x = run.quantity(line.x);
    const std::vector<double>* y = run.quantity(line.y);
    if (!x || !y) continue;  // the run has no values of this curve
    const std::string style = "with lines lw 2.2" + lc(i == 0 ? palette::kInk : palette::color(i));
    script.curve(rows_of_line(*x, *y), style);
    script.key_entry(style, line.title);
    titles.push_back(line.title);
  }
}

Table table_of(const Field& field, const PlotRequest& request) {
  Table table{{request.x, request.y.front(), request.value}, {}};
  for (const Cell& cell : field.cells) table.rows.push_back({cell.x, cell.y, cell.value});
  return table;
}

/// Value ranges ("classes") of all maps of one quantity, with their colors.
struct ColorClasses {
  explicit ColorClasses(const std::vector<double>& values)
      : count(values.size()),
        limits(limits_of_color_classes(values)),
        negative(std::ranges::all_of(values, [](double value) { return value <= 0; })),
        positive(std::ranges::all_of(values, [](double value) { return value >= 0; })) {}

  [[nodiscard]] std::size_t class_of(double value) const {
    return static_cast<std::size_t>(std::ranges::upper_bound(limits, value) - limits.begin());
  }
  /// Returns the color of value range k of a map. High values are dark. If no value is positive,
  /// low values are dark.
  [[nodiscard]] std::string color(std::size_t k) const {
    return lc(palette::kSequence[negative ? limits.size() - std::min(k, limits.size()) : k]);
  }
  [[nodiscard]] std::string describe(std::size_t of_this_map) const {
    return std::string(negative || positive ? "; values far from zero are dark"
                                            : "; high values are dark") +
           (count == of_this_map ? ". Each color covers about the same number of positions."
                                 : ". All maps of this quantity have the same color scale.");
  }

  std::size_t count;
  std::vector<double> limits;
  bool negative, positive;
};

/// Draws a map, and the requested curves on it. @returns the height of the key [px]
int draw_map(PlotScript& script, const PlotRequest& request, const Run& run, const Field& field,
             const ColorClasses& classes) {
  Box box;
  for (const Cell& cell : field.cells) box.x.cover(cell.x), box.y.cover(cell.y);
  box.x.widen(0.5 * field.dx);
  box.y.widen(0.5 * field.dy);
  set_axis_ranges(script, box);
  std::vector<std::string> titles;
  const auto by_color = boxes(field);
  for (std::size_t k = 0; k < by_color.size(); ++k) {
    const std::string color = classes.color(k);
    script.curve(by_color[k], "using 1:2:3:4:5:6 with boxxyerror fs solid noborder" + color);
    if (by_color[k].empty()) continue;
    titles.push_back(name_of_color_class(classes.limits, k));
    script.key_entry("with points pt 5 ps 1.6" + color, titles.back());
  }
  draw_lines(script, request, run, titles);
  const int key_height = script.place_key_below(titles);
  script.plot();
  return key_height;
}

}  // namespace

std::optional<Figure> map_figure(const CaseInfo& info, const PlotRequest& request,
                                 const std::vector<const Run*>& runs, std::string& problem) {
  const Run* run = run_for(request, runs);
  const auto find = [&](const std::string& name) { return run ? run->quantity(name) : nullptr; };
  const auto *x = find(request.x), *y = find(request.y.front()), *value = find(request.value);
  if (!x || !y || !value || x->size() != value->size() || y->size() != value->size()) {
    problem = "there is no " + request.value + " over " + request.x + " and " + request.y.front();
    return std::nullopt;
  }
  Field field = read_field(*x, *y, *value);
  if (field.cells.empty() || !(field.dx > 0)) {
    problem = request.value + (field.cells.empty() ? " has no numbers" : " has a single position");
    return std::nullopt;
  }
  const ColorClasses classes(values_of_all_maps(info, request, runs, field));
  double largest = 0;
  for (Cell& cell : field.cells) {
    largest = std::max(largest, std::abs(cell.value));
    cell.color = classes.class_of(cell.value);
  }
  PlotScript script;
  const int key_height = draw_map(script, request, *run, field, classes);

  const QuantityLabel quantity = parse_quantity(request.value);
  return Figure{.id = slug(info.id + "-" + request.id),
                .title = request.title,
                .caption = request.caption + (request.caption.empty() ? "" : " ") + "Colors: " +
                           quantity.label + (quantity.unit.empty() ? "" : " in " + quantity.unit) +
                           classes.describe(field.cells.size()),
                .alt = "Map of " + to_text(quantity) +
                       " over positions. The largest magnitude is " + trimmed(largest, 3) + " " +
                       quantity.unit + ".",
                .height = 420 + key_height,
                .commands = script.commands(),
                .data = table_of(field, request)};
}

}  // namespace trammel::reports
