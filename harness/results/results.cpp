#include "harness/results/results.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <map>
#include <system_error>

#include "harness/base/quantity.h"
#include "harness/results/fields.h"

namespace trammel::results {

template <>
inline constexpr std::array kNames<Verdict> = {
    std::pair{"pass", Verdict::pass},         std::pair{"fail", Verdict::fail},
    std::pair{"error", Verdict::error},       std::pair{"not-run", Verdict::not_run},
    std::pair{"recorded", Verdict::recorded}, std::pair{"not-given", Verdict::not_given}};
template <>
inline constexpr std::array kNames<Expectation> = {
    std::pair{"agrees", Expectation::agrees},
    std::pair{"known-discrepancy", Expectation::known_discrepancy},
    std::pair{"none", Expectation::none}};
template <>
inline constexpr std::array kNames<Status> = {std::pair{"solved", Status::solved},
                                              std::pair{"singular", Status::singular},
                                              std::pair{"not-converged", Status::not_converged},
                                              std::pair{"error", Status::error},
                                              std::pair{"not-run", Status::not_run},
                                              std::pair{"cannot", Status::cannot},
                                              std::pair{"not-exported", Status::not_exported},
                                              std::pair{"crashed", Status::crashed},
                                              std::pair{"timed-out", Status::timed_out}};

/// t: the difference lies within +-t. [low, high]: between them, null where open.
template <>
Json to_json(const Tolerance& tolerance) {
  if (tolerance.symmetric) return to_json(tolerance.high);
  return Json::array({to_json(tolerance.low), to_json(tolerance.high)});
}

template <>
void from_json(const Json& json, const Place& place, Tolerance& tolerance) {
  if (json.is_number()) {
    const double high = json.get<double>();
    tolerance = {-high, high, true};
    return;
  }
  Numbers ends;
  if (!json.is_array() || json.size() != 2) place.fail("a number or two");
  from_json(json, place, ends);
  tolerance = {ends[0], ends[1], false};
}

template <>
inline constexpr auto kFields<TwoTermLaw> =
    std::tuple{TRAMMEL_REQUIRED(TwoTermLaw, coefficients, max_relative_misfit, used)};
std::string usual_unit(const Check& check) {
  return harness::unit_of(check.quantity);
}
std::string usual_role(const Check&) {
  return "verification";
}
std::string usual_measure(const Check&) {
  return "relative";
}
template <>
inline constexpr auto kFields<Check> =
    std::tuple{TRAMMEL_REQUIRED(Check, name, quantity),
               TRAMMEL_OPTIONAL(Check, index, computed, expected, difference),
               TRAMMEL_REQUIRED(Check, tolerance, why, verdict),
               usual("unit", &Check::unit, usual_unit),
               usual("role", &Check::role, usual_role),
               usual("measure", &Check::measure, usual_measure),
               TRAMMEL_OPTIONAL(Check, title, expectation, message, statistic, reference,
                                against_variant, against_quantity)};
template <>
inline constexpr auto kFields<Convergence> =
    std::tuple{TRAMMEL_REQUIRED(Convergence, sweep, parameter, quantity, index, values, exact,
                                error, roundoff, order, in_asymptotic_range, at_roundoff_floor,
                                theory_order, fitted_order, richardson, gci, safety_factor),
               TRAMMEL_OPTIONAL(Convergence, statistic, reference, lower_order, two_term)};
template <>
inline constexpr auto kFields<UncertainInput> =
    std::tuple{TRAMMEL_REQUIRED(UncertainInput, name, pointers, half_width, nominal, why)};
template <>
inline constexpr auto kFields<NumericalEstimate> =
    std::tuple{TRAMMEL_REQUIRED(NumericalEstimate, refinement, quantity, index, parameter, values,
                                order, safety_factor, half_width)};
template <>
inline constexpr auto kFields<AllInputsComparison> = std::tuple{TRAMMEL_REQUIRED(
    AllInputsComparison, u_input, u_input_sampled, u_val, interval, verdict, conclusion)};
template <>
inline constexpr auto kFields<Comparison> = std::tuple{TRAMMEL_REQUIRED(
    Comparison, check, quantity, index, unit, reference, simulation, expected, u_num, u_input,
    u_input_sampled, u_reference, contributions, dominant_input, dominant_share, spread, difference,
    u_val, interval, verdict, conclusion, all_inputs)};
template <>
inline constexpr auto kFields<Uncertainty> =
    std::tuple{TRAMMEL_REQUIRED(Uncertainty, inputs, samples, failed, samples_all_inputs,
                                failed_all_inputs, numerical, comparisons)};
template <>
inline constexpr auto kFields<Joint> = std::tuple{TRAMMEL_REQUIRED(Joint, node, kind, name)};
template <>
inline constexpr auto kFields<Shape> =
    std::tuple{required("displacement_m", &Shape::displacement), TRAMMEL_REQUIRED(Shape, label)};
template <>
inline constexpr auto kFields<Pose> =
    std::tuple{required("nodes_m", &Pose::nodes), TRAMMEL_REQUIRED(Pose, label),
               TRAMMEL_OPTIONAL(Pose, time_s), optional("displacement_m", &Pose::displacement)};
template <>
inline constexpr auto kFields<Drawing> =
    std::tuple{required("nodes_m", &Drawing::nodes),
               TRAMMEL_REQUIRED(Drawing, members, triangles, joints, shapes),
               TRAMMEL_OPTIONAL(Drawing, poses)};
template <>
inline constexpr auto kKeyMember<EvaluationTiming> = &EvaluationTiming::name;
template <>
inline constexpr auto kFields<EvaluationTiming> =
    std::tuple{TRAMMEL_REQUIRED(EvaluationTiming, per_evaluation_s, evaluations)};
template <>
inline constexpr auto kFields<Cost> =
    std::tuple{TRAMMEL_REQUIRED(Cost, wall_s, cpu_s, counters),
               TRAMMEL_OPTIONAL(Cost, uncertainty_wall_s, timings)};
template <>
inline constexpr auto kFields<EffectRow> = std::tuple{
    required("effect", &EffectRow::name),
    TRAMMEL_REQUIRED(EffectRow, applicable, active, why, evaluations),
    TRAMMEL_OPTIONAL(EffectRow, dimensionless_number, number_definition, estimated_change)};
template <>
inline constexpr auto kFields<ReadingClass> =
    std::tuple{TRAMMEL_REQUIRED(ReadingClass, title, readings, probability, values)};
template <>
inline constexpr auto kKeyMember<FurtherNumber> = &FurtherNumber::name;
template <>
inline constexpr auto kFields<FurtherNumber> =
    std::tuple{TRAMMEL_REQUIRED(FurtherNumber, expected_information_bits)};
template <>
inline constexpr auto kFields<RowProbabilities> = std::tuple{TRAMMEL_REQUIRED(
    RowProbabilities, row, reference, unit, discrepancy, log_evidence, entropy_bits, printed,
    readings, classes, credible_classes, leading, further_numbers)};
template <>
inline constexpr auto kFields<ExcludedReadings> =
    std::tuple{TRAMMEL_REQUIRED(ExcludedReadings, reason, first, readings)};
template <>
inline constexpr auto kFields<ModelProbabilities> =
    std::tuple{TRAMMEL_REQUIRED(ModelProbabilities, rows, excluded)};
template <>
inline constexpr auto kFields<Run> =
    std::tuple{required("case", &Run::case_id),
               TRAMMEL_REQUIRED(Run, variant, status, quantities, checks, cost),
               TRAMMEL_OPTIONAL(Run, reason, convergence, residuals, warnings, uncertainty, effects,
                                model_probabilities, drawing, stored)};
template <>
inline constexpr auto kFields<ErrorNorms> =
    std::tuple{TRAMMEL_REQUIRED(ErrorNorms, max, rms, mean)};
template <>
inline constexpr auto kFields<SettingTime> = std::tuple{TRAMMEL_REQUIRED(
    SettingTime, cpu_s, relative_low, relative_high, wall_median_s, runs_per_measurement)};
template <>
inline constexpr auto kFields<CostSetting> = std::tuple{
    required("error", &CostSetting::errors), required("relative_time", &CostSetting::relative),
    TRAMMEL_REQUIRED(CostSetting, curve, curve_title, title, value, status, reason, cpu_s, time,
                     counters, pareto_optimal)};
template <>
inline constexpr auto kFields<CheapestSetting> =
    std::tuple{TRAMMEL_REQUIRED(CheapestSetting, error, setting, tied)};
template <>
inline constexpr auto kFields<Repeatability> =
    std::tuple{TRAMMEL_REQUIRED(Repeatability, on_both_fronts, on_either_front, same_cheapest,
                                target_errors, median_difference, largest_difference)};
template <>
inline constexpr auto kFields<CostOutput> =
    std::tuple{TRAMMEL_REQUIRED(CostOutput, title, scale, errors, cheapest)};
template <>
inline constexpr auto kFields<CostStudy> =
    std::tuple{TRAMMEL_REQUIRED(CostStudy, id, family, title, reference_solution, scale, norm,
                                baseline, wall_s, settings, cheapest, repeatability, conclusion),
               TRAMMEL_OPTIONAL(CostStudy, description, outputs)};
template <>
inline constexpr auto kFields<LoopRate> =
    std::tuple{TRAMMEL_REQUIRED(LoopRate, title, operations, bytes, cpu_s)};
template <>
inline constexpr auto kFields<Roofline> =
    std::tuple{TRAMMEL_REQUIRED(Roofline, peak_flop_per_s, bandwidth_B_per_s, loops)};
template <>
inline constexpr auto kFields<CostStudies> = std::tuple{
    TRAMMEL_REQUIRED(CostStudies, sweep, seed, repeats, equal_within, diverged_above, studies),
    TRAMMEL_OPTIONAL(CostStudies, roofline)};
template <>
inline constexpr auto kFields<Environment> =
    std::tuple{TRAMMEL_REQUIRED(Environment, trammel, commit, date, compiler, flags, build_type,
                                libraries, processor, cores, system),
               TRAMMEL_OPTIONAL(Environment, stored_runs)};
template <>
inline constexpr auto kKeyMember<PlotRequest::Line> = &PlotRequest::Line::title;
template <>
inline constexpr auto kFields<PlotRequest::Line> =
    std::tuple{TRAMMEL_REQUIRED(PlotRequest::Line, x, y)};
template <>
inline constexpr auto kKeyMember<PlotRequest> = &PlotRequest::id;
template <>
inline constexpr auto kFields<PlotRequest> =
    std::tuple{TRAMMEL_REQUIRED(PlotRequest, y),
               TRAMMEL_OPTIONAL(PlotRequest, title, x, variants, log, value, lines, caption)};
template <>
inline constexpr auto kKeyMember<ColumnRequest> = &ColumnRequest::id;
template <>
inline constexpr auto kFields<ColumnRequest> =
    std::tuple{TRAMMEL_REQUIRED(ColumnRequest, title),
               TRAMMEL_OPTIONAL(ColumnRequest, quantity, statistic, timing, over_timing)};
template <>
inline constexpr auto kKeyMember<TableRequest> = &TableRequest::id;
template <>
inline constexpr auto kFields<TableRequest> =
    std::tuple{TRAMMEL_REQUIRED(TableRequest, columns),
               TRAMMEL_OPTIONAL(TableRequest, title, variants, caption)};
template <>
inline constexpr auto kFields<StressSuiteEntry> =
    std::tuple{TRAMMEL_REQUIRED(StressSuiteEntry, item, indicators)};
template <>
inline constexpr auto kKeyMember<Variant> = &Variant::id;
template <>
inline constexpr auto kFields<Variant> = std::tuple{TRAMMEL_REQUIRED(Variant, title)};
template <>
inline constexpr auto kKeyMember<CaseInfo> = &CaseInfo::id;
template <>
inline constexpr auto kFields<CaseInfo> =
    std::tuple{TRAMMEL_REQUIRED(CaseInfo, title, variants),
               TRAMMEL_OPTIONAL(CaseInfo, description, family, labels, stress_suite, figures,
                                tables, analysis, hash)};
template <>
inline constexpr auto kFields<Solver> =
    std::tuple{TRAMMEL_REQUIRED(Solver, name, version, command)};
template <>
inline constexpr auto kKeyMember<Reference> = &Reference::id;
template <>
inline constexpr auto kFields<Reference> =
    std::tuple{TRAMMEL_REQUIRED(Reference, title, kind, unit, values, uncertainty, citation, place),
               TRAMMEL_OPTIONAL(Reference, doi, printed, derivation, errata, notes)};
template <>
inline constexpr auto kFields<UncertaintyCoverage> =
    std::tuple{TRAMMEL_REQUIRED(UncertaintyCoverage, levels, covered, coverage, min_coverage,
                                median_ratio, max_median_ratio, min_levels, passes)};
template <>
inline constexpr auto kFields<ClaimEntry> = std::tuple{
    required("case", &ClaimEntry::case_id), TRAMMEL_REQUIRED(ClaimEntry, variant, name, value)};
template <>
inline constexpr auto kFields<ClaimInterpretation> =
    std::tuple{TRAMMEL_REQUIRED(ClaimInterpretation, description, metric, unit, verdict, entries)};
template <>
inline constexpr auto kFields<Claim> = std::tuple{TRAMMEL_REQUIRED(
    Claim, id, claim, place, verdict, expected, conclusion, undecidable, interpretations)};
template <>
inline constexpr auto kFields<PaperItem::Counterpart> =
    std::tuple{required("case", &PaperItem::Counterpart::case_id),
               TRAMMEL_OPTIONAL(PaperItem::Counterpart, variant, quantity, figure, verdict)};
template <>
inline constexpr auto kFields<PaperItem> =
    std::tuple{TRAMMEL_REQUIRED(PaperItem, id, section, what),
               TRAMMEL_OPTIONAL(PaperItem, shown_by, claims, reason, note)};
template <>
inline constexpr auto kFields<Claims> = std::tuple{
    TRAMMEL_REQUIRED(Claims, title, as_recorded, claims), TRAMMEL_OPTIONAL(Claims, items)};
template <>
inline constexpr auto kFields<CoverageRow> =
    std::tuple{TRAMMEL_REQUIRED(CoverageRow, group, feature, evidence),
               TRAMMEL_OPTIONAL(CoverageRow, reason, series, judged)};
template <>
inline constexpr auto kFields<EffectScene> = std::tuple{TRAMMEL_REQUIRED(
    EffectScene, scene, analysis, tolerance, change, minimal, whole_s, chosen_s, deciding_s)};
template <>
inline constexpr auto kFields<HistoryCall> = std::tuple{
    TRAMMEL_REQUIRED(HistoryCall, id, date, commit, machine, runs, checks, failures, cpu_s, work)};
template <>
inline constexpr auto kFields<HistoryChange> = std::tuple{
    TRAMMEL_REQUIRED(HistoryChange, name, verdict_before, verdict, before, after, commit, date)};
template <>
inline constexpr auto kFields<HistoryDrift> =
    std::tuple{TRAMMEL_REQUIRED(HistoryDrift, name, steps, first, last)};
template <>
inline constexpr auto kFields<History> =
    std::tuple{TRAMMEL_REQUIRED(History, calls, since, changes, work, drifts)};
template <>
inline constexpr auto kFields<Results> = std::tuple{
    optional("numerical_uncertainty", &Results::uncertainty_coverage),
    TRAMMEL_REQUIRED(Results, format, environment, cases, references, runs),
    TRAMMEL_OPTIONAL(Results, solver, cost, claims, coverage, effect_scenes, history, store)};

namespace {

/// Every vector of a refinement has one entry a level.
void complete(Convergence& study, const Place& place) {
  const std::size_t levels = study.parameter.size();
  for (std::size_t i = 0; i < levels; ++i) {
    // Levels without a number of their own are numbered.
    if (!study.parameter[i]) study.parameter[i] = static_cast<double>(i + 1);
  }
  const auto fit = [&](auto& column, const char* key) {
    if (column.size() != levels) Place{&place, key}.fail(std::to_string(levels) + " entries");
  };
  fit(study.values, "values");
  fit(study.error, "error");
  fit(study.roundoff, "roundoff");
  fit(study.order, "order");
  fit(study.gci, "gci");
  fit(study.in_asymptotic_range, "in_asymptotic_range");
  fit(study.at_roundoff_floor, "at_roundoff_floor");
}

void require_nodes(const std::vector<std::vector<int>>& sets, int nodes, std::size_t size,
                   std::size_t other, const Place& place) {
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const Place set_place{&place, std::to_string(i)};
    if (sets[i].size() != size && sets[i].size() != other)
      set_place.fail(std::to_string(size) + " node numbers");
    for (std::size_t k = 0; k < sets[i].size(); ++k) {
      if (sets[i][k] >= nodes)
        Place{&set_place, std::to_string(k)}.fail("an integer from 0 to " +
                                                  std::to_string(nodes - 1));
    }
  }
}

/// What refers to nodes refers to nodes that there are.
void require_consistent(const Drawing& drawing, const Place& place) {
  const std::size_t nodes = drawing.nodes.size();
  const int limit = static_cast<int>(nodes);
  require_nodes(drawing.members, limit, 2, 2, Place{&place, "members"});
  require_nodes(drawing.triangles, limit, 3, 6, Place{&place, "triangles"});
  for (std::size_t i = 0; i < drawing.joints.size(); ++i)
    if (drawing.joints[i].node >= limit)
      place.fail("joints at nodes from 0 to " + std::to_string(limit - 1));
  const auto one_per_node = [&](const auto& entries, const char* key, auto member,
                                const char* member_key) {
    const Place list_place{&place, key};
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const Place entry_place{&list_place, std::to_string(i)};
      if ((entries[i].*member).size() != nodes)
        Place{&entry_place, member_key}.fail("one pair of numbers a node, " +
                                             std::to_string(nodes));
    }
  };
  one_per_node(drawing.shapes, "shapes", &Shape::displacement, "displacement_m");
  one_per_node(drawing.poses, "poses", &Pose::nodes, "nodes_m");
  if (std::ranges::any_of(drawing.poses, [](const Pose& p) { return !p.displacement.empty(); }))
    one_per_node(drawing.poses, "poses", &Pose::displacement, "displacement_m");
}

void require_consistent(const CostStudy& study, const Place& place) {
  const std::size_t count = study.settings.size();
  const std::string expected = "an integer from 0 to " + std::to_string(count - 1);
  if (study.baseline >= count) Place{&place, "baseline"}.fail(expected);
  const auto check = [&](const std::vector<CheapestSetting>& all, const Place& at) {
    for (const CheapestSetting& cheapest : all)
      if (cheapest.setting.value_or(0) >= count ||
          std::any_of(cheapest.tied.begin(), cheapest.tied.end(),
                      [count](std::size_t tied) { return tied >= count; }))
        Place{&at, "cheapest"}.fail(expected);
  };
  check(study.cheapest, place);
  const Place outputs{&place, "outputs"};
  for (const CostOutput& output : study.outputs) {
    check(output.cheapest, outputs);
    if (output.errors.size() != count)
      Place{&outputs, "errors"}.fail(std::to_string(count) + " numbers, one a setting");
  }
}

/// Titles that are left out are the names.
void complete(CaseInfo& info) {
  const auto complete_title = [](auto& entry) {
    if (entry.title.empty()) entry.title = entry.id;
  };
  if (info.family.empty()) info.family = info.id;
  for (PlotRequest& figure : info.figures) complete_title(figure);
  for (TableRequest& table : info.tables) complete_title(table);
}

template <class Entry>
const Entry* find_id(const std::vector<Entry>& entries, const std::string& id) {
  const auto found = std::find_if(entries.begin(), entries.end(),
                                  [&](const Entry& entry) { return entry.id == id; });
  return found == entries.end() ? nullptr : &*found;
}

}  // namespace

std::string Place::pointer() const {
  if (!parent) return "";
  std::string escaped;
  for (const char c : key) {
    if (c == '~') {
      escaped += "~0";
    } else if (c == '/') {
      escaped += "~1";
    } else {
      escaped += c;
    }
  }
  return parent->pointer() + "/" + escaped;
}

void Place::fail(const std::string& expected) const {
  const std::string where = pointer();
  throw std::runtime_error((where.empty() ? "/" : where) + ": expected " + expected);
}

/// Texts that many objects share: each stands once in a list of its own, and they hold its place.
struct SharedTexts {
  const char* list;
  std::vector<const char*> members;
  const char* fault;
  std::vector<Json*> (*holders)(Json& json);
};

std::vector<Json*> checks_in(Json& json) {
  std::vector<Json*> checks;
  if (json.contains("runs"))
    for (Json& run : json.at("runs"))
      if (run.is_object() && run.contains("checks"))
        for (Json& check : run.at("checks")) checks.push_back(&check);
  return checks;
}

std::vector<Json*> references_in(Json& json) {
  std::vector<Json*> references;
  if (json.contains("references"))
    for (Json& reference : json.at("references")) references.push_back(&reference);
  return references;
}

const std::array<SharedTexts, 4> kSharedTexts = {{
    {"names",
     {"name", "quantity", "reference", "against_quantity"},
     "a name for each place that a check holds",
     checks_in},
    {"reasons", {"why", "title", "message"}, "a text for each place that a check holds", checks_in},
    {"citations",
     {"citation", "doi", "place"},
     "a text for each place that a reference holds",
     references_in},
    {"notes", {"notes"}, "a note for each place that a reference holds", references_in},
}};

void share_texts(Json& json, const SharedTexts& shared) {
  Json texts = Json::array();
  std::map<std::string, std::size_t> places;
  for (Json* holder : shared.holders(json))
    for (const char* member : shared.members) {
      if (!holder->contains(member)) continue;
      Json& text = holder->at(member);
      const auto [place, fresh] = places.emplace(text, places.size());
      if (fresh) texts.push_back(text);
      text = place->second;
    }
  if (!texts.empty()) json[shared.list] = std::move(texts);
}

/// Puts them back.
void give_texts(Json& json, const SharedTexts& shared) {
  if (!json.is_object() || !json.contains(shared.list)) return;
  const Place root;
  const auto texts = from_json<std::vector<std::string>>(json.at(shared.list));
  for (Json* holder : shared.holders(json))
    for (const char* member : shared.members) {
      if (!holder->is_object() || !holder->contains(member)) continue;
      Json& place = holder->at(member);
      if (!place.is_number()) continue;
      if (!place.is_number_unsigned() || place.get<std::size_t>() >= texts.size())
        Place{&root, shared.list}.fail(shared.fault);
      place = texts[place.get<std::size_t>()];
    }
}

void complete(Results& results) {
  const Place root;
  if (results.format != 1) Place{&root, "format"}.fail("1");
  for (CaseInfo& info : results.cases) complete(info);
  const Place runs{&root, "runs"};
  for (std::size_t i = 0; i < results.runs.size(); ++i) {
    Run& run = results.runs[i];
    const Place place{&runs, std::to_string(i)};
    // The page could not name it otherwise.
    if (std::none_of(results.cases.begin(), results.cases.end(),
                     [&](const CaseInfo& info) { return info.id == run.case_id; }))
      Place{&place, "case"}.fail("a case that stands under /cases");
    if (run.drawing) require_consistent(*run.drawing, Place{&place, "drawing"});
    const Place studies{&place, "convergence"};
    for (std::size_t k = 0; k < run.convergence.size(); ++k)
      complete(run.convergence[k], Place{&studies, std::to_string(k)});
  }
  if (!results.cost) return;
  const Place cost{&root, "cost"};
  const Place studies{&cost, "studies"};
  for (std::size_t i = 0; i < results.cost->studies.size(); ++i)
    require_consistent(results.cost->studies[i], Place{&studies, std::to_string(i)});
}

nlohmann::ordered_json coverage_to_json(const std::vector<CoverageRow>& rows) {
  return to_json(rows);
}

nlohmann::ordered_json history_to_json(const History& history) {
  return to_json(history);
}

nlohmann::ordered_json claims_to_json(const Claims& claims) {
  return to_json(claims);
}

nlohmann::ordered_json effect_scenes_to_json(const std::vector<EffectScene>& scenes) {
  return to_json(scenes);
}

Json to_json(const Results& results) {
  Json json = to_json<Results>(results);
  for (const SharedTexts& shared : kSharedTexts) share_texts(json, shared);
  return json;
}
Json to_json(const Run& run) {
  return to_json<Run>(run);
}
Run read_run(const Json& json) {
  return from_json<Run>(json);
}

std::vector<PlotRequest> read_figures(const Json& json) {
  return from_json<std::vector<PlotRequest>>(json);
}
std::vector<TableRequest> read_tables(const Json& json) {
  return from_json<std::vector<TableRequest>>(json);
}
StressSuiteEntry read_stress_suite(const Json& json) {
  return from_json<StressSuiteEntry>(json);
}
Environment read_environment(const Json& json) {
  return from_json<Environment>(json);
}
CostStudies read_cost_studies(const Json& json) {
  return from_json<CostStudies>(json);
}

bool CoverageRow::is_verified() const {
  return std::any_of(evidence.begin(), evidence.end(),
                     [](const std::string& kind) { return kind != "self-consistency"; });
}

Results read_results(Json json) {
  for (const SharedTexts& shared : kSharedTexts) give_texts(json, shared);
  auto results = from_json<Results>(json);
  complete(results);
  return results;
}

Results read_results(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in)
    throw std::system_error(EIO, std::generic_category(), file.string() + ": cannot be read");
  try {
    return read_results(Json::parse(in));
  } catch (const Json::parse_error& error) {
    throw std::runtime_error(file.string() + ": not JSON at byte " + std::to_string(error.byte));
  } catch (const Json::out_of_range&) {
    throw std::runtime_error(file.string() + ": /: a number that a double cannot hold");
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

const Numbers* Run::quantity(const std::string& name) const {
  for (const auto& [key, values] : quantities)
    if (key == name) return &values;
  return nullptr;
}

bool PlotRequest::is_log(const std::string& axis) const {
  return std::find(log.begin(), log.end(), axis) != log.end();
}

std::string CaseInfo::variant_title(const std::string& variant) const {
  const Variant* found = find_id(variants, variant);
  return found ? found->title : variant;
}

const CaseInfo& Results::case_info(const std::string& id) const {
  const CaseInfo* found = find_id(cases, id);
  if (!found) throw std::logic_error("no case " + id);
  return *found;
}

const Reference* Results::reference(const std::string& id) const {
  return find_id(references, id);
}

Number CostStudy::error(const CostSetting& setting) const {
  if (!setting.errors) return std::nullopt;
  return norm == "max"   ? setting.errors->max
         : norm == "rms" ? setting.errors->rms
                         : setting.errors->mean;
}

std::string to_string(Verdict verdict) {
  return detail::name_of(verdict);
}
std::string to_string(Status status) {
  return detail::name_of(status);
}

}  // namespace trammel::results
