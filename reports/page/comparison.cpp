#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "harness/results/unfinished_folder.h"
#include "reports/figures/figures.h"
#include "reports/page/render.h"
#include "reports/page/report.h"
#include "reports/sections/sections.h"
#include "reports/text/files.h"
#include "reports/text/html.h"
#include "reports/text/number.h"
#include "reports/text/quantity.h"

namespace trammel::reports {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxFigures = 12;  ///< largest number of figures for each run

std::string signed_percent(const Number& percent) {
  return percent ? number_with_sign(*percent, 3) + "\u202f%" : "";
}

/// Returns the label of one of the compared sets of results ("sides"). The label is followed by the
/// code, commit, date and processor of the side, as far as they differ between the sides.
std::string label_of_results(const SideComparison& comparison, const ComparedSide& side) {
  std::string text = side.label;
  for (const auto member : {&ComparedSide::solver, &ComparedSide::commit, &ComparedSide::date,
                            &ComparedSide::processor}) {
    const auto same = [&](const ComparedSide& other) { return other.*member == side.*member; };
    if (!std::ranges::all_of(comparison.sides, same) && !(side.*member).empty())
      text += ", " + side.*member;
  }
  return text;
}

TextTable table_of_result_sets(const SideComparison& comparison) {
  const bool errors = comparison.sides.front().median_error.has_value();
  TextTable table{"Time and accuracy",
                  {"Side", ">Runs", ">Processor time", ">Relative to the first", ">Work"}};
  if (errors) table.heads.insert(table.heads.end(), {">Median error", ">Largest error"});
  for (const ComparedSide& side : comparison.sides) {
    std::vector<std::string> row = {
        label_of_results(comparison, side), std::to_string(side.runs), duration(side.cpu_s),
        side.relative_time ? "× " + trimmed(*side.relative_time, 3) : "",
        std::to_string(side.work)};
    if (errors)
      row.insert(row.end(), {percent_text(side.median_error.value_or(0), 3, false),
                             percent_text(side.largest_error.value_or(0), 3, false)});
    table.rows.push_back(row);
  }
  return table;
}

TextTable value_table(const std::string& title, const std::string& head,
                      const SideComparison& comparison) {
  TextTable table{title, {head}};
  for (std::size_t s = 0; s < comparison.sides.size(); ++s) {
    table.heads.push_back(">" + comparison.sides[s].label);
    if (s > 0) table.heads.emplace_back(">Change");
  }
  return table;
}

TextTable modes_table(const ComparedRun& run, const SideComparison& comparison) {
  TextTable table = value_table("Modes matched by shape (Hz)", "Mode", comparison);
  for (const ComparedModes& found : run.modes) {
    std::vector<std::string> row = {fmt::format("{}", fmt::join(found.modes[0], ", "))};
    for (std::size_t s = 0; s < found.values.size(); ++s) {
      std::string text = found.values[s] ? rounded_text(*found.values[s], 6) : "no similar mode";
      if (found.last[s]) text += " to " + rounded_text(*found.last[s], 6);
      if (found.errors[s]) text += " ± " + rounded_text(*found.errors[s], 2);
      if (found.modes[s] != found.modes[0] && !found.modes[s].empty())
        text += " (mode " + fmt::format("{}", fmt::join(found.modes[s], ", ")) + ")";
      row.push_back(text);
      if (s > 0) row.push_back(signed_percent(found.percent[s]));
    }
    table.rows.push_back(row);
  }
  return table;
}

TextTable table_of_numbers(const ComparedRun& run, const SideComparison& comparison) {
  TextTable table = value_table("Numbers that differ", "Quantity", comparison);
  for (const ComparedNumber& number : run.numbers) {
    if (!number.changed) continue;
    std::vector<std::string> row = {
        number.quantity + (number.entries > 1 ? "[" + std::to_string(number.index) + "]" : "")};
    for (std::size_t s = 0; s < number.values.size(); ++s) {
      const Number value = number.values[s];
      const bool zero = value && std::abs(*value) <= number.noise;
      row.push_back(zero ? "0" : text_or_dash(value, 6));
      if (!zero && number.errors[s]) row.back() += " ± " + rounded_text(*number.errors[s], 2);
      if (s > 0) row.push_back(signed_percent(number.percent[s]));
    }
    table.rows.push_back(row);
  }
  return table;
}

/// Returns requests for the figures that the case itself requests, and for a figure of each further
/// list of values that differs between the compared results.
std::vector<PlotRequest> plot_requests_of_run(const ComparedRun& run) {
  std::vector<PlotRequest> requests;
  std::set<std::string> drawn = {"time_s"};  // time is the x axis of other series
  for (PlotRequest request : run.info.figures) {
    if (!request.value.empty()) continue;
    request.variants.clear();
    drawn.insert(request.y.begin(), request.y.end());
    requests.push_back(std::move(request));
  }
  const std::vector<double>* time = run.runs.front().quantity("time_s");
  for (const ComparedNumber& number : run.numbers) {
    if (!number.changed || number.entries < 7 || !drawn.insert(number.quantity).second) continue;
    PlotRequest request;
    request.id = number.quantity;
    request.title = capitalized(to_text(parse_quantity(number.quantity)));
    request.y = {number.quantity};
    if (time && time->size() == number.entries) request.x = "time_s";
    requests.push_back(std::move(request));
  }
  return requests;
}

/// Plans figures that show the runs of all compared sets of results ("sides") like variants of one
/// case. The labels of the sides are the titles of the variants.
std::vector<Figure> plan_figures(const ComparedRun& run, const SideComparison& comparison) {
  if (run.runs.empty()) return {};
  CaseInfo info = run.info;
  std::vector<Run> runs = run.runs;
  std::vector<const Run*> sides;
  info.id = slug(run.name);
  info.variants.clear();
  for (std::size_t s = 0; s < runs.size(); ++s) {
    runs[s].variant = std::to_string(s);
    info.variants.push_back({runs[s].variant, comparison.sides[s].label});
    sides.push_back(&runs[s]);
  }
  std::vector<Figure> figures;
  for (const PlotRequest& request : plot_requests_of_run(run)) {
    std::string problem;
    if (figures.size() == kMaxFigures) break;
    if (auto figure = curves_figure(info, request, sides, problem))
      figures.push_back(std::move(*figure));
  }
  return figures;
}

}  // namespace

void write_comparison(const SideComparison& comparison, const fs::path& file) {
  std::vector<std::vector<Figure>> figures;
  for (const ComparedRun& run : comparison.runs) figures.push_back(plan_figures(run, comparison));
  std::vector<Figure*> page;
  for (auto& own : figures)
    for (Figure& figure : own) page.push_back(&figure);
  make_ids_unique(page);
  const fs::path part = file.parent_path() / kUnfinishedFolder;
  draw(page, part);
  fs::remove_all(part);
  Data runs = list();
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    const ComparedRun& run = comparison.runs[i];
    if (!run.changed && figures[i].empty()) continue;
    const bool variants = run.name == comparison.sides.front().label;
    Data tables = list();
    for (const TextTable& table : {modes_table(run, comparison), table_of_numbers(run, comparison)})
      if (!table.rows.empty()) tables.push_back(table_data(table));
    runs.push_back(object({{"name", run.info.title.empty() ? run.name
                                    : variants             ? run.info.title
                                               : run.info.title + " (" + run.name + ")"},
                           {"remarks", texts(run.remarks)},
                           {"tables", tables},
                           {"figures", list_of(figures[i], figure_data)}}));
  }
  Data data = object({{"style", template_text("figure.css") + template_text("style.css")},
                      {"script", template_text("page.js")},
                      {"single", true},
                      {"conclusion", comparison.conclusion},
                      {"sides", table_data(table_of_result_sets(comparison))},
                      {"runs", runs}});
  if (!file.parent_path().empty()) fs::create_directories(file.parent_path());
  write_file(file, render("comparison.mustache", data));
}

}  // namespace trammel::reports
