#include <algorithm>
#include <cmath>
#include <utility>

#include "harness/base/find_or_add.h"
#include "harness/base/quantity.h"
#include "harness/base/statistic.h"
#include "reports/sections/sections.h"
#include "reports/text/number.h"
#include "reports/text/quantity.h"

namespace trammel::reports {

namespace {

constexpr std::size_t kMaxListedValues = 8;

Number statistic_or_missing(const std::string& name, const std::vector<double>* values) {
  if (!values || std::ranges::any_of(*values, [](Number value) { return !value; })) return {};
  return harness::statistic_of(name.empty() ? "first" : name, *values);
}

Number find_timing(const Run& run, const std::string& name) {
  for (const auto& [key, seconds, evaluations] : run.cost.timings)
    if (key == name) return seconds;
  return {};
}

std::string cell_text(const ColumnRequest& column, const Run& run) {
  if (column.timing.empty())
    return text_or_dash(statistic_or_missing(column.statistic, run.quantity(column.quantity)), 3);
  const Number time = find_timing(run, column.timing), other = find_timing(run, column.over_timing);
  if (!time || (!column.over_timing.empty() && other.value_or(0) == 0)) return text_or_dash({}, 3);
  return column.over_timing.empty() ? duration(*time) : "× " + trimmed(*time / *other, 2);
}

/// Returns a table that a case requests. Each variant has a row. Each quantity, or computing time,
/// has a column.
TextTable variant_table(const TableRequest& request, const CaseInfo& info,
                        const std::vector<const Run*>& runs) {
  TextTable table{request.title, {"Variant"}, {}, request.caption};
  for (const ColumnRequest& column : request.columns) table.heads.push_back(">" + column.title);
  for (const Run* run : runs) {
    if (!request.variants.empty() && !harness::contains(request.variants, run->variant)) continue;
    std::vector<std::string>& row = table.rows.emplace_back();
    row.push_back(info.variant_title(run->variant));
    for (const ColumnRequest& column : request.columns) row.push_back(cell_text(column, *run));
  }
  return table;
}

/// Returns a table for one row of numbers printed in a publication. It contains the most probable
/// interpretations ("readings") of the published model, with their probabilities and predicted
/// values.
TextTable probability_table(const RowProbabilities& row, const std::string& variant) {
  const auto count_of = [](int n, const char* noun, const char* nouns = "") {
    return count(static_cast<std::size_t>(n), noun, nouns);
  };
  TextTable table{"Row " + row.row + ", assuming a model discrepancy of " +
                      percent_text(row.discrepancy.value_or(0), 2, false) +
                      (variant == "base" ? "" : ", variant " + variant),
                  {"Most probable reading of each class", ">Probability"},
                  {},
                  count_of(row.readings, "reading") + " in " +
                      count_of(row.classes, "class", "classes") +
                      ". The readings of a class predict the same numbers for the row. " +
                      count_of(row.credible_classes, "class has", "classes have") +
                      " 95\u202f% of the probability."};
  const auto add_row = [&](const std::string& title, const std::string& probability,
                           const Numbers& values) {
    std::vector<std::string>& cells = table.rows.emplace_back();
    cells = {title, probability};
    for (const Number& value : values) cells.push_back(value ? rounded_text(*value, 5) : "");
    for (std::size_t i = table.heads.size(); i < cells.size(); ++i)
      table.heads.push_back(">Value " + std::to_string(i - 1));
  };
  add_row("as printed [" + row.unit + "]", "", row.printed);
  for (const ReadingClass& reading : row.leading)
    add_row(reading.title + (reading.readings == 1
                                 ? ""
                                 : " (and " + count_of(reading.readings - 1, "other") +
                                       " that the row cannot distinguish)"),
            percent_text(reading.probability.value_or(0), 3, false), reading.values);
  return table;
}

/// Returns the text of up to eight values as a list, and of more values as a range.
std::string values_text(const std::vector<double>& values) {
  if (values.size() > kMaxListedValues) {
    const auto [low, high] = std::ranges::minmax(values);
    return limits_text(rounded_text(low, 4), rounded_text(high, 4));
  }
  std::string text;
  for (const double value : values) add_item(text, trimmed(value, 6));
  return text;
}

/// Returns the table row of a quantity: its values, and its largest estimated discretization error
/// if available.
std::vector<std::string> result_row(const std::string& name, const std::vector<double>& values,
                                    const ErrorEstimate* estimate) {
  const QuantityLabel quantity = parse_quantity(name);
  const std::string label = axis_label(to_text(quantity), quantity.unit);
  if (estimate == nullptr) return {label, values_text(values), "–"};
  double largest = 0;
  for (const Number& error : estimate->relative) largest = std::max(largest, error.value_or(0));
  return {label, values_text(values),
          "± " + trimmed(100 * largest, 2) + "\u202f%" + (estimate->asymptotic ? "" : " (coarse)")};
}

/// Returns the difference from each printed number and its standard uncertainties (ASME V&V 20),
/// grouped by variant and reference, in percent of the printed number.
TextTable uncertainty_table(const CaseInfo& info, const std::vector<const Run*>& runs) {
  TextTable table{"Validation uncertainty",
                  {"Quantity", ">Printed D", ">E (%)", ">u_num (%)", ">u_input (%)", ">u_D (%)",
                   ">u_val (%)", "Dominant input"}};
  for (const Run* run : runs) {
    std::string last;
    if (!run->uncertainty) continue;
    for (const Comparison& c : run->uncertainty->comparisons) {
      if (!c.expected || !c.u_val) continue;
      const auto percent = [&](Number value, bool sign) {
        const double size = value.value_or(0) / std::abs(*c.expected) * 100;
        return !value ? "" : sign ? number_with_sign(size, 2) : trimmed(size, 2);
      };
      if (std::exchange(last, c.check) != c.check)
        table.rows.push_back({info.variant_title(run->variant) + ", " + c.check});
      const QuantityLabel label = parse_quantity(c.quantity);
      const std::string name = to_text(label) + " " + std::to_string(c.index + 1);
      table.rows.push_back({axis_label(name, label.unit), rounded_text(*c.expected, 4),
                            percent(c.difference, true), percent(c.u_num, false),
                            percent(c.u_input, false), percent(c.u_reference, false),
                            percent(c.u_val, false), c.dominant_input});
    }
  }
  return table;
}

/// Returns the inputs of the model with a heading for each object of the case file.
TextTable inputs_table(const CaseInfo& info) {
  TextTable table{"Inputs of the model", {"Input", ">Value", "Unit", "Stated in"}};
  for (std::string last; const auto& [path, value, source] : info.inputs) {
    const std::size_t slash = path.rfind('/');
    const std::string object = slash == std::string::npos ? "model" : path.substr(0, slash);
    if (std::exchange(last, object) != object) table.rows.push_back({object});
    const QuantityLabel input = parse_quantity(path.substr(slash + 1));
    const std::string unit = value[0] >= 'a' ? "" : input.unit;  // texts have no unit
    const std::string shown = value.ends_with("0.0") ? trimmed(std::stod(value), 10) : value;
    table.rows.push_back({input.label, shown, unit, source.empty() ? "this case" : source});
  }
  return table;
}

bool selects_effects(const Run* run) {
  return std::ranges::any_of(
      run->effects, [](const EffectRow& effect) { return effect.cumulative_change.has_value(); });
}

std::string effects_title(const Run& run) {
  std::string active;
  std::size_t inactive = 0;
  for (const EffectRow& effect : run.effects) {
    if (effect.active) add_item(active, replace_separators(effect.name));
    if (effect.applicable && !effect.active) ++inactive;
  }
  return "Computed with " + (active.empty() ? "bending alone" : active) + "; " +
         count(inactive, "other effect was left out", "other effects were left out");
}

TextTable effects_table(const Run& run) {
  TextTable table{effects_title(run),
                  {"Effect", "State", ">Dimensionless number", "=Definition", ">Change without it",
                   ">Cumulative change", "Reason"}};
  const auto change = [](Number x) { return x ? percent_text(*x, 3, false) : ""; };
  for (const EffectRow& e : run.effects) {
    if (!e.applicable) continue;
    table.rows.push_back({replace_separators(e.name), e.active ? "on" : "off",
                          e.dimensionless_number ? trimmed(*e.dimensionless_number, 3) : "",
                          e.number_definition, change(e.own_change), change(e.cumulative_change),
                          e.why});
  }
  return table;
}

}  // namespace

Data variant_tables(const CaseInfo& info, const std::vector<const Run*>& runs) {
  return list_of(info.tables, [&](const TableRequest& request) {
    return table_data(variant_table(request, info, runs));
  });
}

void set_run_tables(Data& data, const CaseInfo& info, const std::vector<const Run*>& runs) {
  Data errors = list(), probabilities = list(), effects(false), uncertainty(false), inputs(false);
  if (!info.inputs.empty()) inputs = table_data(inputs_table(info));
  std::vector<std::string> excluded;
  const TextTable comparisons = uncertainty_table(info, runs);
  if (!comparisons.rows.empty()) uncertainty = table_data(comparisons);
  const auto chosen = std::ranges::find_if(runs, selects_effects);
  if (chosen != runs.end()) effects = table_data(effects_table(**chosen));
  for (const Run* run : runs) {
    if (info.file.empty() && !run->errors) continue;
    TextTable table{"Results" + (runs.size() > 1 ? ": " + info.variant_title(run->variant) : ""),
                    {"Quantity", "Values", ">Largest error"},
                    {},
                    run->errors ? run->errors->companions : ""};
    for (const auto& [name, quantity] : run->quantities)
      if (!quantity.values.empty() && !harness::is_error_measure(name))
        table.rows.push_back(
            result_row(name, quantity.values, run->errors ? run->errors->find(name) : nullptr));
    if (!table.rows.empty()) errors.push_back(table_data(table));
  }
  for (const Run* run : runs) {
    if (!run->model_probabilities) continue;
    for (const RowProbabilities& row : run->model_probabilities->rows)
      probabilities.push_back(table_data(probability_table(row, run->variant)));
    for (const ExcludedReadings& readings : run->model_probabilities->excluded)
      excluded.push_back(count(static_cast<std::size_t>(readings.readings), "combination") +
                         ", as " + readings.first + ": " + readings.reason);
  }
  set(data, {{"errors", errors},
             {"inputs", inputs},
             {"effects", effects},
             {"uncertainty", uncertainty},
             {"has_probabilities", probabilities.is_non_empty_list()},
             {"probabilities", object({{"tables", probabilities}})},
             {"has_excluded", !excluded.empty()},
             {"excluded", texts(excluded)}});
}

}  // namespace trammel::reports
