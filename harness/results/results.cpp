#include "harness/results/results.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <map>
#include <system_error>

#include "harness/base/contains.h"
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

TRAMMEL_FIELDS(TwoTermLaw, TRAMMEL_REQUIRED(coefficients, max_relative_misfit, used));
std::string usual_unit(const Check& check) {
  return harness::unit_of(check.quantity);
}
std::string usual_role(const Check&) {
  return "verification";
}
std::string usual_measure(const Check&) {
  return "relative";
}
TRAMMEL_FIELDS(Check, TRAMMEL_REQUIRED(name, quantity),
               TRAMMEL_OPTIONAL(index, computed, expected, difference),
               TRAMMEL_REQUIRED(tolerance, why, verdict), usual("unit", &S::unit, usual_unit),
               usual("role", &S::role, usual_role), usual("measure", &S::measure, usual_measure),
               TRAMMEL_OPTIONAL(title, expectation, message, statistic, reference, against_variant,
                                against_quantity));
TRAMMEL_FIELDS(Convergence,
               TRAMMEL_REQUIRED(sweep, parameter, quantity, index, values, exact, error, roundoff,
                                order, in_asymptotic_range, at_roundoff_floor, theory_order,
                                fitted_order, richardson, gci, safety_factor),
               TRAMMEL_OPTIONAL(statistic, reference, lower_order, two_term));
TRAMMEL_FIELDS(UncertainInput, TRAMMEL_REQUIRED(name, pointers, half_width, nominal, why));
TRAMMEL_FIELDS(NumericalEstimate, TRAMMEL_REQUIRED(refinement, quantity, index, parameter, values,
                                                   order, safety_factor, half_width));
TRAMMEL_FIELDS(AllInputsComparison,
               TRAMMEL_REQUIRED(u_input, u_input_sampled, u_val, interval, verdict, conclusion));
TRAMMEL_FIELDS(Comparison,
               TRAMMEL_REQUIRED(check, quantity, index, unit, reference, simulation, expected,
                                u_num, u_input, u_input_sampled, u_reference, contributions,
                                dominant_input, dominant_share, spread, difference, u_val, interval,
                                verdict, conclusion, all_inputs));
TRAMMEL_FIELDS(Uncertainty, TRAMMEL_REQUIRED(inputs, samples, failed, samples_all_inputs,
                                             failed_all_inputs, numerical, comparisons));
TRAMMEL_FIELDS(Joint, TRAMMEL_REQUIRED(node, kind, name));
TRAMMEL_FIELDS(Shape, required("displacement_m", &S::displacement), TRAMMEL_REQUIRED(label));
TRAMMEL_FIELDS(Pose, required("nodes_m", &S::nodes), TRAMMEL_REQUIRED(label),
               TRAMMEL_OPTIONAL(time_s), optional("displacement_m", &S::displacement));
TRAMMEL_FIELDS(Drawing, required("nodes_m", &S::nodes),
               TRAMMEL_REQUIRED(members, triangles, joints, shapes), TRAMMEL_OPTIONAL(poses));
TRAMMEL_KEY(EvaluationTiming, name);
TRAMMEL_FIELDS(EvaluationTiming, TRAMMEL_REQUIRED(per_evaluation_s, evaluations));
TRAMMEL_FIELDS(Cost, TRAMMEL_REQUIRED(wall_s, cpu_s, counters),
               TRAMMEL_OPTIONAL(uncertainty_wall_s, timings));
TRAMMEL_FIELDS(EffectRow, required("effect", &S::name),
               TRAMMEL_REQUIRED(applicable, active, why, evaluations),
               TRAMMEL_OPTIONAL(dimensionless_number, number_definition, estimated_change));
TRAMMEL_FIELDS(ReadingClass, TRAMMEL_REQUIRED(title, readings, probability, values));
TRAMMEL_KEY(FurtherNumber, name);
TRAMMEL_FIELDS(FurtherNumber, TRAMMEL_REQUIRED(expected_information_bits));
TRAMMEL_FIELDS(RowProbabilities, TRAMMEL_REQUIRED(row, reference, unit, discrepancy, log_evidence,
                                                  entropy_bits, printed, readings, classes,
                                                  credible_classes, leading, further_numbers));
TRAMMEL_FIELDS(ExcludedReadings, TRAMMEL_REQUIRED(reason, first, readings));
TRAMMEL_FIELDS(ModelProbabilities, TRAMMEL_REQUIRED(rows, excluded));
TRAMMEL_FIELDS(Run, required("case", &S::case_id),
               TRAMMEL_REQUIRED(variant, status, quantities, checks, cost),
               TRAMMEL_OPTIONAL(reason, convergence, residuals, warnings, uncertainty, effects,
                                model_probabilities, drawing, stored));
TRAMMEL_FIELDS(ErrorNorms, TRAMMEL_REQUIRED(max, rms, mean));
TRAMMEL_FIELDS(SettingTime, TRAMMEL_REQUIRED(cpu_s, relative_low, relative_high, wall_median_s,
                                             runs_per_measurement));
TRAMMEL_FIELDS(CostSetting, required("error", &S::errors), required("relative_time", &S::relative),
               TRAMMEL_REQUIRED(curve, curve_title, title, value, status, reason, cpu_s, time,
                                counters, pareto_optimal));
TRAMMEL_FIELDS(CheapestSetting, TRAMMEL_REQUIRED(error, setting, tied));
TRAMMEL_FIELDS(Repeatability,
               TRAMMEL_REQUIRED(on_both_fronts, on_either_front, same_cheapest, target_errors,
                                median_difference, largest_difference));
TRAMMEL_FIELDS(CostOutput, TRAMMEL_REQUIRED(title, scale, errors, cheapest));
TRAMMEL_FIELDS(CostStudy,
               TRAMMEL_REQUIRED(id, family, title, reference_solution, scale, norm, baseline,
                                wall_s, settings, cheapest, repeatability, conclusion),
               TRAMMEL_OPTIONAL(description, outputs));
TRAMMEL_FIELDS(CostStudies,
               TRAMMEL_REQUIRED(sweep, seed, repeats, equal_within, diverged_above, studies));
TRAMMEL_FIELDS(Environment,
               TRAMMEL_REQUIRED(trammel, commit, date, compiler, flags, build_type, libraries,
                                processor, cores, system),
               TRAMMEL_OPTIONAL(stored_runs));
TRAMMEL_KEY(PlotRequest::Line, title);
TRAMMEL_FIELDS(PlotRequest::Line, TRAMMEL_REQUIRED(x, y));
TRAMMEL_KEY(PlotRequest, id);
TRAMMEL_FIELDS(PlotRequest, TRAMMEL_REQUIRED(y),
               TRAMMEL_OPTIONAL(title, x, variants, log, value, lines, caption));
TRAMMEL_KEY(ColumnRequest, id);
TRAMMEL_FIELDS(ColumnRequest, TRAMMEL_REQUIRED(title),
               TRAMMEL_OPTIONAL(quantity, statistic, timing, over_timing));
TRAMMEL_KEY(TableRequest, id);
TRAMMEL_FIELDS(TableRequest, TRAMMEL_REQUIRED(columns), TRAMMEL_OPTIONAL(title, variants, caption));
TRAMMEL_FIELDS(StressSuiteEntry, TRAMMEL_REQUIRED(item, indicators));
TRAMMEL_KEY(Variant, id);
TRAMMEL_FIELDS(Variant, TRAMMEL_REQUIRED(title));
TRAMMEL_KEY(CaseInfo, id);
TRAMMEL_FIELDS(CaseInfo, TRAMMEL_REQUIRED(title, variants),
               TRAMMEL_OPTIONAL(description, family, labels, stress_suite, figures, tables,
                                analysis, hash));
TRAMMEL_FIELDS(Solver, TRAMMEL_REQUIRED(name, version, command));
TRAMMEL_KEY(Reference, id);
TRAMMEL_FIELDS(Reference, TRAMMEL_REQUIRED(title, kind, unit, values, uncertainty, citation, place),
               TRAMMEL_OPTIONAL(doi, printed, derivation, errata, notes));
TRAMMEL_FIELDS(UncertaintyCoverage,
               TRAMMEL_REQUIRED(levels, covered, coverage, min_coverage, median_ratio,
                                max_median_ratio, min_levels, passes));
TRAMMEL_FIELDS(ClaimEntry, required("case", &S::case_id), TRAMMEL_REQUIRED(variant, name, value));
TRAMMEL_FIELDS(ClaimInterpretation, TRAMMEL_REQUIRED(description, metric, unit, verdict, entries));
TRAMMEL_FIELDS(Claim, TRAMMEL_REQUIRED(id, claim, place, verdict, expected, conclusion, undecidable,
                                       interpretations));
TRAMMEL_FIELDS(PaperItem::Counterpart, required("case", &S::case_id),
               TRAMMEL_OPTIONAL(variant, quantity, figure, verdict));
TRAMMEL_FIELDS(PaperItem, TRAMMEL_REQUIRED(id, section, what),
               TRAMMEL_OPTIONAL(shown_by, claims, reason, note));
TRAMMEL_FIELDS(Claims, TRAMMEL_REQUIRED(title, as_recorded, claims), TRAMMEL_OPTIONAL(items));
TRAMMEL_FIELDS(CoverageRow, TRAMMEL_REQUIRED(group, feature, evidence),
               TRAMMEL_OPTIONAL(reason, series, judged));
TRAMMEL_FIELDS(EffectScene, TRAMMEL_REQUIRED(scene, analysis, tolerance, change, minimal, whole_s,
                                             chosen_s, deciding_s));
TRAMMEL_FIELDS(HistoryCall,
               TRAMMEL_REQUIRED(id, date, commit, machine, runs, checks, failures, cpu_s, work));
TRAMMEL_FIELDS(HistoryChange,
               TRAMMEL_REQUIRED(name, verdict_before, verdict, before, after, commit, date));
TRAMMEL_FIELDS(HistoryDrift, TRAMMEL_REQUIRED(name, steps, first, last));
TRAMMEL_FIELDS(History, TRAMMEL_REQUIRED(calls, since, changes, work, drifts));
TRAMMEL_FIELDS(Results, optional("numerical_uncertainty", &S::uncertainty_coverage),
               TRAMMEL_REQUIRED(format, environment, cases, references, runs),
               TRAMMEL_OPTIONAL(solver, cost, claims, coverage, effect_scenes, history, store));

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
          std::ranges::any_of(cheapest.tied, [count](std::size_t tied) { return tied >= count; }))
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
  const auto found =
      std::ranges::find_if(entries, [&](const Entry& entry) { return entry.id == id; });
  return found == entries.end() ? nullptr : &*found;
}

}  // namespace

std::string Place::pointer() const {
  if (!parent) return "";
  return (Json::json_pointer(parent->pointer()) / key).to_string();
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
    if (std::ranges::none_of(results.cases,
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
ModelProbabilities read_model_probabilities(const Json& json) {
  return from_json<ModelProbabilities>(json);
}
CostStudies read_cost_studies(const Json& json) {
  return from_json<CostStudies>(json);
}

bool CoverageRow::is_verified() const {
  return std::ranges::any_of(evidence,
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
  return harness::contains(log, axis);
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
