#include "harness/cli/command_compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "harness/base/errors.h"
#include "harness/base/json_file.h"
#include "harness/base/statistic.h"
#include "harness/base/table.h"
#include "harness/base/text.h"
#include "harness/input/catalogue.h"
#include "harness/input/schema.h"
#include "harness/results/results.h"
#include "harness/run/cost_results.h"
#include "harness/run/run.h"
#include "harness/run/stored_results.h"
#include "harness/studies/mode_match.h"

namespace trammel::harness {
namespace {

using Named = std::map<std::string, std::vector<double>>;

/// One side of a comparison of two variants.
struct Side {
  std::string label;
  Document document;
  AnalysisResult result;
};

Side side_loads(const std::string& name) {
  // A colon in a file's own name is no variant.
  const auto colon = name.rfind(':');
  const bool split =
      colon != std::string::npos && name.find('/', colon) == std::string::npos && colon > 0;
  const Case given = load_named_case(split ? name.substr(0, colon) : name);
  const std::string variant = split ? name.substr(colon + 1) : kBaseVariant;
  return {given.id() + ":" + variant, patched(given, variant), solution_of(given, variant)};
}

Named numbers_of(const Quantities& quantities) {
  Named named;
  for (const auto& [name, quantity] : quantities) named[name] = quantity.values;
  return named;
}

/// Values below this share of the largest of their series are zeros but for round-off.
constexpr double kRoundoff = 1e-9;

/// By how much b differs from a, relative to a; nothing where a is zero.
/// @param scale  the largest value of the series
std::string percent_change(double a, double b, double scale) {
  if (!(std::abs(a) > kRoundoff * scale) || !std::isfinite(b)) return "";
  return fmt::format("{:+.3g}", 100 * ((b - a) / std::abs(a)));
}

/// What a quantity's values are compared with: all of its unit, but poses with poses, and numbers
/// without a unit with themselves.
std::string series_of(const std::string& name) {
  const std::string unit = unit_of(name), head = name.substr(0, name.find(':'));
  return unit == "1" || head.rfind("pose_", 0) == 0 ? head : unit;
}

/// The largest magnitude of each series on either side.
std::map<std::string, double> series_scales(const Named& a, const Named& b) {
  std::map<std::string, double> scales;
  for (const Named* side : {&a, &b})
    for (const auto& [name, values] : *side) {
      double& scale = scales[series_of(name)];
      for (const double value : values)
        if (std::isfinite(value)) scale = std::max(scale, std::abs(value));
    }
  return scales;
}

/// The rows of a quantity: all of a few values, of many the one that differs most.
void add_rows(const std::string& name, const std::vector<double>& a, const std::vector<double>& b,
              double scale, Table& table) {
  if (a.size() != b.size()) {
    table.add({name, "", std::to_string(a.size()) + " entries",
               std::to_string(b.size()) + " entries", "", ""});
    return;
  }
  const std::size_t worst = largest_difference(a, b, [](std::size_t) { return 1.0; }).index;
  const std::size_t first = a.size() <= 6 ? 0 : worst;
  const std::size_t last = a.size() <= 6 ? a.size() : std::min(a.size(), worst + 1);
  for (std::size_t i = first; i < last; ++i) {
    table.add({i == first ? name : "", a.size() > 1 ? std::to_string(i) : "", rounded(a[i], 10),
               rounded(b[i], 10), rounded(b[i] - a[i], 3), percent_change(a[i], b[i], scale)});
  }
}

void print_quantities(const Named& a, const Named& b, const std::string& label_a,
                      const std::string& label_b) {
  Table table({"quantity", ">index", ">" + label_a, ">" + label_b, ">difference", ">percent"});
  const std::map<std::string, double> scales = series_scales(a, b);
  for (const auto& [name, values] : a) {
    const auto other = b.find(name);
    if (other != b.end()) add_rows(name, values, other->second, scales.at(series_of(name)), table);
  }
  table.print(std::cout);
  for (const auto& [one, other, label] :
       {std::tuple(&a, &b, &label_a), std::tuple(&b, &a, &label_b)}) {
    std::vector<std::string> alone;
    for (const auto& item : *one) {
      if (other->count(item.first) == 0) alone.push_back(item.first);
    }
    if (!alone.empty()) {
      std::cout << wrapped("Only in " + *label + ": " + join(alone, "and"), "");
    }
  }
}

std::string mode_numbers(const std::vector<std::size_t>& set) {
  std::vector<std::string> numbers;
  for (const std::size_t i : set) numbers.push_back(std::to_string(i + 1));
  return join(numbers, "and");
}

void print_modes(const Side& a, const Side& b) {
  const auto [modes_a, modes_b] = sample_modes(a.document, b.document);
  const std::size_t count = a.result.quantities.at("frequency_Hz").values.size();
  Table table(
      {">mode", ">" + a.label + " [Hz]", ">mode", ">" + b.label + " [Hz]", ">percent", ">alike"});
  for (const ModeMatch& match : match_modes(modes_a, modes_b)) {
    if (match.a.front() >= count) break;
    const double fa = modes_a.frequency[match.a.front()];
    if (match.b.empty()) {
      table.add({mode_numbers(match.a), rounded(fa, 8), "-", "no mode looks alike", "", ""});
      continue;
    }
    const double fb = modes_b.frequency[match.b.front()];
    const double last = modes_b.frequency[match.b.back()];
    const bool parted = last - fb > 1e-6 * last;
    table.add({mode_numbers(match.a), rounded(fa, 8), mode_numbers(match.b),
               rounded(fb, 8) + (parted ? " to " + rounded(last, 8) : ""),
               percent_change(fa, fb, modes_a.frequency.back()), rounded(match.overlap, 4)});
  }
  table.print(std::cout);
  std::cout << "alike: 1 for the same shape (modal assurance criterion; of repeated modes the\n"
               "subspaces are compared)\n";
}

bool is_json_file(const std::filesystem::path& file) {
  std::error_code error;
  return file.extension() == ".json" && std::filesystem::is_regular_file(file, error);
}

/// What a file holds, read once; null for a case of the catalogue.
Json contents(const std::string& name) {
  return is_json_file(name) ? read_json(name) : Json();
}

bool is_results(const Json& json) {
  return json.is_object() && json.contains("format") && json.contains("runs");
}

/// Why something cannot be compared with a results file.
[[noreturn]] void refuse_beside_results(const std::string& name, const Json& json) {
  if (!is_json_file(name)) (void)Catalogue().find_case(name.substr(0, name.rfind(':')));
  if (json.is_object() && !json.contains("model") && !json.contains("analysis")) {
    const auto schema_error = find_schema_fault(json, "results");
    if (schema_error) throw InputError(name, schema_error->pointer, schema_error->message);
  }
  throw InputError("expected two variants or two result files (got one of each)");
}

/// "case:variant" -> quantities of a results file.
std::map<std::string, Named> named_runs(const results::Results& results) {
  std::map<std::string, Named> runs;
  for (const results::Run& run : results.runs) {
    Named& named = runs[run.case_id + ":" + run.variant];
    for (const auto& [name, values] : run.quantities)
      for (const results::Number& value : values)
        named[name].push_back(value.value_or(std::nan("")));
  }
  return runs;
}

/// Only what differs, bit for bit.
std::pair<Named, Named> differing(const Named& a, const Named& b) {
  std::pair<Named, Named> left{a, b};
  for (const auto& [name, values] : a) {
    const auto other = b.find(name);
    const bool same =
        other != b.end() && values.size() == other->second.size() &&
        std::equal(values.begin(), values.end(), other->second.begin(),
                   [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
    if (!same) continue;
    left.first.erase(name);
    left.second.erase(name);
  }
  return left;
}

/// The points of a study by the titles of its settings.
std::vector<CostPoint> named_points(const results::CostStudy& study,
                                    std::vector<std::string>& titles) {
  std::vector<CostPoint> points = cost_points(study);
  for (CostPoint& point : points) {
    const std::string& title = study.settings[point.setting].title;
    const auto known = std::find(titles.begin(), titles.end(), title);
    point.setting = static_cast<std::size_t>(known - titles.begin());
    if (known == titles.end()) titles.push_back(title);
  }
  return points;
}

/// How near two measurements of the same studies come.
void compare_costs(const results::Results& a, const results::Results& b) {
  if (!a.cost || !b.cost) return;
  Table table({"study", ">on both fronts", ">of", ">same cheapest", ">of", ">median", ">largest"});
  const results::CostStudies& others = *b.cost;
  for (const results::CostStudy& study : a.cost->studies) {
    const auto other =
        std::find_if(others.studies.begin(), others.studies.end(),
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

int compare_results(const std::string& file_a, const std::string& file_b) {
  const results::Results a_side = load_results(file_a), b_side = load_results(file_b);
  for (const auto& [file, side] : {std::pair(&file_a, &a_side), std::pair(&file_b, &b_side)})
    if (!side->missing.empty()) std::cerr << *file << ": " << side->missing << '\n';
  const auto runs_a = named_runs(a_side), runs_b = named_runs(b_side);
  std::size_t same = 0, different = 0;
  for (const auto& [name, a] : runs_a) {
    const auto b = runs_b.find(name);
    if (b == runs_b.end()) {
      std::cout << name << ": only in " << file_a << '\n';
      continue;
    }
    const auto [left, right] = differing(a, b->second);
    if (left.empty() && right.empty()) {
      ++same;
      continue;
    }
    ++different;
    std::cout << name << '\n';
    print_quantities(left, right, "a", "b");
  }
  for (const auto& item : runs_b) {
    if (runs_a.count(item.first) == 0) std::cout << item.first << ": only in " << file_b << '\n';
  }
  std::cout << same << " runs are the same bit for bit, " << different << " differ\n";
  compare_costs(a_side, b_side);
  return 0;
}

}  // namespace

int compare_command(const std::string& a, const std::string& b) {
  const Json json_a = contents(a), json_b = contents(b);
  const bool results_a = is_results(json_a);
  if (results_a != is_results(json_b)) {
    results_a ? refuse_beside_results(b, json_b) : refuse_beside_results(a, json_a);
  }
  if (results_a) return compare_results(a, b);
  const Side side_a = side_loads(a), side_b = side_loads(b);
  if (analysis_kind(side_a.document) != analysis_kind(side_b.document)) {
    throw InputError("expected two variants of one kind of analysis (got " +
                     analysis_kind(side_a.document) + " and " + analysis_kind(side_b.document) +
                     ")");
  }
  if (analysis_kind(side_a.document) == "modes" &&
      side_a.result.quantities.count("frequency_Hz") > 0 &&
      side_b.result.quantities.count("frequency_Hz") > 0) {
    print_modes(side_a, side_b);
    return 0;
  }
  print_quantities(numbers_of(side_a.result.quantities), numbers_of(side_b.result.quantities),
                   side_a.label, side_b.label);
  return 0;
}

}  // namespace trammel::harness
