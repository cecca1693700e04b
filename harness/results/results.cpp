#include "harness/results/results.h"

#include <algorithm>
#include <array>
#include <fstream>

#include "harness/results/fields.h"

namespace trammel::results {

template <>
inline constexpr std::array kNames<Verdict> = {
    std::pair{"pass", Verdict::pass}, std::pair{"fail", Verdict::fail},
    std::pair{"error", Verdict::error}, std::pair{"not-run", Verdict::not_run},
    std::pair{"recorded", Verdict::recorded}};
template <>
inline constexpr std::array kNames<Expectation> = {
    std::pair{"agrees", Expectation::agrees},
    std::pair{"known-discrepancy", Expectation::known_discrepancy},
    std::pair{"none", Expectation::none}};
template <>
inline constexpr std::array kNames<Status> = {
    std::pair{"solved", Status::solved}, std::pair{"singular", Status::singular},
    std::pair{"not-converged", Status::not_converged}, std::pair{"error", Status::error},
    std::pair{"not-run", Status::not_run}};

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
    std::tuple{required("coefficients", &TwoTermLaw::coefficients),
               required("max_relative_misfit", &TwoTermLaw::max_relative_misfit),
               required("used", &TwoTermLaw::used)};
template <>
inline constexpr auto kFields<Check> =
    std::tuple{required("name", &Check::name),
               optional("title", &Check::title),
               required("quantity", &Check::quantity),
               required("index", &Check::index),
               optional("statistic", &Check::statistic),
               required("computed", &Check::computed),
               required("expected", &Check::expected),
               required("unit", &Check::unit),
               optional("reference", &Check::reference),
               optional("against_variant", &Check::against_variant),
               optional("against_quantity", &Check::against_quantity),
               required("role", &Check::role),
               required("measure", &Check::measure),
               required("difference", &Check::difference),
               required("tolerance", &Check::tolerance),
               required("why", &Check::why),
               required("expectation", &Check::expectation),
               required("verdict", &Check::verdict),
               required("message", &Check::message)};
template <>
inline constexpr auto kFields<Convergence> =
    std::tuple{required("sweep", &Convergence::sweep),
               required("parameter", &Convergence::parameter),
               required("quantity", &Convergence::quantity),
               required("index", &Convergence::index),
               optional("statistic", &Convergence::statistic),
               required("values", &Convergence::values),
               optional("reference", &Convergence::reference),
               required("exact", &Convergence::exact),
               required("error", &Convergence::error),
               required("roundoff", &Convergence::roundoff),
               required("order", &Convergence::order),
               required("in_asymptotic_range", &Convergence::in_asymptotic_range),
               required("at_roundoff_floor", &Convergence::at_roundoff_floor),
               required("theory_order", &Convergence::theory_order),
               optional("lower_order", &Convergence::lower_order),
               optional("two_term", &Convergence::two_term),
               required("fitted_order", &Convergence::fitted_order),
               required("richardson", &Convergence::richardson),
               required("gci", &Convergence::gci),
               required("safety_factor", &Convergence::safety_factor)};
template <>
inline constexpr auto kFields<UncertainInput> = std::tuple{
    required("name", &UncertainInput::name), required("pointers", &UncertainInput::pointers),
    required("half_width", &UncertainInput::half_width),
    required("nominal", &UncertainInput::nominal), required("why", &UncertainInput::why)};
template <>
inline constexpr auto kFields<NumericalEstimate> =
    std::tuple{required("refinement", &NumericalEstimate::refinement),
               required("quantity", &NumericalEstimate::quantity),
               required("index", &NumericalEstimate::index),
               required("parameter", &NumericalEstimate::parameter),
               required("values", &NumericalEstimate::values),
               required("order", &NumericalEstimate::order),
               required("safety_factor", &NumericalEstimate::safety_factor),
               required("half_width", &NumericalEstimate::half_width)};
template <>
inline constexpr auto kFields<AllInputsComparison> =
    std::tuple{required("u_input", &AllInputsComparison::u_input),
               required("u_input_sampled", &AllInputsComparison::u_input_sampled),
               required("u_val", &AllInputsComparison::u_val),
               required("interval", &AllInputsComparison::interval),
               required("verdict", &AllInputsComparison::verdict),
               required("conclusion", &AllInputsComparison::conclusion)};
template <>
inline constexpr auto kFields<Comparison> =
    std::tuple{required("check", &Comparison::check),
               required("quantity", &Comparison::quantity),
               required("index", &Comparison::index),
               required("unit", &Comparison::unit),
               required("reference", &Comparison::reference),
               required("simulation", &Comparison::simulation),
               required("expected", &Comparison::expected),
               required("u_num", &Comparison::u_num),
               required("u_input", &Comparison::u_input),
               required("u_input_sampled", &Comparison::u_input_sampled),
               required("u_reference", &Comparison::u_reference),
               required("contributions", &Comparison::contributions),
               required("dominant_input", &Comparison::dominant_input),
               required("dominant_share", &Comparison::dominant_share),
               required("spread", &Comparison::spread),
               required("difference", &Comparison::difference),
               required("u_val", &Comparison::u_val),
               required("interval", &Comparison::interval),
               required("verdict", &Comparison::verdict),
               required("conclusion", &Comparison::conclusion),
               required("all_inputs", &Comparison::all_inputs)};
template <>
inline constexpr auto kFields<Uncertainty> =
    std::tuple{required("inputs", &Uncertainty::inputs),
               required("samples", &Uncertainty::samples),
               required("failed", &Uncertainty::failed),
               required("samples_all_inputs", &Uncertainty::samples_all_inputs),
               required("failed_all_inputs", &Uncertainty::failed_all_inputs),
               required("numerical", &Uncertainty::numerical),
               required("comparisons", &Uncertainty::comparisons)};
template <>
inline constexpr auto kFields<Joint> = std::tuple{
    required("node", &Joint::node), required("kind", &Joint::kind), required("name", &Joint::name)};
template <>
inline constexpr auto kFields<Shape> =
    std::tuple{required("label", &Shape::label), required("displacement_m", &Shape::displacement)};
template <>
inline constexpr auto kFields<Pose> =
    std::tuple{required("label", &Pose::label), required("nodes_m", &Pose::nodes)};
template <>
inline constexpr auto kFields<Drawing> =
    std::tuple{required("nodes_m", &Drawing::nodes),       required("members", &Drawing::members),
               required("triangles", &Drawing::triangles), required("joints", &Drawing::joints),
               required("shapes", &Drawing::shapes),       optional("poses", &Drawing::poses)};
template <>
inline constexpr auto kKeyMember<EvaluationTiming> = &EvaluationTiming::name;
template <>
inline constexpr auto kFields<EvaluationTiming> =
    std::tuple{required("per_evaluation_s", &EvaluationTiming::per_evaluation_s),
               required("evaluations", &EvaluationTiming::evaluations)};
template <>
inline constexpr auto kFields<Cost> = std::tuple{
    required("wall_s", &Cost::wall_s), required("cpu_s", &Cost::cpu_s),
    required("counters", &Cost::counters),
    optional("uncertainty_wall_s", &Cost::uncertainty_wall_s), optional("timings", &Cost::timings)};
template <>
inline constexpr auto kFields<EffectRow> =
    std::tuple{required("effect", &EffectRow::name),
               required("applicable", &EffectRow::applicable),
               required("active", &EffectRow::active),
               required("why", &EffectRow::why),
               required("evaluations", &EffectRow::evaluations),
               optional("dimensionless_number", &EffectRow::dimensionless_number),
               optional("number_definition", &EffectRow::number_definition),
               optional("estimated_change", &EffectRow::estimated_change)};
template <>
inline constexpr auto kFields<Run> = std::tuple{required("case", &Run::case_id),
                                                required("variant", &Run::variant),
                                                required("status", &Run::status),
                                                required("reason", &Run::reason),
                                                required("quantities", &Run::quantities),
                                                required("checks", &Run::checks),
                                                required("convergence", &Run::convergence),
                                                optional("uncertainty", &Run::uncertainty),
                                                optional("effects", &Run::effects),
                                                optional("drawing", &Run::drawing),
                                                required("cost", &Run::cost)};
template <>
inline constexpr auto kFields<ErrorNorms> =
    std::tuple{required("max", &ErrorNorms::max), required("rms", &ErrorNorms::rms),
               required("mean", &ErrorNorms::mean)};
template <>
inline constexpr auto kFields<SettingTime> =
    std::tuple{required("cpu_s", &SettingTime::cpu_s),
               required("lower_quartile_s", &SettingTime::lower_quartile_s),
               required("upper_quartile_s", &SettingTime::upper_quartile_s),
               required("spread", &SettingTime::spread),
               required("wall_median_s", &SettingTime::wall_median_s),
               required("runs_per_measurement", &SettingTime::runs_per_measurement)};
template <>
inline constexpr auto kFields<CostSetting> =
    std::tuple{required("curve", &CostSetting::curve),
               required("curve_title", &CostSetting::curve_title),
               required("title", &CostSetting::title),
               required("value", &CostSetting::value),
               required("status", &CostSetting::status),
               required("reason", &CostSetting::reason),
               required("error", &CostSetting::errors),
               required("cpu_s", &CostSetting::cpu_s),
               required("relative_time", &CostSetting::relative),
               required("time", &CostSetting::time),
               required("counters", &CostSetting::counters),
               required("pareto_optimal", &CostSetting::pareto_optimal)};
template <>
inline constexpr auto kFields<CheapestSetting> = std::tuple{
    required("error", &CheapestSetting::error), required("setting", &CheapestSetting::setting)};
template <>
inline constexpr auto kFields<Repeatability> =
    std::tuple{required("on_both_fronts", &Repeatability::on_both_fronts),
               required("on_either_front", &Repeatability::on_either_front),
               required("same_cheapest", &Repeatability::same_cheapest),
               required("target_errors", &Repeatability::target_errors),
               required("median_difference", &Repeatability::median_difference),
               required("largest_difference", &Repeatability::largest_difference)};
template <>
inline constexpr auto kFields<CostStudy> =
    std::tuple{required("id", &CostStudy::id),
               required("family", &CostStudy::family),
               required("title", &CostStudy::title),
               optional("description", &CostStudy::description),
               required("reference_solution", &CostStudy::reference_solution),
               required("scale", &CostStudy::scale),
               required("norm", &CostStudy::norm),
               required("baseline", &CostStudy::baseline),
               required("wall_s", &CostStudy::wall_s),
               required("settings", &CostStudy::settings),
               required("cheapest", &CostStudy::cheapest),
               required("repeatability", &CostStudy::repeatability),
               required("conclusion", &CostStudy::conclusion)};
template <>
inline constexpr auto kFields<CostStudies> =
    std::tuple{required("sweep", &CostStudies::sweep),
               required("seed", &CostStudies::seed),
               required("repeats", &CostStudies::repeats),
               required("max_spread", &CostStudies::max_spread),
               required("equal_within", &CostStudies::equal_within),
               required("diverged_above", &CostStudies::diverged_above),
               required("studies", &CostStudies::studies)};
template <>
inline constexpr auto kFields<Environment> =
    std::tuple{required("trammel", &Environment::trammel),
               required("commit", &Environment::commit),
               required("date", &Environment::date),
               required("compiler", &Environment::compiler),
               required("flags", &Environment::flags),
               required("build_type", &Environment::build_type),
               required("libraries", &Environment::libraries),
               required("processor", &Environment::processor),
               required("cores", &Environment::cores),
               required("system", &Environment::system)};
template <>
inline constexpr auto kKeyMember<PlotRequest::Line> = &PlotRequest::Line::title;
template <>
inline constexpr auto kFields<PlotRequest::Line> =
    std::tuple{required("x", &PlotRequest::Line::x), required("y", &PlotRequest::Line::y)};
template <>
inline constexpr auto kKeyMember<PlotRequest> = &PlotRequest::id;
template <>
inline constexpr auto kFields<PlotRequest> =
    std::tuple{optional("title", &PlotRequest::title), optional("x", &PlotRequest::x),
               required("y", &PlotRequest::y),         optional("variants", &PlotRequest::variants),
               optional("log", &PlotRequest::log),     optional("value", &PlotRequest::value),
               optional("lines", &PlotRequest::lines), optional("caption", &PlotRequest::caption)};
template <>
inline constexpr auto kKeyMember<ColumnRequest> = &ColumnRequest::id;
template <>
inline constexpr auto kFields<ColumnRequest> = std::tuple{
    required("title", &ColumnRequest::title), optional("quantity", &ColumnRequest::quantity),
    optional("statistic", &ColumnRequest::statistic), optional("timing", &ColumnRequest::timing),
    optional("over_timing", &ColumnRequest::over_timing)};
template <>
inline constexpr auto kKeyMember<TableRequest> = &TableRequest::id;
template <>
inline constexpr auto kFields<TableRequest> = std::tuple{
    optional("title", &TableRequest::title), required("columns", &TableRequest::columns),
    optional("variants", &TableRequest::variants), optional("caption", &TableRequest::caption)};
template <>
inline constexpr auto kFields<StressSuiteEntry> =
    std::tuple{required("item", &StressSuiteEntry::item),
               required("indicators", &StressSuiteEntry::indicators)};
template <>
inline constexpr auto kKeyMember<Variant> = &Variant::id;
template <>
inline constexpr auto kFields<Variant> = std::tuple{required("title", &Variant::title)};
template <>
inline constexpr auto kKeyMember<CaseInfo> = &CaseInfo::id;
template <>
inline constexpr auto kFields<CaseInfo> =
    std::tuple{required("title", &CaseInfo::title),
               optional("description", &CaseInfo::description),
               optional("family", &CaseInfo::family),
               optional("labels", &CaseInfo::labels),
               optional("stress_suite", &CaseInfo::stress_suite),
               optional("figures", &CaseInfo::figures),
               optional("tables", &CaseInfo::tables),
               optional("analysis", &CaseInfo::analysis),
               required("variants", &CaseInfo::variants)};
template <>
inline constexpr auto kKeyMember<Reference> = &Reference::id;
template <>
inline constexpr auto kFields<Reference> =
    std::tuple{required("title", &Reference::title),
               required("kind", &Reference::kind),
               required("unit", &Reference::unit),
               required("values", &Reference::values),
               required("uncertainty", &Reference::uncertainty),
               required("citation", &Reference::citation),
               required("place", &Reference::place),
               optional("doi", &Reference::doi),
               optional("printed", &Reference::printed),
               optional("derivation", &Reference::derivation),
               optional("errata", &Reference::errata),
               optional("notes", &Reference::notes)};
template <>
inline constexpr auto kFields<UncertaintyCoverage> =
    std::tuple{required("levels", &UncertaintyCoverage::levels),
               required("covered", &UncertaintyCoverage::covered),
               required("coverage", &UncertaintyCoverage::coverage),
               required("min_coverage", &UncertaintyCoverage::min_coverage),
               required("median_ratio", &UncertaintyCoverage::median_ratio),
               required("max_median_ratio", &UncertaintyCoverage::max_median_ratio),
               required("min_levels", &UncertaintyCoverage::min_levels),
               required("passes", &UncertaintyCoverage::passes)};
template <>
inline constexpr auto kFields<ClaimEntry> =
    std::tuple{required("case", &ClaimEntry::case_id), required("variant", &ClaimEntry::variant),
               required("name", &ClaimEntry::name), required("value", &ClaimEntry::value)};
template <>
inline constexpr auto kFields<ClaimInterpretation> = std::tuple{
    required("description", &ClaimInterpretation::description),
    required("metric", &ClaimInterpretation::metric), required("unit", &ClaimInterpretation::unit),
    required("verdict", &ClaimInterpretation::verdict),
    required("entries", &ClaimInterpretation::entries)};
template <>
inline constexpr auto kFields<Claim> =
    std::tuple{required("id", &Claim::id),
               required("claim", &Claim::claim),
               required("place", &Claim::place),
               required("verdict", &Claim::verdict),
               required("expected", &Claim::expected),
               required("conclusion", &Claim::conclusion),
               required("undecidable", &Claim::undecidable),
               required("interpretations", &Claim::interpretations)};
template <>
inline constexpr auto kFields<Claims> =
    std::tuple{required("title", &Claims::title), required("as_recorded", &Claims::as_recorded),
               required("claims", &Claims::claims)};
template <>
inline constexpr auto kFields<Results> =
    std::tuple{required("format", &Results::format),
               required("environment", &Results::environment),
               required("cases", &Results::cases),
               required("references", &Results::references),
               optional("numerical_uncertainty", &Results::uncertainty_coverage),
               required("runs", &Results::runs),
               optional("cost", &Results::cost),
               optional("claims", &Results::claims)};

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
}

void require_consistent(const CostStudy& study, const Place& place) {
  const std::size_t count = study.settings.size();
  const std::string expected = "an integer from 0 to " + std::to_string(count - 1);
  if (study.baseline >= count) Place{&place, "baseline"}.fail(expected);
  for (const CheapestSetting& cheapest : study.cheapest)
    if (cheapest.setting && *cheapest.setting >= count) Place{&place, "cheapest"}.fail(expected);
}

/// Titles that are left out are the names.
void complete(CaseInfo& info) {
  const auto complete_title = [](auto& entry) {
    if (entry.title.empty()) entry.title = entry.id;
  };
  if (info.family.empty()) info.family = info.id;
  for (PlotRequest& figure : info.figures) complete_title(figure);
  for (TableRequest& table : info.tables) {
    complete_title(table);
    for (ColumnRequest& column : table.columns)
      if (column.statistic.empty()) column.statistic = "first";
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

nlohmann::ordered_json claims_to_json(const Claims& claims) {
  return to_json(claims);
}

Json to_json(const Results& results) {
  return to_json<Results>(results);
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

Results read_results(const Json& json) {
  auto results = from_json<Results>(json);
  complete(results);
  return results;
}

Results read_results(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file.string() + ": cannot be read");
  try {
    return read_results(Json::parse(in));
  } catch (const Json::parse_error& error) {
    throw std::runtime_error(file.string() + ": not JSON at byte " + std::to_string(error.byte));
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

Number CostSetting::relative_to_baseline(double SettingTime::*seconds) const {
  if (!time) return std::nullopt;
  return relative.value_or(0) / cpu_s * ((*time).*seconds);
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
