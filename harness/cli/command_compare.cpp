#include <cmath>
#include <iostream>
#include <optional>
#include <set>
#include <utility>

#include "harness/base/errors.h"
#include "harness/base/json_file.h"
#include "harness/base/rows.h"
#include "harness/base/text.h"
#include "harness/cli/commands.h"
#include "harness/input/catalogue.h"
#include "harness/results/result_fields.h"
#include "harness/run/diff.h"
#include "harness/run/results.h"
#include "harness/run/run.h"
#include "harness/run/stored_results.h"

namespace trammel::harness {
namespace {

namespace fs = std::filesystem;
using results::ComparedNumber;
using results::ComparedRun;
using results::ComparedSide;
using results::Number;
using results::SideComparison;

/// Table heading of estimated discretization errors.
constexpr const char* kErrorHead = "+- [%]";

/// Computes one variant of a case, without the refinement sweeps of the case.
Side side_of(const Case& given, const std::string& variant) {
  const References references;
  const std::vector<Run> runs = run_with_progress(
      {given}, references,
      {.variant = variant, .memory_bytes = memory_limit_bytes(), .studies = false});
  require_solved(runs.front());
  return {given.id() + ":" + variant, collect_results(runs, {given}, references),
          patched(given, variant)};
}

std::vector<Side> compute_case_sides(const std::vector<std::string>& names) {
  std::vector<Side> sides;
  for (const std::string& name : names) {
    const auto [given, chosen] = load_case_variant(name);
    std::vector<std::string> variants = {chosen.empty() ? kBaseVariant : chosen};
    if (names.size() == 1 && chosen.empty()) variants = given.variants();
    for (const std::string& variant : variants) {
      try {
        sides.push_back(side_of(given, variant));
      } catch (const InputError& error) {
        if (variants.size() == 1) throw;
        std::cerr << one_line(error.what()) << "; skipped\n";
        continue;
      }
      const std::string own = analysis_kind(*sides.back().document),
                        first = analysis_kind(*sides.front().document);
      if (own != first)
        throw InputError("expected variants with the same analysis (got " + first + " and " + own +
                         "); select them as CASE:VARIANT");
    }
  }
  if (sides.size() < 2)
    throw InputError("expected at least two variants or cases (got one case without variants)");
  std::set<std::string> cases;
  for (const Side& side : sides) cases.insert(split_case_name(side.label).first);
  if (cases.size() == 1)
    for (Side& side : sides) side.label = split_case_name(side.label).second;
  return sides;
}

/// Returns the results to be compared (sides): contents of results files, each read once, or
/// results of cases that are computed.
std::vector<Side> load_or_compute_results(const std::vector<std::string>& names) {
  std::vector<Side> sides;
  std::vector<std::string> others;
  for (const std::string& name : names) {
    const fs::path file = results_file_path(name);
    if (Json json = read_json_if_results(file); !json.is_null()) {
      sides.push_back({name, read_results_json(file, std::move(json)), std::nullopt});
    } else {
      others.push_back(name);
    }
  }
  if (sides.empty()) return compute_case_sides(names);
  if (!others.empty()) {
    (void)load_named_case(split_case_name(others.front()).first);  // throws if no such case exists
    throw InputError("expected either cases or results files (got both)");
  }
  if (sides.size() < 2) throw InputError("expected at least two results files (got one)");
  return sides;
}

/// Prints the computing time and the accuracy of each compared set of results (side).
void print_compared_sides(const SideComparison& comparison) {
  std::vector<Column> columns = {{"label", "result"},
                                 {"runs"},
                                 {"cpu_s", "time [s]", 3},
                                 {"relative_time", "of first", 3},
                                 {"work"}};
  const bool errors = comparison.sides.front().median_error.has_value();
  if (errors)
    columns.insert(columns.end(), {{"median_error", "error [%]", 3, 100},
                                   {"largest_error", "largest [%]", 3, 100}});
  Rows(columns, to_json(comparison)["sides"]).print(std::cout);
  if (errors) std::cout << "error: deviation from references; median over all references\n";
}

/// Returns the discretization error of a value [%], or null without an estimate.
Json error_percent(const results::ComparedValue& value, std::size_t side) {
  const Number error = value.errors[side], number = value.values[side];
  return error && number && *number != 0 ? Json(100 * *error / std::abs(*number)) : Json();
}

void print_modes(const ComparedRun& run, const SideComparison& comparison) {
  if (run.modes.empty()) return;
  Rows table({"mode",
              "result",
              "modes",
              {"Hz", "", 8},
              {"percent", "", 3},
              {kErrorHead, "", 2},
              {"alike", "", 4}});
  for (const results::ComparedModes& modes : run.modes)
    for (std::size_t s = 0; s < modes.values.size(); ++s) {
      Json frequencies = Json::array({number_or_null(modes.values[s])});
      if (modes.last[s]) frequencies.push_back(*modes.last[s]);
      table.add({s == 0 ? Json(modes.modes[0]) : Json(), comparison.sides[s].label,
                 modes.modes[s].empty() ? Json("no mode of similar shape") : Json(modes.modes[s]),
                 frequencies, number_or_null(modes.percent[s]), error_percent(modes, s),
                 number_or_null(modes.alike[s])});
    }
  table.print(std::cout);
  std::cout << "alike: 1 for the same shape (modal assurance criterion; for repeated modes, the\n"
               "subspaces are compared)\n";
}

/// Adds three columns for each compared set of results (side): the value, its difference from the
/// value of the first side [%], and its discretization error [%].
std::vector<Column> append_columns(std::vector<Column> columns, const SideComparison& comparison) {
  for (const ComparedSide& side : comparison.sides) {
    columns.emplace_back(side.label.c_str(), "", 10);
    columns.emplace_back((side.label + " [%]").c_str(), "", 3);
    columns.emplace_back((side.label + " " + kErrorHead).c_str(), kErrorHead, 2);
  }
  return columns;
}

void add_row(std::vector<Json> cells, const results::ComparedValue& value, Rows& rows) {
  for (std::size_t s = 0; s < value.values.size(); ++s) {
    cells.push_back(number_or_null(value.values[s]));
    cells.push_back(number_or_null(value.percent[s]));
    cells.push_back(error_percent(value, s));
  }
  rows.add(std::move(cells));
}

void print_compared_numbers(const ComparedRun& run, const SideComparison& comparison) {
  Rows table(append_columns({"quantity", "index"}, comparison));
  std::set<std::string> same, changed;
  for (ComparedNumber number : run.numbers) {
    (number.changed ? changed : same).insert(number.quantity);
    if (!number.changed) continue;
    for (Number& value : number.values)
      if (value && std::abs(*value) <= number.noise) value = 0;  // within round-off error
    add_row({number.quantity, number.entries > 1 ? Json(number.index) : Json()}, number, table);
  }
  if (!table.empty()) table.print(std::cout);
  std::erase_if(same, [&](const std::string& name) { return changed.count(name) > 0; });
  if (!same.empty())
    std::cout << wrapped("Equal up to round-off: " + join({same.begin(), same.end()}, "and"), "");
  for (const std::string& remark : run.remarks) std::cout << wrapped(remark, "");
}

void print(const SideComparison& comparison) {
  std::cout << wrapped(comparison.conclusion, "");
  print_compared_sides(comparison);
  const bool several = comparison.same + comparison.within_noise + comparison.changed > 1;
  for (const ComparedRun& run : comparison.runs) {
    if (several && !run.changed) continue;
    if (several) std::cout << '\n' << run.name << '\n';
    print_modes(run, comparison);
    print_compared_numbers(run, comparison);
  }
}

std::string csv(const SideComparison& comparison) {
  Rows rows(append_columns({"run", "quantity", "index", "changed", "noise"}, comparison));
  for (const ComparedRun& run : comparison.runs) {
    for (const results::ComparedModes& modes : run.modes)
      add_row({run.name, "frequency_Hz", modes.modes[0].front() - 1, modes.changed, modes.noise},
              modes, rows);
    for (const ComparedNumber& number : run.numbers)
      add_row({run.name, number.quantity, number.index, number.changed, number.noise}, number,
              rows);
  }
  return rows.csv();
}

}  // namespace

fs::path results_file_path(const std::string& name) {
  return fs::is_directory(name) ? fs::path(name) / "results.json" : fs::path(name);
}

Json read_json_if_results(const fs::path& file) {
  if (file.extension() != ".json") return nullptr;
  Json json = read_json(file);
  const bool is_results = json.is_object() && json.contains("format") && json.contains("runs");
  return is_results ? json : Json();
}

int compare_command(const CommandOptions& options, const Renderers& renderers) {
  if (!options.html.empty()) require_gnuplot(renderers);
  std::vector<Side> sides = load_or_compute_results(options.words);
  const SideComparison comparison = compare_sides(std::move(sides), !options.html.empty());
  if (options.json) {
    std::cout << format_json(to_json(comparison));
  } else if (options.csv) {
    std::cout << csv(comparison);
  } else {
    print(comparison);
  }
  if (!options.html.empty()) renderers.comparison(comparison, options.html);
  return options.gate && comparison.changed > 0 ? 1 : 0;
}

}  // namespace trammel::harness
