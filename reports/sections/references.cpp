#include <array>
#include <set>

#include "reports/sections/sections.h"
#include "reports/text/number.h"
#include "reports/text/quantity.h"

namespace trammel::reports {

namespace {

constexpr std::size_t kMaxUnfoldedValues = 8;

constexpr std::array<std::pair<const char*, const char*>, 5> kKinds = {{
    {"proved", "proved: all values enclosed by ball arithmetic, 30 digits"},
    {"exact", "exact: from a closed form, derived again by a separate program"},
    {"computed", "computed by an independent program"},
    {"paper", "printed in a publication"},
    {"code", "published by another code"},
}};

std::string meaning_of_reference_kind(const std::string& kind) {
  for (const auto& [name, meaning] : kKinds)
    if (kind == name) return meaning;
  return kind;
}

std::string value_text(const Reference& reference, std::size_t i) {
  if (i < reference.printed.size()) return reference.printed[i];
  return reference.values[i] ? trimmed(*reference.values[i], 15) : "–";
}

std::string uncertainty_text(const Reference& reference, std::size_t i) {
  const Numbers& all = reference.uncertainty;
  const std::size_t k = all.size() == 1 ? 0 : i;
  return k < all.size() && all[k] ? "± " + trimmed(*all[k], 2) : "";
}

Data data_of_reference_values(const Reference& reference) {
  Data out = list();
  for (std::size_t i = 0; i < reference.values.size(); ++i)
    out.push_back(object({{"i", reference.values.size() > 1 ? std::to_string(i + 1) : ""},
                          {"value", value_text(reference, i)},
                          {"uncertainty", uncertainty_text(reference, i)}}));
  return out;
}

/// Returns the cases that use a reference.
Data used_by(const Results& results, const std::string& id) {
  std::set<std::string> seen;
  Data out = list();
  const auto use = [&](const std::string& case_id, const std::string& reference) {
    if (reference != id || !seen.insert(case_id).second) return;
    out.push_back(object(
        {{"case_title", results.case_info(case_id).title}, {"case_link", case_link(case_id)}}));
  };
  for (const Run& run : results.runs) {
    for (const Check& check : run.checks) use(run.case_id, check.reference);
    for (const Convergence& sweep : run.convergence) use(run.case_id, sweep.reference);
  }
  return out;
}

Data reference_data(const Reference& reference, const Results& results) {
  const bool few = reference.values.size() <= kMaxUnfoldedValues;
  return object({{"anchor", "ref-" + slug(reference.id)},
                 {"reference_id", reference.id},
                 {"reference_title", reference.title},
                 {"kind", meaning_of_reference_kind(reference.kind)},
                 {"unit", display_unit(reference.unit)},
                 {"citation", reference.citation},
                 {"doi", reference.doi},
                 {"place", reference.place},
                 {"derivation", reference.derivation},
                 {"notes", reference.notes},
                 {"has_errata", !reference.errata.empty()},
                 {"errata", texts(reference.errata)},
                 {"has_ambiguities", !reference.ambiguities.empty()},
                 {"ambiguities", texts(reference.ambiguities)},
                 {"few_values", few && !reference.values.empty()},
                 {"many_values", few ? "" : count(reference.values.size(), "value")},
                 {"values", data_of_reference_values(reference)},
                 {"used_by", used_by(results, reference.id)}});
}

}  // namespace

Data references_section(const Results& results) {
  return list_of(results.references,
                 [&](const Reference& reference) { return reference_data(reference, results); });
}

}  // namespace trammel::reports
