#include "reports/data/results.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "reports/data/json_view.h"

namespace trammel::reports {

namespace {

constexpr int kAnyIndex = std::numeric_limits<int>::max();

template <typename Value>
Value parse_name(const JsonView& view, const std::vector<std::pair<std::string, Value>>& names) {
  const std::string name = view.text();
  std::string expected = "one of";
  for (const auto& [known, value] : names) {
    if (known == name) return value;
    expected += " " + known;
  }
  view.fail(expected);
}

const std::vector<std::pair<std::string, Verdict>>& verdicts() {
  static const std::vector<std::pair<std::string, Verdict>> names = {
      {"pass", Verdict::pass},
      {"fail", Verdict::fail},
      {"error", Verdict::error},
      {"not-run", Verdict::not_run},
      {"recorded", Verdict::recorded}};
  return names;
}

const std::vector<std::pair<std::string, Status>>& statuses() {
  static const std::vector<std::pair<std::string, Status>> names = {
      {"solved", Status::solved},
      {"singular", Status::singular},
      {"not-converged", Status::not_converged},
      {"error", Status::error},
      {"not-run", Status::not_run}};
  return names;
}

Numbers numbers(const JsonView& view) {
  Numbers out;
  for (const JsonView& entry : view.entries()) out.push_back(entry.optional_number());
  return out;
}

std::vector<std::string> texts(const JsonView& view) {
  std::vector<std::string> out;
  for (const JsonView& entry : view.entries()) out.push_back(entry.text());
  return out;
}

std::vector<Point> points(const JsonView& view) {
  std::vector<Point> out;
  for (const JsonView& entry : view.entries()) {
    const auto xy = entry.entries();
    if (xy.size() != 2) entry.fail("two numbers");
    constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();  // is not drawn
    out.emplace_back(xy[0].optional_number().value_or(nowhere),
                     xy[1].optional_number().value_or(nowhere));
  }
  return out;
}

/// A plain number t: |difference| <= t. Two numbers, either of them null: a range. A bound with one
/// number is an upper limit.
std::optional<Tolerance> read_tolerance(const JsonView& view, const std::string& measure) {
  if (view.null()) return std::nullopt;
  Tolerance tolerance;
  if (view.json().is_number()) {
    tolerance.high = view.number();
    tolerance.symmetric = measure != "bound";
    if (tolerance.symmetric) tolerance.low = -view.number();
    return tolerance;
  }
  const auto ends = view.entries();
  if (ends.size() != 2) view.fail("a number or two");
  tolerance.low = ends[0].optional_number();
  tolerance.high = ends[1].optional_number();
  return tolerance;
}

Check read_check(const JsonView& view) {
  Check check;
  check.name = view.at("name").text();
  check.title = view.find("title").text_or("");
  check.quantity = view.at("quantity").text();
  check.unit = view.find("unit").text_or("");
  check.reference = view.find("reference").text_or("");
  check.role = view.at("role").text();
  check.measure = view.find("measure").text_or("");
  check.why = view.find("why").text_or("");
  check.message = view.find("message").text_or("");
  check.statistic = view.find("statistic").text_or("");
  check.against_quantity = view.find("against_quantity").text_or("");
  check.against_variant = view.find("against_variant").text_or("");
  if (!view.find("index").null()) check.index = view.at("index").integer(kAnyIndex);
  check.computed = view.find("computed").optional_number();
  check.expected = view.find("expected").optional_number();
  check.difference = view.find("difference").optional_number();
  check.tolerance = read_tolerance(view.find("tolerance"), check.measure);
  check.known_discrepancy = view.find("expectation").text_or("agrees") == "known-discrepancy";
  check.verdict = parse_name(view.at("verdict"), verdicts());
  return check;
}

/// Levels without a number of their own are numbered.
std::vector<double> read_levels(const JsonView& view) {
  std::vector<double> levels;
  for (const JsonView& level : view.entries()) {
    const auto number = static_cast<double>(levels.size() + 1);
    levels.push_back(level.optional_number().value_or(number));
  }
  return levels;
}

Convergence read_convergence(const JsonView& view) {
  Convergence c;
  c.sweep = view.find("sweep").text_or("");
  c.quantity = view.at("quantity").text();
  c.reference = view.find("reference").text_or("");
  if (!view.find("index").null()) c.index = view.at("index").integer(kAnyIndex);
  c.parameter = read_levels(view.at("parameter"));
  const std::size_t levels = c.parameter.size();
  const auto column = [&](const char* key) {
    Numbers read = numbers(view.find(key));
    if (read.size() > levels) view.at(key).fail("at most " + std::to_string(levels) + " entries");
    read.resize(levels);
    return read;
  };
  c.values = column("values");
  c.error = column("error");
  c.roundoff = column("roundoff");
  c.order = column("order");
  c.gci = column("band");
  for (const JsonView& level : view.find("in_asymptotic_range").entries())
    c.in_asymptotic_range.push_back(!level.null() && level.boolean());
  c.in_asymptotic_range.resize(levels, false);
  for (const JsonView& level : view.find("at_roundoff_floor").entries())
    c.at_roundoff_floor.push_back(!level.null() && level.boolean());
  c.at_roundoff_floor.resize(levels, false);
  c.lower_order = view.find("lower_order").optional_number();
  if (!view.find("two_term").null())
    c.two_term_misfit = view.at("two_term").find("worst").optional_number();
  c.exact = view.find("exact").optional_number();
  c.theory_order = view.find("theory_order").optional_number();
  c.fitted_order = view.find("fitted_order").optional_number();
  c.richardson = view.find("richardson").optional_number();
  return c;
}

/// Sets of one of two sizes.
std::vector<std::vector<int>> node_sets(const JsonView& view, int nodes, std::size_t size,
                                        std::size_t other) {
  std::vector<std::vector<int>> out;
  for (const JsonView& entry : view.entries()) {
    std::vector<int> set;
    for (const JsonView& node : entry.entries()) set.push_back(node.integer(nodes));
    if (set.size() != size && set.size() != other) {
      entry.fail(std::to_string(size) + " node numbers");
    }
    out.push_back(std::move(set));
  }
  return out;
}

std::vector<Point> one_a_node(const JsonView& view, std::size_t nodes) {
  std::vector<Point> out = points(view);
  if (out.size() != nodes) view.fail("one pair of numbers a node, " + std::to_string(nodes));
  return out;
}

Drawing read_drawing(const JsonView& view) {
  Drawing drawing;
  drawing.nodes = points(view.at("nodes_m"));
  const int nodes = static_cast<int>(drawing.nodes.size());
  drawing.members = node_sets(view.find("members"), nodes, 2, 2);
  drawing.triangles = node_sets(view.find("triangles"), nodes, 3, 6);
  for (const JsonView& joint : view.find("joints").entries())
    drawing.joints.push_back(
        {joint.at("node").integer(nodes), joint.at("kind").text(), joint.find("name").text_or("")});
  for (const JsonView& shape : view.find("shapes").entries())
    drawing.shapes.push_back(
        {shape.at("label").text(), one_a_node(shape.at("displacement_m"), drawing.nodes.size())});
  for (const JsonView& pose : view.find("poses").entries())
    drawing.poses.push_back(
        {pose.find("label").text_or(""), one_a_node(pose.at("nodes_m"), drawing.nodes.size())});
  return drawing;
}

Cost read_cost(const JsonView& view) {
  Cost cost;
  if (view.null()) return cost;
  cost.wall_s = view.find("wall_s").optional_number().value_or(0);
  cost.cpu_s = view.find("cpu_s").optional_number().value_or(0);
  for (const auto& [name, count] : view.find("counters").members())
    cost.counters.emplace_back(name, count.number());
  for (const auto& [name, timing] : view.find("timings").members())
    cost.timings.emplace_back(name, timing.at("each_s").number());
  return cost;
}

Comparison read_comparison(const JsonView& view) {
  Comparison c;
  c.check = view.at("check").text();
  c.quantity = view.at("quantity").text();
  c.index = view.at("index").integer(kAnyIndex);
  c.reference = view.at("reference").text();
  c.simulation = view.find("simulation").optional_number();
  c.expected = view.find("expected").optional_number();
  c.difference = view.find("difference").optional_number();
  c.u_num = view.find("u_num").optional_number();
  c.u_input = view.find("u_input").optional_number();
  c.u_reference = view.find("u_reference").optional_number();
  c.u_val = view.find("u_val").optional_number();
  c.dominant_input = view.find("dominant_input").text_or("");
  c.dominant_share = view.find("dominant_share").optional_number();
  c.verdict = view.at("verdict").text();
  c.conclusion = view.find("words").text_or("");
  if (!view.find("literal").null()) {
    c.all_inputs_u_val = view.at("literal").find("u_val").optional_number();
    c.all_inputs_conclusion = view.at("literal").find("words").text_or("");
  }
  return c;
}

UncertaintyCoverage read_uncertainty_coverage(const JsonView& view) {
  UncertaintyCoverage coverage;
  coverage.levels = view.at("levels").integer(kAnyIndex);
  coverage.covered = view.at("hits").integer(kAnyIndex);
  coverage.min_coverage = view.find("least_hit_rate").optional_number();
  coverage.median_ratio = view.find("median_ratio").optional_number();
  coverage.max_median_ratio = view.find("largest_median_ratio").optional_number();
  coverage.passes = view.at("holds").boolean();
  return coverage;
}

EffectRow read_effect(const JsonView& view) {
  return {view.at("effect").text(),
          view.find("number_of").text_or(""),
          view.at("why").text(),
          view.at("admitted").boolean(),
          view.at("on").boolean(),
          view.find("number").optional_number(),
          view.find("change").optional_number()};
}

Run read_run(const JsonView& view) {
  Run run;
  run.case_id = view.at("case").text();
  run.variant = view.find("variant").text_or("base");
  run.reason = view.find("reason").text_or("");
  run.status = parse_name(view.at("status"), statuses());
  for (const auto& [name, values] : view.find("quantities").members())
    run.quantities.emplace_back(name, numbers(values));
  for (const JsonView& check : view.find("checks").entries())
    run.checks.push_back(read_check(check));
  for (const JsonView& sweep : view.find("convergence").entries())
    run.convergence.push_back(read_convergence(sweep));
  if (!view.find("uncertainty").null())
    for (const JsonView& entry : view.at("uncertainty").find("comparisons").entries())
      run.comparisons.push_back(read_comparison(entry));
  if (!view.find("drawing").null()) run.drawing = read_drawing(view.at("drawing"));
  for (const JsonView& effect : view.find("effects").entries())
    run.effects.push_back(read_effect(effect));
  run.cost = read_cost(view.find("cost"));
  return run;
}

TableRequest read_table(const std::string& id, const JsonView& view) {
  TableRequest table;
  table.title = view.find("title").text_or(id.c_str());
  table.caption = view.find("caption").text_or("");
  table.variants = texts(view.find("variants"));
  for (const auto& [name, column] : view.at("columns").members())
    table.columns.push_back(
        {column.find("title").text_or(name.c_str()), column.find("quantity").text_or(""),
         column.find("statistic").text_or("first"), column.find("timing").text_or(""),
         column.find("over_timing").text_or("")});
  return table;
}

ClaimInterpretation read_interpretation(const JsonView& view) {
  ClaimInterpretation interpretation{view.at("what").text(),
                                     view.at("take").text(),
                                     view.at("unit").text(),
                                     view.at("verdict").text(),
                                     {}};
  for (const JsonView& entry : view.at("entries").entries())
    interpretation.entries.push_back(
        {entry.at("case").text(), entry.at("variant").text(), entry.at("value").number()});
  return interpretation;
}

Claims read_claims(const JsonView& view) {
  Claims claims;
  claims.title = view.at("title").text();
  for (const JsonView& item : view.at("claims").entries()) {
    Claim claim{item.at("id").text(),          item.at("claim").text(),
                item.at("place").text(),       item.at("verdict").text(),
                item.at("expected").text(),    item.at("conclusion").text(),
                item.at("undecidable").text(), {}};
    for (const JsonView& interpretation : item.at("readings").entries())
      claim.interpretations.push_back(read_interpretation(interpretation));
    claims.claims.push_back(std::move(claim));
  }
  return claims;
}

CaseInfo read_case(const std::string& id, const JsonView& view) {
  CaseInfo info;
  info.id = id;
  info.title = view.find("title").text_or(id.c_str());
  info.description = view.find("description").text_or("");
  info.family = view.find("family").text_or(id.c_str());
  info.labels = texts(view.find("labels"));
  if (const JsonView suite = view.find("stress_suite"); !suite.null())
    info.stress_suite = {suite.at("item").integer(kAnyIndex), texts(suite.at("indicators"))};
  for (const auto& [figure, plot] : view.find("figures").members()) {
    PlotRequest request;
    request.id = figure;
    request.title = plot.find("title").text_or(figure.c_str());
    request.x = plot.find("x").text_or("");
    request.y = texts(plot.at("y"));
    request.variants = texts(plot.find("variants"));
    request.value = plot.find("value").text_or("");
    for (const auto& [title, line] : plot.find("lines").members()) {
      request.lines.push_back({title, line.find("x").text_or(""), line.find("y").text_or("")});
    }
    request.caption = plot.find("caption").text_or("");
    for (const std::string& axis : texts(plot.find("log"))) {
      (axis == "x" ? request.log_x : request.log_y) = true;
    }
    info.figures.push_back(std::move(request));
  }
  for (const auto& [table, value] : view.find("tables").members())
    info.tables.push_back(read_table(table, value));
  for (const auto& [variant, value] : view.find("variants").members())
    info.variants.emplace_back(variant, value.find("title").text_or(variant.c_str()));
  return info;
}

Reference read_reference(const std::string& id, const JsonView& view) {
  Reference reference;
  reference.id = id;
  reference.title = view.find("title").text_or(id.c_str());
  reference.kind = view.find("kind").text_or("");
  reference.unit = view.find("unit").text_or("");
  reference.citation = view.find("citation").text_or("");
  reference.doi = view.find("doi").text_or("");
  reference.place = view.find("place").text_or("");
  const JsonView derivation = view.find("derivation");
  reference.derivation =
      derivation.json().is_object() ? derivation.json().dump() : derivation.text_or("");
  reference.notes = view.find("notes").text_or("");
  reference.values = numbers(view.find("values"));
  reference.uncertainty = numbers(view.find("uncertainty"));
  reference.printed = texts(view.find("printed"));
  reference.errata = texts(view.find("errata"));
  return reference;
}

void read_environment(const JsonView& view, Results& results) {
  for (const auto& [key, value] : view.members()) {
    if (value.json().is_string()) results.environment[key] = value.text();
    if (value.json().is_number()) results.environment[key] = value.json().dump();
  }
  for (const auto& [name, version] : view.find("libraries").members())
    results.libraries.emplace_back(name, version.text());
}

/// A run's case must be described, or the page could not name it.
void check_cases(const JsonView& runs, const Results& results) {
  for (const JsonView& run : runs.entries()) {
    const std::string id = run.at("case").text();
    const bool known = std::any_of(results.cases.begin(), results.cases.end(),
                                   [&](const CaseInfo& info) { return info.id == id; });
    if (!known) run.at("case").fail("a case that stands under /cases");
  }
}

Results read_all(const JsonView& root) {
  if (root.at("format").integer(kAnyIndex) != 1) root.at("format").fail("1");
  Results results;
  read_environment(root.at("environment"), results);
  for (const auto& [id, view] : root.at("cases").members())
    results.cases.push_back(read_case(id, view));
  for (const auto& [id, view] : root.find("references").members())
    results.references.push_back(read_reference(id, view));
  for (const JsonView& run : root.at("runs").entries()) results.runs.push_back(read_run(run));
  if (!root.find("bands").null())
    results.uncertainty_coverage = read_uncertainty_coverage(root.at("bands"));
  check_cases(root.at("runs"), results);
  if (const JsonView cost = root.find("cost"); !cost.null()) results.cost = read_cost_studies(cost);
  if (const JsonView claims = root.find("ledger"); !claims.null())
    results.claims = read_claims(claims);
  return results;
}

}  // namespace

Results read_results(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file.string() + ": cannot be read");
  Json json;
  try {
    json = Json::parse(in);
  } catch (const Json::parse_error& error) {
    throw std::runtime_error(file.string() + ": not JSON at byte " + std::to_string(error.byte));
  }
  try {
    return read_all(JsonView(json));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

const Numbers* Run::quantity(const std::string& name) const {
  for (const auto& [key, values] : quantities)
    if (key == name) return &values;
  return nullptr;
}

std::string CaseInfo::variant_title(const std::string& variant) const {
  for (const auto& [key, name] : variants)
    if (key == variant) return name;
  return variant;
}

const CaseInfo& Results::case_info(const std::string& id) const {
  const auto found =
      std::find_if(cases.begin(), cases.end(), [&](const CaseInfo& info) { return info.id == id; });
  if (found == cases.end()) throw std::logic_error("no case " + id);
  return *found;
}

const Reference* Results::reference(const std::string& id) const {
  for (const Reference& entry : references)
    if (entry.id == id) return &entry;
  return nullptr;
}

std::string to_string(Verdict verdict) {
  for (const auto& [name, value] : verdicts())
    if (value == verdict) return name;
  throw std::logic_error("unknown verdict");
}

std::string to_string(Status status) {
  for (const auto& [name, value] : statuses())
    if (value == status) return name;
  throw std::logic_error("unknown status");
}

}  // namespace trammel::reports
