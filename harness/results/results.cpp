#include "harness/results/results.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <map>
#include <system_error>

#include "harness/base/find_or_add.h"
#include "harness/results/result_fields.h"

namespace trammel::results {

namespace {

/// Requires that every vector of a convergence study has one entry per refinement level.
void complete(Convergence& study, const Place& place) {
  const std::size_t levels = study.parameter.size();
  for (std::size_t i = 0; i < levels; ++i) {
    // If a refinement level has no value of the refined parameter, the number of the level (from 1)
    // replaces the value.
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

/// Requires that all node indices in a drawing refer to existing nodes.
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
        Place{&entry_place, member_key}.fail("one pair of numbers per node, " +
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
      Place{&outputs, "errors"}.fail(std::to_string(count) + " numbers, one per setting");
  }
}

/// Sets missing titles of figures and tables, and a missing family, to the id.
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
  const auto found = std::ranges::find_if(entries, [&](const Entry& e) { return e.id == id; });
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

/// Texts shared by many objects. Each text is stored once in a list, and the objects contain its
/// index.
struct SharedTexts {
  const char* list;
  std::vector<const char*> members;
  const char* fault;
  std::vector<Json*> (*holders)(Json& json);
};

std::vector<Json*> find_checks(Json& json) {
  std::vector<Json*> checks;
  if (json.contains("runs"))
    for (Json& run : json.at("runs"))
      if (run.is_object() && run.contains("checks"))
        for (Json& check : run.at("checks")) checks.push_back(&check);
  return checks;
}

std::vector<Json*> find_references(Json& json) {
  std::vector<Json*> references;
  if (json.contains("references"))
    for (Json& reference : json.at("references")) references.push_back(&reference);
  return references;
}

const std::array<SharedTexts, 4> kSharedTexts = {{
    {"names",
     {"name", "quantity", "reference", "against_variant", "against_quantity"},
     "one name for each index in the checks",
     find_checks},
    {"reasons", {"why", "title", "message"}, "one text for each index in the checks", find_checks},
    {"citations",
     {"citation", "doi", "place"},
     "one text for each index in the references",
     find_references},
    {"notes", {"notes"}, "one note for each index in the references", find_references},
}};

void share_repeated_texts(Json& json, const SharedTexts& shared) {
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

/// Replaces indices in JSON objects by the texts with these indices in the shared list.
void restore_shared_texts(Json& json, const SharedTexts& shared) {
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

void complete_and_validate(Results& results) {
  const Place root;
  if (results.format != 1 && results.format != 2) Place{&root, "format"}.fail("1 or 2");
  for (CaseInfo& info : results.cases) complete(info);
  const Place runs{&root, "runs"};
  for (std::size_t i = 0; i < results.runs.size(); ++i) {
    Run& run = results.runs[i];
    const Place place{&runs, std::to_string(i)};
    // The case must be listed, because the report prints its title.
    if (std::ranges::none_of(results.cases,
                             [&](const CaseInfo& info) { return info.id == run.case_id; }))
      Place{&place, "case"}.fail("a case listed under /cases");
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

Json to_json(const Results& results, bool summary) {
  Json json = to_json<Results>(results, summary ? Form::summary : Form::text);
  for (const SharedTexts& shared : kSharedTexts) share_repeated_texts(json, shared);
  return json;
}

bool CoverageRow::is_verified() const {
  return std::ranges::any_of(evidence,
                             [](const std::string& kind) { return kind != "self-consistency"; });
}

Results read_results(Json json) {
  for (const SharedTexts& shared : kSharedTexts) restore_shared_texts(json, shared);
  auto results = from_json<Results>(json);
  complete_and_validate(results);
  return results;
}

Results read_results(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::system_error(EIO, std::generic_category(), file.string() + ": not readable");
  try {
    return read_results(Json::parse(in));
  } catch (const Json::parse_error& error) {
    throw std::runtime_error(file.string() + ": not JSON at byte " + std::to_string(error.byte));
  } catch (const Json::out_of_range&) {
    throw std::runtime_error(file.string() + ": /: a number outside the range of double precision");
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

const std::vector<double>* Run::quantity(const std::string& name) const {
  const auto found = quantities.find(name);
  return found == quantities.end() ? nullptr : &found->second.values;
}

Number Run::error_half_width(const std::string& name, std::size_t index) const {
  const std::vector<double>* values = quantity(name);
  const ErrorEstimate* found = errors ? errors->find(name) : nullptr;
  if (found == nullptr || values == nullptr || index >= values->size()) return {};
  return found->error_half_width(index, (*values)[index]);
}

const ErrorEstimate* ErrorEstimates::find(const std::string& quantity) const {
  const auto found = std::ranges::find(quantities, quantity, &ErrorEstimate::quantity);
  return found == quantities.end() ? nullptr : &*found;
}

Number ErrorEstimate::error_half_width(std::size_t index, double value) const {
  const Number error = relative.size() == 1      ? relative.front()
                       : index < relative.size() ? relative[index]
                                                 : Number();
  if (!error) return error;
  return *error * std::max(std::abs(value), scale.value_or(0));
}

std::size_t Cost::counted_work() const {
  std::size_t sum = 0;
  for (const auto& counter : counters) sum += counter.second;
  return sum;
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
  if (!found) throw std::logic_error("the results do not contain the case " + id);
  return *found;
}

const Reference* Results::reference(const std::string& id) const {
  return find_id(references, id);
}

Number ErrorNorms::get(const std::string& norm) const {
  return norm == "max" ? max : norm == "rms" ? rms : mean;
}

Number CostStudy::error_of(const CostSetting& setting) const {
  return setting.errors ? setting.errors->get(norm) : Number();
}

Number difference_of_check(const Check& check) {
  const double computed = *check.computed, expected = *check.expected;
  if (check.measure == "relative") return (computed - expected) / std::abs(expected);
  if (check.measure == "absolute") return computed - expected;
  return check.measure == "ratio" ? computed / expected : Number();
}

std::string to_string(Verdict verdict) {
  return detail::name_of(verdict);
}
std::string verdict_text(const Check& check) {
  const bool changed = check.verdict == Verdict::fail;
  if (check.is_known_discrepancy() && (changed || check.verdict == Verdict::pass))
    return changed ? "changed discrepancy" : "known discrepancy";
  if (check.verdict == Verdict::recorded) return "not judged";
  std::string text = to_string(check.verdict);
  std::ranges::replace(text, '-', ' ');
  return text;
}
std::string to_string(Status status) {
  return detail::name_of(status);
}

}  // namespace trammel::results
