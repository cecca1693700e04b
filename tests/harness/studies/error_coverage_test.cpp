// ctest: labels=slow timeout=7200
// Compares estimated discretization errors with true errors over the catalogue.
#include <array>
#include <boost/test/unit_test.hpp>
#include <fstream>
#include <map>
#include <numeric>
#include <ranges>
#include <set>

#include "harness/analysis/coarse_scene.h"
#include "harness/base/environment.h"
#include "harness/base/processes.h"
#include "harness/base/statistic.h"
#include "harness/base/stopwatch.h"
#include "harness/base/text.h"
#include "harness/base/timing.h"
#include "harness/input/catalogue.h"
#include "harness/studies/accuracy_search.h"
#include "solver/linear/system.h"

BOOST_AUTO_TEST_SUITE(error_coverage)

using namespace trammel;
using namespace trammel::harness;

namespace {

constexpr double kLongest_s = 3;  // limit of processor time for the finer levels
constexpr int kFinerLevels = 3, kMostVariants = 4, kMostSamples = 50000;
constexpr double kKnown = 0.3;  // limit of the relative uncertainty of a true error

/// Doubles the number of samples, because the largest value of a motion can be between two samples.
void add_samples(Document& document) {
  const std::string place = analysis_pointer(document);
  const Json& motion = document.value().at(JsonPointer(place));
  if (inner_analysis_kind(document) != "transient" || !motion.contains("step_s")) return;
  const double steps = motion.at("duration_s").get<double>() / motion.at("step_s").get<double>();
  const int samples = motion.value("samples", static_cast<int>(std::ceil(std::min(steps, 1e4))));
  if (samples <= kMostSamples)
    document.apply_patch("samples", "",
                         patch_setting_value(document.value(), place + "/samples", 2 * samples));
}

/// Returns the results on the given level and on up to three finer levels of mesh and step.
std::vector<AnalysisResult> finer_levels(Document document, AnalysisResult own,
                                         const References& references) {
  std::vector<AnalysisResult> levels = {std::move(own)};
  const Stopwatch watch;
  for (double before = 0; levels.size() <= kFinerLevels; before = watch.cpu_s()) {
    add_samples(document);
    for (const ErrorSource source : {ErrorSource::mesh, ErrorSource::step})
      if (const auto finer =
              adjacent_refinement_level(document, source, Refine::finer, &levels.back()))
        document = finer->document;
    try {
      document.validate("case");
      levels.push_back(analyze(document, references, {true}));
    } catch (const InputError&) {  // such as too many elements
      break;
    }
    if (!levels.back().outcome.solved()) {
      levels.pop_back();
      break;
    }
    if (watch.cpu_s() + 4 * (watch.cpu_s() - before) > kLongest_s) break;
  }
  return levels;
}

double work_of(const Document& document, const References& references) {
  const solver::Model model = model_at_path_start(read_case_model(document));
  const bool is_linear = inner_analysis_kind(document) != "large-motion";  // else K is undefined
  const double unknowns = is_linear ? 1.0 * solver::assemble(model).K.rows() : unknown_count(model);
  return estimated_work(analyze(document, references, {}).counters, unknowns);
}

/// Returns the counted work of the coarser computations with which an error estimate compares the
/// case (mesh or step of twice the size). Work is relative to that of the case. The result is empty
/// if the error estimate uses a finer computation instead.
std::vector<double> cost_of(const Document& document, const AnalysisResult& own,
                            const References& references) {
  std::vector<double> costs;
  for (const ErrorSource source : {ErrorSource::mesh, ErrorSource::step}) {
    const auto companion = adjacent_refinement_level(document, source, Refine::coarser, &own);
    if (companion && companion->finer) return {};
    if (!companion) continue;
    const double work = work_of(document, references);
    if (work > 0) costs.push_back(work_of(companion->document, references) / work);
  }
  return costs;
}

/// Returns the values of a quantity on another level (mesh and step) at the samples of the case;
/// NaN if the level has no such sample. Frequencies are matched by mode shape or by mode number,
/// whichever yields the nearer frequency.
std::vector<double> values_on_level(const AnalysisResult& level, const AnalysisResult& own,
                                    const std::string& name) {
  const std::vector<double>& given = own.quantities.at(name).values;
  std::vector<double> found(given.size(), kNaN);
  const auto other = level.quantities.find(name);
  if (other == level.quantities.end() || other->second.values.empty()) return found;
  const std::vector<double>& values = other->second.values;
  const auto samples =
      samples_matched_by_time(own.quantities, level.quantities, given.size(), values.size());
  for (std::size_t i = 0; i < given.size(); ++i)
    if (samples[i]) found[i] = values[*samples[i]];
  if (name != "frequency_Hz") return found;
  const auto modes = modes_matched_by_shape(own, level);
  for (std::size_t i = 0; i < given.size(); ++i)
    if (modes[i] && *modes[i] < values.size() &&
        !(std::abs(found[i] - given[i]) < std::abs(values[*modes[i]] - given[i])))
      found[i] = values[*modes[i]];
  return found;
}

/// Returns a row for each value, or one row for the largest difference of a curve. A row contains
/// the estimated error, the difference from the finest level, and the difference between the two
/// finest levels. All are relative to the value or to the scale of the quantity.
Json rows_of(const std::string& kind, const AnalysisResult& own,
             const results::ErrorEstimates& errors, const std::vector<AnalysisResult>& levels) {
  Json rows = Json::array();
  for (const auto& [name, quantity] : own.quantities) {
    if (!is_estimated(name) || (name == "frequency_Hz" && kind == "harmonic")) continue;
    const results::ErrorEstimate* estimate = errors.find(name);
    const std::vector<double> truths = values_on_level(levels.back(), own, name);
    const std::vector<double> previous = values_on_level(levels[levels.size() - 2], own, name);
    const bool is_curve = estimate && estimate->relative.size() < quantity.values.size();
    Json largest;
    for (std::size_t i = 0; i < quantity.values.size(); ++i) {
      const double value = quantity.values[i], truth = truths[i], before = previous[i];
      const double size = std::max(std::abs(value), estimate ? estimate->scale.value_or(0) : 0);
      if (!(size > 0) || std::isnan(truth + before)) continue;
      Json row = {name, estimate ? number_or_null(estimate->relative[is_curve ? 0 : i]) : Json(),
                  std::abs(value - truth) / size, std::abs(before - truth) / size};
      if (is_curve && estimate->scale) row[2] = std::abs(value - truth) / *estimate->scale;
      if (!is_curve) rows.push_back(row);
      if (largest.is_null() || row[2] > largest[2]) largest = row;
    }
    if (is_curve && !largest.is_null()) rows.push_back(largest);
  }
  return rows;
}

void add_level(const std::string& level, const Document& document, Json& levels) {
  const References references;
  AnalysisResult own = analyze(document, references, {true});
  if (!own.outcome.solved() || !has_mesh_or_time_steps(document)) return;
  const results::ErrorEstimates errors = estimate_errors(document, own, references);
  const std::vector<AnalysisResult> finer = finer_levels(document, own, references);
  if (finer.size() < 3) return;  // too few levels to determine the true errors
  levels.push_back({{"level", level},
                    {"kind", inner_analysis_kind(document)},
                    {"cost", cost_of(document, own, references)},
                    {"rows", rows_of(inner_analysis_kind(document), own, errors, finer)}});
}

/// Returns the levels of a case as JSON: up to four variants, the default mesh, and the first two
/// levels of each sweep.
std::string case_levels(const Case& given) {
  Json levels = Json::array();
  const auto add = [&](const std::string& name, const Document& document) {
    try {
      document.validate("case");
      add_level(given.id() + ", " + name, document, levels);
    } catch (const InputError&) {  // invalid on purpose
    }
  };
  for (const std::string& variant : given.variants() | std::views::take(kMostVariants))
    add(variant, patched(given, variant));
  Document document = patched(given, kBaseVariant), by_default = document;
  if (by_default.value().contains(JsonPointer("/model/elements"))) {
    by_default.apply_patch("default", "", {{"model", {{"elements", nullptr}}}});
    add("default mesh", by_default);
  }
  const Json sweeps = document.value().value("sweeps", Json::object());
  for (const auto& item : sweeps.items()) {
    const auto sweep = sweep_levels(document, item.key());
    for (std::size_t i = 0; i < std::min<std::size_t>(2, sweep.size()); ++i)
      add(item.key() + " level " + std::to_string(i + 1), sweep[i].document);
  }
  return levels.dump();
}

/// Statistics of the error estimates of one type of analysis.
struct Tally {
  int values = 0, estimated = 0, covered = 0, missed = 0, short_by_ten = 0;
  std::vector<double> ratios;
  std::map<std::size_t, std::vector<double>> costs;  // key: number of coarser computations

  [[nodiscard]] double coverage() const {
    return covered + missed > 0 ? static_cast<double>(covered) / (covered + missed) : 1;
  }
};

/// Ratio of true to estimated error, and texts: case, quantity, estimated error, true error.
using Miss = std::pair<double, std::vector<std::string>>;

/// Returns a row of an HTML table. @param tag  "th" or "td"
std::string row_of(const std::string& tag, const std::vector<std::string>& cells) {
  std::string row = "<tr>";
  for (const std::string& cell : cells) row.append("<").append(tag).append(">").append(cell);
  return row + "</tr>\n";
}

/// Adds a row of `rows_of` to the tally.
/// @param points  true and estimated errors: log10 in tenths, rounded to fifths of a decade
void add_row(const Json& row, const std::string& level, Tally& tally, std::vector<Miss>& misses,
             std::set<std::array<int, 2>>& points) {
  constexpr double kRoundoff = 1e-11;
  ++tally.values;
  if (row[1].is_null()) return;
  ++tally.estimated;
  const double stated = row[1], difference = row[2], unknown = row[3];
  const bool is_known = unknown <= kKnown * difference;
  if (difference + unknown > stated && !is_known) return;  // true error too uncertain
  if (difference <= stated) {
    ++tally.covered;
  } else {
    ++tally.missed;
    if (difference > 10 * stated) ++tally.short_by_ten;
    misses.emplace_back(
        difference / stated,
        std::vector<std::string>{level, row[0], rounded(stated, 2), rounded(difference, 2)});
  }
  if (!is_known || difference <= kRoundoff) return;
  tally.ratios.push_back(stated / difference);
  const auto tenths = [](double error) {
    return 2 * static_cast<int>(std::round(5 * std::log10(error)));
  };
  points.insert({tenths(difference), tenths(stated)});
}

}  // namespace

BOOST_AUTO_TEST_CASE(stated_errors_cover_true_errors) {
  std::vector<ProcessTask> tasks;
  const std::vector<Case> cases = Catalogue().load();
  for (const Case& given : cases) tasks.push_back({[&given] { return case_levels(given); }, 900});
  std::map<std::string, Tally> tallies;
  std::vector<Miss> misses;
  std::set<std::array<int, 2>> points;
  const auto ended = [&](std::size_t task, const ProcessOutcome& outcome) {
    BOOST_TEST((outcome.termination == ProcessOutcome::Termination::answered),
               cases[task].id() << ": " << outcome.text);
    if (outcome.termination != ProcessOutcome::Termination::answered) return;
    for (const Json& level : Json::parse(outcome.text)) {
      Tally& tally = tallies[level["kind"]];
      const auto costs = level["cost"].get<std::vector<double>>();
      tally.costs[costs.size()].push_back(std::accumulate(costs.begin(), costs.end(), 0.0));
      for (const Json& row : level["rows"]) add_row(row, level["level"], tally, misses, points);
    }
  };
  BOOST_TEST(run_in_worker_processes(tasks, {2}, ended) == 0);
  // To update the report, replace the files of the same names in reports/templates by these files.
  std::ofstream scatter("error_coverage.csv");
  for (const auto& [truth, stated] : points) scatter << truth << ' ' << stated << '\n';
  std::ofstream out("error_coverage.mustache");
  const Json program = build_and_machine_info();
  out << "<p class=\"muted\">Commit " << program["commit"].get<std::string>() << ", "
      << program["date"].get<std::string>() << ".</p>\n<table class=\"results-table plain\">\n"
      << row_of("th", {"Analysis", "Values", "Estimated (%)", "Covered (%)", "Short by &gt; 10",
                       "Stated / true", "Cost of mesh or step (%)", "Cost of both (%)"});
  const auto text = [](const std::vector<double>& values, double fraction, double factor = 1) {
    return values.empty() ? std::string("–") : rounded(factor * quantile(values, fraction), 3);
  };
  const auto cost = [&](const std::vector<double>& costs) {
    return text(costs, 0.5, 100) + ", " + text(costs, 0.95, 100);
  };
  std::vector<double> ratios;
  int covered = 0, missed = 0, short_by_ten = 0;
  for (auto& [kind, tally] : tallies) {
    covered += tally.covered, missed += tally.missed, short_by_ten += tally.short_by_ten;
    out << row_of("td", {kind, std::to_string(tally.values),
                         rounded(100.0 * tally.estimated / tally.values, 4),
                         rounded(100 * tally.coverage(), 4), std::to_string(tally.short_by_ten),
                         text(tally.ratios, 0.5), cost(tally.costs[1]), cost(tally.costs[2])});
    BOOST_TEST(tally.estimated >= 0.9 * tally.values, kind);
    ratios.insert(ratios.end(), tally.ratios.begin(), tally.ratios.end());
    if (tally.covered + tally.missed >= 20) BOOST_TEST(tally.coverage() >= 0.9, kind);
  }
  BOOST_TEST(covered >= 0.95 * (covered + missed));
  BOOST_TEST(quantile(ratios, 0.5) <= 4);
  BOOST_TEST(short_by_ten == 0);
  out << "</table>\n<table class=\"results-table plain\">\n"
      << row_of("th", {"Largest misses", "Quantity", "Stated", "True"});
  std::ranges::sort(misses, std::greater());
  for (std::size_t i = 0; i < std::min<std::size_t>(10, misses.size()); ++i)
    out << row_of("td", misses[i].second);
  out << "</table>\n";
}

BOOST_AUTO_TEST_SUITE_END()
