#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "harness/base/statistic.h"
#include "reports/drawing/interval.h"
#include "reports/drawing/palette.h"
#include "reports/drawing/plot_script.h"
#include "reports/figures/figures.h"
#include "reports/text/number.h"
#include "reports/text/quantity.h"

namespace trammel::reports {

namespace {

constexpr std::array<const char*, 5> kDashes = {"", "-", "..", "-.", "-.."};

/// A curve of a figure: the values of one quantity of one variant of the case.
struct Series {
  std::string quantity, variant, label;
  std::size_t color, dash;
  const std::vector<double>* values;
  double largest = 0;
};

/// Returns the number that an axis shows for a value. A logarithmic axis shows magnitudes and omits
/// zeros.
Number number_on_axis(const Number& value, bool log) {
  if (!value || !log) return value;
  return *value == 0 ? Number() : Number(std::abs(*value));
}

PlotScript::Rows curve_rows(const std::vector<double>* x, const std::vector<double>& y,
                            std::pair<double, double> factors, const PlotRequest& request) {
  PlotScript::Rows rows;
  for (std::size_t i = 0; i < y.size(); ++i) {
    const Number at =
        number_on_axis(x ? (*x)[i] : Number(static_cast<double>(i + 1)), request.is_log("x"));
    const Number value = number_on_axis(y[i], request.is_log("y"));
    if (at && value) {
      rows.push_back({factors.first * *at, factors.second * *value});
    } else if (!rows.empty() && !rows.back().empty()) {
      rows.emplace_back();
    }
  }
  return rows;
}

bool has_any(const Run& run, const std::vector<std::string>& names) {
  return std::ranges::any_of(names, [&](const std::string& name) {
    const std::vector<double>* values = run.quantity(name);
    return values && !values->empty();
  });
}

/// Returns the words that distinguish the name of a quantity from the names of the other plotted
/// quantities.
std::string distinguishing_words(const std::string& name, const PlotRequest& request) {
  const QuantityLabel quantity = parse_quantity(name);
  const bool one_label = std::ranges::all_of(
      request.y, [&](const auto& y) { return parse_quantity(y).label == quantity.label; });
  return one_label && !quantity.subject.empty() ? quantity.subject : to_text(quantity);
}

/// Returns the requested quantities of the requested variants. Each variant must have at least one
/// quantity, and at least one variant must have each quantity. Units and lengths must agree.
/// @param problem  set to the reason if the figure cannot be drawn
std::vector<Series> collect_series(const CaseInfo& info, const PlotRequest& request,
                                   const std::vector<std::string>& variants,
                                   const std::vector<const Run*>& runs, std::string& problem) {
  std::vector<Series> series;
  for (std::size_t iy = 0; iy < request.y.size(); ++iy) {
    const std::string& y = request.y[iy];
    const std::size_t before = series.size();
    for (std::size_t iv = 0; iv < variants.size(); ++iv) {
      const std::string& variant = variants[iv];
      const Run* run = find_run(runs, variant);
      const std::vector<double>* values = run ? run->quantity(y) : nullptr;
      const std::vector<double>* x = run ? run->quantity(request.x) : nullptr;
      if (!run) {
        problem = "there is no run of the variant " + variant;
      } else if ((!values || values->empty()) && has_any(*run, request.y)) {
        continue;  // the variant has another quantity
      } else if (!values || values->empty()) {
        problem = "the variant " + variant + " has no " + y;
      } else if (!request.x.empty() && !x) {
        problem = "the variant " + variant + " has no " + request.x;
      } else if (x && x->size() != values->size()) {
        problem = y + " and " + request.x + " of the variant " + variant + " differ in length";
      } else if (parse_quantity(y).unit != parse_quantity(request.y.front()).unit) {
        problem = y + " and " + request.y.front() + " differ in unit";
      } else {
        // Colors distinguish quantities, and dash patterns variants. If there is only one quantity,
        // colors and dash patterns distinguish variants.
        const bool many = request.y.size() > 1;
        std::string label = many ? distinguishing_words(y, request) : info.variant_title(variant);
        if (many && variants.size() > 1) label += ", " + info.variant_title(variant);
        series.push_back(
            {y, variant, label, many ? iy : iv, iv, values, harness::max_abs(*values)});
        continue;
      }
      return {};
    }
    if (series.size() == before) {
      problem = "no variant has " + y;
      return {};
    }
  }
  if (series.empty()) problem = "the case requests the figure without a quantity";
  return series;
}

/// Returns the common last words of two texts: "distance" for "serial distance", "parallel
/// distance".
std::string shared_ending(const std::string& a, const std::string& b) {
  const auto differ = std::mismatch(a.rbegin(), a.rend(), b.rbegin(), b.rend()).first;
  const std::string end(differ.base(), a.end());
  if (a == b) return a;
  return end.find(' ') == std::string::npos ? "" : end.substr(end.find(' ') + 1);
}

/// Returns an axis label for several quantities: the last words that all names have in common, or
/// else "value".
std::string label_of_common_words(const std::vector<std::string>& names) {
  if (names.size() == 1) return to_text(parse_quantity(names.front()));
  std::string common = parse_quantity(names.front()).label;
  for (const std::string& name : names) common = shared_ending(common, parse_quantity(name).label);
  return common.empty() ? "value" : common;
}

/// Sets the range of an axis to the range of the values of the curves.
void fit_axis(PlotScript& script, const std::string& axis,
              const std::vector<const std::vector<double>*>& curves, bool log, double factor) {
  Interval range;
  for (const std::vector<double>* values : curves)
    for (const Number value : *values)
      if (const Number drawn = number_on_axis(value, log)) range.cover(factor * *drawn);
  if (log && !range.empty())
    script.log_axis(axis, range.low, range.high > range.low ? range.high : 10 * range.high);
  if (!log && range.length() > 0) script.range(axis, range.low, range.high);
}

/// Returns "Largest magnitude: 8.13 mm (base)." The unit is that of the y axis. If the axis label
/// has a power of ten, the unit is unscaled.
std::string largest_magnitude_text(const std::vector<Series>& series, const Scale& axis,
                                   const std::string& unit) {
  const Scale scale = axis.unit.starts_with("10") ? Scale{1, unit} : axis;
  const Series& top = *std::ranges::max_element(series, {}, &Series::largest);
  std::string text = "Largest magnitude: " + trimmed(scale.factor * top.largest, 3);
  if (!scale.unit.empty()) text += "\u202f" + scale.unit;
  return text + (series.size() > 1 ? " (" + shortened(top.label, 44) + ")." : ".");
}

Table table_of(const std::vector<Series>& series, const std::vector<const Run*>& runs,
               const PlotRequest& request) {
  Table table;
  const std::vector<double>* x = find_run(runs, series.front().variant)->quantity(request.x);
  table.digits = kSampleDigits;
  table.heads = {request.x.empty() ? "index" : request.x};
  std::size_t n = 0;
  for (const Series& s : series) {
    table.heads.push_back(s.quantity + " [" + s.variant + "]");
    n = std::max(n, s.values->size());
  }
  for (std::size_t i = 0; i < n; ++i) {
    const auto number = static_cast<double>(i + 1);
    std::vector<harness::Json> row = {number_or_null(x && i < x->size() ? (*x)[i] : number)};
    for (const Series& s : series)
      row.push_back(number_or_null(i < s.values->size() ? (*s.values)[i] : Number()));
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string dashed(std::size_t variant) {
  const std::size_t pattern = variant % kDashes.size();
  return pattern == 0 ? "" : " dt " + gnuplot_string(kDashes[pattern]);
}

/// Draws the curves and their key. If quantities and variants both differ, the key has entries for
/// colors (quantities) and dashes (variants), not for every curve. @returns the height of the key.
int draw_series(PlotScript& script, const std::vector<Series>& series, const CaseInfo& info,
                const PlotRequest& request, const std::vector<std::string>& variants,
                std::pair<double, double> factors, const std::vector<const Run*>& runs) {
  const bool product = request.y.size() > 1 && variants.size() > 1;
  std::vector<std::pair<std::string, std::string>> entries;  // style, title
  const std::string line = "with lines lw 2.2";
  if (product) {
    for (std::size_t i = 0; i < request.y.size(); ++i)
      entries.emplace_back(line + lc(palette::color(i)),
                           distinguishing_words(request.y[i], request));
    for (std::size_t i = 0; i < variants.size(); ++i)
      entries.emplace_back(line + dashed(i) + lc(palette::kMuted), info.variant_title(variants[i]));
  }
  for (const Series& s : series) {
    const std::vector<double>* at = find_run(runs, s.variant)->quantity(request.x);
    const auto rows = curve_rows(at, *s.values, factors, request);
    const std::string style = dashed(s.dash) + lc(palette::color(s.color));
    const std::string marks = rows.size() <= 40 ? "linespoints pt 7 ps 0.6" : "lines";
    script.curve(rows, "with " + marks + " lw 2.2" + style);
    if (!product && series.size() > 1) entries.emplace_back(line + style, s.label);
  }
  std::vector<std::string> titles;
  for (const auto& [style, title] : entries) {
    titles.push_back(title);
    script.key_entry(style, title);
  }
  return script.place_key_below(titles);
}

}  // namespace

const Run* find_run(const std::vector<const Run*>& runs, const std::string& variant) {
  const auto found = std::ranges::find(runs, variant, &Run::variant);
  return found == runs.end() ? nullptr : *found;
}

std::optional<Figure> curves_figure(const CaseInfo& info, const PlotRequest& request,
                                    const std::vector<const Run*>& runs, std::string& problem) {
  std::vector<std::string> variants = request.variants;
  if (variants.empty())
    for (const Run* run : runs) variants.push_back(run->variant);
  const std::vector<Series> series = collect_series(info, request, variants, runs, problem);
  if (series.empty()) return std::nullopt;

  const QuantityLabel y = parse_quantity(request.y.front());
  const QuantityLabel x = parse_quantity(request.x);
  double largest = 0;
  for (const Series& s : series) largest = std::max(largest, s.largest);
  const std::vector<double>* x_values = find_run(runs, series.front().variant)->quantity(request.x);
  const Scale y_scale = request.is_log("y") ? Scale{1, y.unit} : readable_scale(y.unit, largest);
  const Scale x_scale = x.unit == "s" || !x_values || request.is_log("x")
                            ? Scale{1, x.unit}
                            : readable_scale(x.unit, harness::max_abs(*x_values));

  PlotScript script;
  script.axis_label("x", request.x.empty() ? "index" : axis_label(to_text(x), x_scale.unit));
  const std::string words = label_of_common_words(request.y);
  script.axis_label("y", axis_label(words, y_scale.unit));
  if (largest == 0) script.range("y", -1, 1);
  std::vector<const std::vector<double>*> all;
  for (const Series& s : series) all.push_back(s.values);
  if (request.is_log("y")) fit_axis(script, "y", all, true, 1);
  if (x_values) fit_axis(script, "x", {x_values}, request.is_log("x"), x_scale.factor);
  const int key_height =
      draw_series(script, series, info, request, variants, {x_scale.factor, y_scale.factor}, runs);
  script.plot();

  const std::string largest_text = largest_magnitude_text(series, y_scale, y.unit);
  return Figure{.id = slug(info.id + "-" + request.id),
                .title = request.title,
                .caption = request.caption + (request.caption.empty() ? "" : " ") + largest_text,
                .alt = "Curves of " + words + " over " +
                       (request.x.empty() ? "index" : to_text(x)) + ". " + largest_text,
                .height = 345 + key_height,
                .commands = script.commands(),
                .data = table_of(series, runs, request)};
}

}  // namespace trammel::reports
