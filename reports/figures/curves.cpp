#include <algorithm>
#include <array>
#include <cmath>

#include "reports/figures/figures.h"
#include "reports/number.h"
#include "reports/palette.h"
#include "reports/plot_script.h"
#include "reports/quantity.h"

namespace trammel::reports {

namespace {

constexpr std::size_t most_drawn_points = 1500;
constexpr std::array<const char*, 5> dashes = {"", "-", "..", "-.", "_ "};

struct Series {
  std::string quantity, variant, label;
  std::size_t color, dash;
  const Numbers* values;
  double largest = 0;
};

double largest_of(const Numbers& values) {
  double largest = 0;
  for (const Number& value : values)
    if (value) largest = std::max(largest, std::abs(*value));
  return largest;
}

/// Smallest and largest of each bucket, in order: a long signal keeps its outline.
PlotScript::Rows thinned(const PlotScript::Rows& rows) {
  if (rows.size() <= most_drawn_points) return rows;
  const std::size_t bucket = 2 * rows.size() / most_drawn_points + 1;
  PlotScript::Rows out;
  for (std::size_t from = 0; from < rows.size(); from += bucket) {
    const auto begin = rows.begin() + static_cast<long>(from);
    const auto end = rows.begin() + static_cast<long>(std::min(rows.size(), from + bucket));
    auto [low, high] = std::minmax_element(
        begin, end, [](const auto& a, const auto& b) { return a.back() < b.back(); });
    if (high < low) std::swap(low, high);
    out.push_back(*low);
    if (high != low) out.push_back(*high);
  }
  return out;
}

PlotScript::Rows rows_of(const Numbers* x, const Numbers& y, double x_factor, double y_factor) {
  PlotScript::Rows rows;
  for (std::size_t i = 0; i < y.size(); ++i) {
    const Number at = x ? (*x)[i] : Number(static_cast<double>(i + 1));
    if (at && y[i]) {
      rows.push_back({x_factor * *at, y_factor * *y[i]});
    } else if (!rows.empty() && !rows.back().empty()) {
      rows.emplace_back();
    }
  }
  return thinned(rows);
}

const Run* run_of(const std::vector<const Run*>& runs, const std::string& variant) {
  for (const Run* run : runs)
    if (run->variant == variant) return run;
  return nullptr;
}

/// Every quantity of every variant asked for. Units and lengths must agree.
std::vector<Series> collect(const PlotRequest& request, const std::vector<std::string>& variants,
                            const std::vector<const Run*>& runs, std::string& problem) {
  std::vector<Series> series;
  for (std::size_t iy = 0; iy < request.y.size(); ++iy) {
    for (std::size_t iv = 0; iv < variants.size(); ++iv) {
      const std::string& y = request.y[iy];
      const std::string& variant = variants[iv];
      const Run* run = run_of(runs, variant);
      const Numbers* values = run ? run->quantity(y) : nullptr;
      const Numbers* x = run ? run->quantity(request.x) : nullptr;
      if (!run) {
        problem = "there is no run of the variant " + variant;
      } else if (!values || values->empty()) {
        problem = "the variant " + variant + " has no " + y;
      } else if (!request.x.empty() && !x) {
        problem = "the variant " + variant + " has no " + request.x;
      } else if (x && x->size() != values->size()) {
        problem = y + " and " + request.x + " of the variant " + variant + " differ in length";
      } else if (parse_quantity(y).unit != parse_quantity(request.y.front()).unit) {
        problem = y + " and " + request.y.front() + " differ in unit";
      } else {
        // Colours tell quantities apart, dashes variants; of one quantity both tell variants.
        const std::size_t color = request.y.size() > 1 ? iy : iv;
        series.push_back({y, variant, "", color, iv, values, largest_of(*values)});
        continue;
      }
      return {};
    }
  }
  if (series.empty()) problem = "nothing to draw is named";
  return series;
}

void name_series(std::vector<Series>& series, const CaseInfo& info, const PlotRequest& request,
                 std::size_t variants) {
  for (Series& s : series) {
    const std::string quantity = in_words(parse_quantity(s.quantity));
    const std::string variant = info.variant_title(s.variant);
    if (request.y.size() == 1) {
      s.label = variant;
    } else {
      s.label = variants == 1 ? quantity : quantity + ", " + variant;
    }
  }
}

/// "x displacement of P", "x reaction", "displacement", "value": as much as all have in common.
std::string common_words(const std::vector<std::string>& names) {
  if (names.size() == 1) return in_words(parse_quantity(names.front()));
  const auto without_direction = [](const std::string& label) {
    return label.rfind("x ", 0) == 0 || label.rfind("y ", 0) == 0 ? label.substr(2) : label;
  };
  const std::string label = parse_quantity(names.front()).label;
  const auto all = [&](const auto& same) { return std::all_of(names.begin(), names.end(), same); };
  if (all([&](const std::string& name) { return parse_quantity(name).label == label; }))
    return label;
  const std::string bare = without_direction(label);
  return all([&](const std::string& name) {
    return without_direction(parse_quantity(name).label) == bare;
  })
             ? bare
             : "value";
}

void x_range(PlotScript& script, const Numbers& values, double factor) {
  double low = 1e300, high = -1e300;
  for (const Number& value : values) {
    if (!value) continue;
    low = std::min(low, factor * *value);
    high = std::max(high, factor * *value);
  }
  if (low < high) script.range("x", low, high);
}

/// "Largest magnitude: 8.13 mm (base), 8.10 mm (rigid platform)."
std::string measured(const std::vector<Series>& series, const Scale& scale) {
  std::string text = "Largest magnitude: ";
  const std::size_t shown = std::min<std::size_t>(series.size(), 4);
  for (std::size_t i = 0; i < shown; ++i) {
    text += (i ? ", " : "") + trimmed(scale.factor * series[i].largest, 3);
    if (!scale.unit.empty()) text += "\u202f" + scale.unit;
    if (series.size() > 1) text += " (" + series[i].label + ")";
  }
  return text + (shown < series.size() ? ", …" : ".");
}

Table table_of(const std::vector<Series>& series, const std::vector<const Run*>& runs,
               const PlotRequest& request) {
  Table table;
  const Numbers* x = run_of(runs, series.front().variant)->quantity(request.x);
  table.heads = {request.x.empty() ? "index" : request.x};
  std::size_t n = 0;
  for (const Series& s : series) {
    table.heads.push_back(s.quantity + " [" + s.variant + "]");
    n = std::max(n, s.values->size());
  }
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<Table::Cell> row = {x && i < x->size() ? cell((*x)[i])
                                                       : cell(static_cast<double>(i + 1))};
    for (const Series& s : series)
      row.push_back(i < s.values->size() ? cell((*s.values)[i]) : Table::Cell{});
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

std::optional<Figure> curves_figure(const CaseInfo& info, const PlotRequest& request,
                                    const std::vector<const Run*>& runs, std::string& problem) {
  std::vector<std::string> variants = request.variants;
  if (variants.empty())
    for (const Run* run : runs) variants.push_back(run->variant);
  std::vector<Series> series = collect(request, variants, runs, problem);
  if (series.empty()) return std::nullopt;
  name_series(series, info, request, variants.size());

  const Quantity y = parse_quantity(request.y.front());
  const Quantity x = parse_quantity(request.x);
  double largest = 0;
  for (const Series& s : series) largest = std::max(largest, s.largest);
  const Numbers* x_values = run_of(runs, series.front().variant)->quantity(request.x);
  const Scale y_scale = readable_scale(y.unit, largest);
  const Scale x_scale =
      x.unit == "s" || !x_values ? Scale{1, x.unit} : readable_scale(x.unit, largest_of(*x_values));

  PlotScript script;
  script.axis_label("x", request.x.empty() ? "number" : axis_label(in_words(x), x_scale.unit));
  const std::string words = common_words(request.y);
  script.axis_label("y", axis_label(words, y_scale.unit));
  if (largest == 0) script.range("y", -1, 1);
  if (x_values) x_range(script, *x_values, x_scale.factor);
  std::vector<std::string> titles;
  if (series.size() > 1)
    for (const Series& s : series) titles.push_back(s.label);
  const int key_height = script.key_below(titles);
  for (std::size_t i = 0; i < series.size(); ++i) {
    const Numbers* at = run_of(runs, series[i].variant)->quantity(request.x);
    const auto rows = rows_of(at, *series[i].values, x_scale.factor, y_scale.factor);
    const std::size_t pattern = series[i].dash % dashes.size();
    const std::string dash = pattern == 0 ? "" : " dt " + quoted(dashes[pattern]);
    const std::string marks = rows.size() <= 40 ? "linespoints pt 7 ps 0.6" : "lines";
    script.curve(rows, "with " + marks + " lw 2.2" + dash + lc(palette::color(series[i].color)),
                 series.size() > 1 ? series[i].label : "");
  }
  script.plot();

  Figure figure;
  figure.id = slug(info.id + "-" + request.id);
  figure.title = request.title;
  figure.caption =
      request.caption + (request.caption.empty() ? "" : " ") + measured(series, y_scale);
  figure.alt = "Curves of " + words + " over " + (request.x.empty() ? "number" : in_words(x)) +
               ". " + measured(series, y_scale);
  figure.height = 345 + key_height;
  figure.commands = script.commands();
  figure.data = table_of(series, runs, request);
  return figure;
}

}  // namespace trammel::reports
