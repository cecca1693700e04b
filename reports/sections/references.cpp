#include "reports/sections/references.h"

#include <algorithm>
#include <array>
#include <set>

#include "reports/drawing/figure.h"
#include "reports/sections/check_status_data.h"
#include "reports/text/html.h"
#include "reports/text/number.h"
#include "reports/text/quantity.h"

namespace trammel::reports {

namespace {

constexpr std::size_t kMaxUnfoldedValues = 8;

struct Kind {
  const char *name, *meaning;
};
constexpr std::array<Kind, 5> kKinds = {{
    {"proved", "proved: enclosed by ball arithmetic, none missed; 30 digits"},
    {"exact", "exact: from a closed form, re-derived by a program of its own"},
    {"computed", "computed by an independent program"},
    {"paper", "printed in a publication"},
    {"code", "published by another code"},
}};

std::string kind_meaning(const std::string& kind) {
  for (const Kind& known : kKinds)
    if (kind == known.name) return known.meaning;
  return kind;
}

std::string value_text(const Reference& reference, std::size_t i) {
  if (i < reference.printed.size()) return reference.printed[i];
  return reference.values[i] ? trimmed(*reference.values[i], 15) : "–";
}

std::string uncertainty_text(const Reference& reference, std::size_t i) {
  if (reference.uncertainty.empty()) return "";
  const std::size_t at = reference.uncertainty.size() == 1 ? 0 : i;
  if (at >= reference.uncertainty.size() || !reference.uncertainty[at]) return "";
  return "± " + trimmed(*reference.uncertainty[at], 2);
}

Data values_of(const Reference& reference) {
  Data out = list();
  for (std::size_t i = 0; i < reference.values.size(); ++i) {
    Data value = object();
    set_text(value, "i", reference.values.size() > 1 ? std::to_string(i + 1) : "");
    value.set("value", value_text(reference, i));
    set_text(value, "uncertainty", uncertainty_text(reference, i));
    out.push_back(value);
  }
  return out;
}

Data used_by(const Results& results, const std::string& id) {
  std::set<std::string> seen;
  Data out = list();
  const auto use = [&](const std::string& case_id, const std::string& reference) {
    if (reference != id || !seen.insert(case_id).second) return;
    Data data = object();
    data.set("case_title", results.case_info(case_id).title);
    data.set("case_link", case_link(case_id));
    out.push_back(data);
  };
  for (const Run& run : results.runs) {
    for (const Check& check : run.checks) use(run.case_id, check.reference);
    for (const Convergence& sweep : run.convergence) use(run.case_id, sweep.reference);
  }
  return out;
}

Data provenance(const Reference& reference, const Results& results) {
  Data data = object();
  data.set("anchor", "ref-" + slug(reference.id));
  data.set("reference_id", reference.id);
  data.set("reference_title", reference.title);
  data.set("kind", kind_meaning(reference.kind));
  set_text(data, "unit", display_unit(reference.unit));
  set_text(data, "citation", reference.citation);
  set_text(data, "doi", reference.doi);
  set_text(data, "place", reference.place);
  set_text(data, "derivation", reference.derivation);
  set_text(data, "notes", reference.notes);
  Data errata = list();
  for (const std::string& text : reference.errata) {
    Data erratum = object();
    erratum.set("text", text);
    errata.push_back(erratum);
  }
  set_flag(data, "has_errata", !reference.errata.empty());
  data.set("errata", errata);
  const bool few = reference.values.size() <= kMaxUnfoldedValues;
  set_flag(data, "few_values", few && !reference.values.empty());
  set_text(data, "many_values", few ? "" : count(reference.values.size(), "value"));
  data.set("values", values_of(reference));
  data.set("used_by", used_by(results, reference.id));
  return data;
}

}  // namespace

Data references_section(const Results& results) {
  Data out = list();
  for (const Reference& reference : results.references)
    out.push_back(provenance(reference, results));
  return out;
}

}  // namespace trammel::reports
