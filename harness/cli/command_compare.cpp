#include "harness/cli/command_compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>
#include <set>
#include <utility>

#include "harness/base/errors.h"
#include "harness/base/json_file.h"
#include "harness/base/processes.h"
#include "harness/base/table.h"
#include "harness/base/text.h"
#include "harness/cli/command_line.h"
#include "harness/input/catalogue.h"
#include "harness/input/schema.h"
#include "harness/run/compare_sides.h"
#include "harness/run/cost_results.h"
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

/// Case and variant of a name; a colon in a file's own name is no variant.
std::pair<std::string, std::string> parted(const std::string& name) {
  const auto colon = name.rfind(':');
  const bool split =
      colon != std::string::npos && name.find('/', colon) == std::string::npos && colon > 0;
  return {split ? name.substr(0, colon) : name, split ? name.substr(colon + 1) : ""};
}

/// Computes one variant, without its refinements.
Side side_of(const Case& given, const std::string& variant) {
  const References references;
  RunOptions options;
  options.variant = variant;
  options.memory_bytes = memory_limit_bytes();
  options.studies = false;
  const std::vector<Run> runs = run_shown({given}, references, options);
  require_solved(runs.front());
  return {given.id() + ":" + variant, results_of(runs, {given}, references),
          patched(given, variant)};
}

bool is_json_file(const fs::path& file) {
  std::error_code error;
  return file.extension() == ".json" && fs::is_regular_file(file, error);
}

/// The results that a name means, read once.
std::optional<Side> stored_side(const std::string& name) {
  std::error_code error;
  if (fs::is_directory(name, error))
    return Side{name, read_summary(fs::path(name) / "results.json"), std::nullopt};
  if (!is_json_file(name)) return std::nullopt;
  Json json = read_json(name);
  if (!json.is_object() || !json.contains("format") || !json.contains("runs")) return std::nullopt;
  return Side{name, read_summary(name, std::move(json)), std::nullopt};
}

/// Why something cannot be compared with results.
[[noreturn]] void refuse_beside_results(const std::string& name) {
  if (!is_json_file(name)) (void)Catalogue().find_case(parted(name).first);
  const Json json = is_json_file(name) ? read_json(name) : Json();
  if (json.is_object() && !json.contains("model") && !json.contains("analysis")) {
    const auto schema_error = find_schema_fault(json, "results");
    if (schema_error) throw InputError(name, schema_error->pointer, schema_error->message);
  }
  throw InputError("expected variants alone or results alone (got both)");
}

std::vector<Side> sides_of_cases(const std::vector<std::string>& names) {
  std::vector<Side> sides;
  for (const std::string& name : names) {
    const auto [file, chosen] = parted(name);
    const Case given = load_named_case(file);
    std::vector<std::string> variants = {chosen.empty() ? kBaseVariant : chosen};
    if (names.size() == 1 && chosen.empty()) variants = given.variants();
    for (const std::string& variant : variants) {
      try {
        sides.push_back(side_of(given, variant));
      } catch (const InputError& error) {
        if (variants.size() == 1) throw;
        std::cerr << one_line(error.what()) << "; left out\n";
        continue;
      }
      const std::string own = analysis_kind(*sides.back().document),
                        first = analysis_kind(*sides.front().document);
      if (own != first)
        throw InputError("expected variants of one kind of analysis (got " + first + " and " + own +
                         ")");
    }
  }
  if (sides.size() < 2) throw InputError("expected two sides (got one: it has no variants)");
  std::set<std::string> cases;
  for (const Side& side : sides) cases.insert(parted(side.label).first);
  if (cases.size() == 1)
    for (Side& side : sides) side.label = parted(side.label).second;
  return sides;
}

std::vector<Side> sides_of(const std::vector<std::string>& names) {
  std::vector<Side> sides;
  std::vector<std::string> others;
  for (const std::string& name : names) {
    if (std::optional<Side> side = stored_side(name)) {
      sides.push_back(std::move(*side));
    } else {
      others.push_back(name);
    }
  }
  if (sides.empty()) return sides_of_cases(names);
  if (!others.empty()) refuse_beside_results(others.front());
  if (sides.size() < 2) throw InputError("expected two results (got one)");
  return sides;
}

std::string percent_text(const Number& percent) {
  return percent ? rounded(*percent, 3) : "";
}

std::string share_text(const Number& share) {
  return share ? percent_text(100 * *share) : "";
}

/// Time beside accuracy.
void print_sides(const SideComparison& comparison) {
  const bool errors = comparison.sides.front().median_error.has_value();
  Table table(errors
                  ? std::vector<std::string>{"side", ">runs", ">time [s]", ">of first", ">work",
                                             ">error [%]", ">largest [%]", ">rank", ">over best"}
                  : std::vector<std::string>{"side", ">runs", ">time [s]", ">of first", ">work"});
  for (const ComparedSide& side : comparison.sides) {
    std::vector<std::string> row = {side.label, std::to_string(side.runs), rounded(side.cpu_s, 3),
                                    side.relative_time ? rounded(*side.relative_time, 3) : "",
                                    std::to_string(side.work)};
    if (errors) {
      const auto& ratio = side.error_ratio;
      const std::string over = ratio.empty() || !ratio[0]
                                   ? ""
                                   : fmt::format("{:.3g} ({:.3g} to {:.3g})", *ratio[0],
                                                 ratio[1].value_or(NAN), ratio[2].value_or(NAN));
      for (const std::string& cell : {share_text(side.median_error), share_text(side.largest_error),
                                      std::to_string(side.rank), over})
        row.push_back(cell);
    }
    table.add(row);
  }
  table.print(std::cout);
  if (errors)
    std::cout << "error: median against references; over best: with an interval of 98 %, within "
                 "which\nsides share a rank\n";
}

std::string mode_numbers(const std::vector<std::size_t>& set) {
  std::vector<std::string> numbers;
  for (const std::size_t number : set) numbers.push_back(std::to_string(number));
  return join(numbers, "and");
}

/// A table of what the first side has, and of cells for each further one: beside it where there are
/// few, else below it.
class SidesTable {
 public:
  /// @param cells  heads of a side's cells; of the first side the first of them alone
  SidesTable(std::vector<std::string> first, std::vector<std::string> cells,
             const SideComparison& comparison)
      : comparison_(comparison), below_(comparison.sides.size() > kBeside) {
    width_ = cells.size();
    blank_.resize(first.size());
    if (below_) first.emplace_back("side");
    for (std::size_t s = 0; s < (below_ ? 1 : comparison.sides.size()); ++s) {
      if (!below_) cells.front() = ">" + comparison.sides[s].label;
      const bool value_alone = s == 0 && !below_;
      first.insert(first.end(), cells.begin(), value_alone ? cells.begin() + 1 : cells.end());
    }
    table_ = Table(first);
  }

  /// @param cells  of each side
  void add(std::vector<std::string> first, std::vector<std::vector<std::string>> cells) {
    if (!below_) {
      cells.front().resize(1);
      for (const auto& own : cells) first.insert(first.end(), own.begin(), own.end());
      return table_.add(first);
    }
    for (std::size_t s = 0; s < cells.size(); ++s) {
      std::vector<std::string> row = s == 0 ? first : blank_;
      row.push_back(comparison_.sides[s].label);
      cells[s].resize(width_);
      row.insert(row.end(), cells[s].begin(), cells[s].end());
      table_.add(row);
    }
  }

  void print() const {
    if (!table_.empty()) table_.print(std::cout);
  }

 private:
  static constexpr std::size_t kBeside = 4;
  const SideComparison& comparison_;
  bool below_;
  std::size_t width_ = 0;
  std::vector<std::string> blank_;
  Table table_{{}};
};

void print_modes(const ComparedRun& run, const SideComparison& comparison) {
  if (run.modes.empty()) return;
  SidesTable table({">mode"}, {">Hz", ">mode", ">percent", ">alike"}, comparison);
  for (const results::ComparedModes& found : run.modes) {
    std::vector<std::vector<std::string>> cells;
    for (std::size_t s = 0; s < found.values.size(); ++s) {
      if (!found.values[s]) {
        cells.push_back({"no mode looks alike", "-", "", ""});
        continue;
      }
      const std::string last = found.last[s] ? " to " + rounded(*found.last[s], 8) : "";
      cells.push_back({rounded(*found.values[s], 8) + last, mode_numbers(found.modes[s]),
                       percent_text(found.percent[s]), rounded(*found.alike[s], 4)});
    }
    table.add({mode_numbers(found.modes[0])}, cells);
  }
  table.print();
  std::cout << "[Hz]; alike: 1 for the same shape (modal assurance criterion; of repeated modes\n"
               "the subspaces are compared)\n";
}

void print_numbers(const ComparedRun& run, const SideComparison& comparison) {
  SidesTable table({"quantity", ">index"}, {">value", ">percent"}, comparison);
  std::set<std::string> same;
  for (const ComparedNumber& number : run.numbers) {
    if (!number.changed) {
      same.insert(number.quantity);
      continue;
    }
    std::vector<std::vector<std::string>> cells;
    for (std::size_t s = 0; s < number.values.size(); ++s) {
      // What is nothing but round-off is a zero.
      const double value = number.values[s].value_or(NAN);
      cells.push_back({rounded(std::abs(value) <= number.noise ? 0 : value, 10),
                       percent_text(number.percent[s])});
    }
    table.add({number.quantity, number.entries > 1 ? std::to_string(number.index) : ""}, cells);
  }
  table.print();
  for (const ComparedNumber& number : run.numbers)
    if (number.changed) same.erase(number.quantity);
  if (!same.empty())
    std::cout << wrapped("Within round-off: " + join({same.begin(), same.end()}, "and"), "");
  for (const std::string& remark : run.remarks) std::cout << wrapped(remark, "");
}

void print(const SideComparison& comparison) {
  std::cout << wrapped(comparison.conclusion, "");
  print_sides(comparison);
  const bool several = comparison.same + comparison.within_noise + comparison.changed > 1;
  for (const ComparedRun& run : comparison.runs) {
    if (several && !run.changed) continue;
    if (several) std::cout << '\n' << run.name << '\n';
    print_modes(run, comparison);
    print_numbers(run, comparison);
  }
}

void print_csv(const SideComparison& comparison) {
  std::cout << "run,quantity,index,changed,noise";
  for (const ComparedSide& side : comparison.sides)
    std::cout << ',' << csv_cell(side.label) << ',' << csv_cell(side.label + " [%]");
  std::cout << "\n";
  const auto line = [&](const std::string& run, const std::string& quantity,
                        const std::string& index, const results::ComparedValue& value) {
    const auto cell = [](const Number& number) { return number ? shortest(*number) : ""; };
    std::cout << csv_cell(run) << ',' << csv_cell(quantity) << ',' << index << ','
              << (value.changed ? "true," : "false,") << shortest(value.noise);
    for (std::size_t s = 0; s < value.values.size(); ++s)
      std::cout << ',' << cell(value.values[s]) << ',' << cell(value.percent[s]);
    std::cout << "\n";
  };
  for (const ComparedRun& run : comparison.runs) {
    for (const results::ComparedModes& found : run.modes)
      line(run.name, "frequency_Hz", std::to_string(found.modes[0].front() - 1), found);
    for (const ComparedNumber& number : run.numbers)
      line(run.name, number.quantity, std::to_string(number.index), number);
  }
}

/// The points of a study by the titles of its settings.
std::vector<CostPoint> named_points(const results::CostStudy& study,
                                    std::vector<std::string>& titles) {
  std::vector<CostPoint> points = cost_points(study);
  for (CostPoint& point : points) {
    const std::string& title = study.settings[point.setting].title;
    const auto known = std::ranges::find(titles, title);
    point.setting = static_cast<std::size_t>(known - titles.begin());
    if (known == titles.end()) titles.push_back(title);
  }
  return points;
}

/// How near two measurements of the same studies come.
void print_costs(const results::Results& a, const results::Results& b) {
  if (!a.cost || !b.cost) return;
  Table table({"study", ">on both fronts", ">of", ">same cheapest", ">of", ">median", ">largest"});
  const results::CostStudies& others = *b.cost;
  for (const results::CostStudy& study : a.cost->studies) {
    const auto other = std::ranges::find_if(
        others.studies,
        [&](const results::CostStudy& candidate) { return candidate.id == study.id; });
    if (other == others.studies.end()) continue;
    std::vector<std::string> titles;
    const std::vector<CostPoint> points_a = named_points(study, titles);
    const ParetoFrontAgreement both = compare_pareto_fronts(points_a, named_points(*other, titles));
    table.add({study.id, std::to_string(both.shared), std::to_string(both.either),
               std::to_string(both.same_cheapest), std::to_string(both.targets),
               rounded(100 * both.median_difference, 2) + " % apart",
               rounded(100 * both.largest_difference, 2) + " %"});
  }
  if (table.empty()) return;
  std::cout << "accuracy and computing time: settings on the Pareto fronts, the cheapest setting "
               "for each\n"
               "target error, and the difference of the time that an accuracy takes\n";
  table.print(std::cout, "  ");
}

}  // namespace

int compare_command(const CompareCommand& command, const Renderers& renderers) {
  if (!command.html.empty()) require_drawing(renderers);
  std::vector<Side> sides = sides_of(command.sides);
  const bool table = !command.json && !command.csv;
  std::vector<results::Results> costs;
  for (const Side& side : sides) {
    costs.emplace_back();
    costs.back().cost = side.results.cost;
  }
  const SideComparison comparison = compare_sides(std::move(sides), !command.html.empty());
  if (command.json) std::cout << pretty(to_json(comparison));
  if (command.csv) print_csv(comparison);
  if (table) print(comparison);
  for (std::size_t s = 1; table && s < costs.size(); ++s) print_costs(costs.front(), costs[s]);
  if (!command.html.empty()) renderers.comparison(comparison, command.html);
  return command.gate && comparison.changed > 0 ? 1 : 0;
}

}  // namespace trammel::harness
