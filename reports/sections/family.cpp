#include "reports/sections/family.h"

#include <algorithm>

#include "reports/data/check_status.h"
#include "reports/data/model_probabilities.h"
#include "reports/sections/check_status_data.h"
#include "reports/sections/effects.h"
#include "reports/sections/matrix.h"
#include "reports/sections/tables.h"
#include "reports/sections/variant_tables.h"
#include "reports/text/html.h"
#include "reports/text/number.h"

namespace trammel::reports {

Data figure_data(const Figure& figure) {
  Data data = object();
  data.set("id", figure.id);
  data.set("number", std::to_string(figure.number));
  data.set("figure_title", figure.title);
  set_text(data, "caption", figure.caption);
  data.set("svg", figure.svg);
  data.set("file", "figures/" + figure.id);
  data.set("size", std::to_string(figure.width) + " / " + std::to_string(figure.height));
  set_text(data, "link", figure.is_linked ? "figures/" + figure.id + ".svg" : "");
  return data;
}

namespace {

Data figures_data(const std::vector<Figure>& figures) {
  Data out = list();
  for (const Figure& figure : figures) out.push_back(figure_data(figure));
  return out;
}

Counts counts_of(const std::vector<const Run*>& runs) {
  Counts counts;
  for (const Run* run : runs) add(counts, *run);
  return counts;
}

/// The one sign of many checks and runs: the worst of them.
CheckStatus overall(const std::vector<const Run*>& runs) {
  const Counts counts = counts_of(runs);
  const auto any_run = [&](CheckStatus which) {
    return std::ranges::any_of(runs, [&](const Run* run) { return check_status(*run) == which; });
  };
  for (const CheckStatus bad : {CheckStatus::error, CheckStatus::fails})
    if (count_of(counts, bad) > 0 || any_run(bad)) return bad;
  for (const CheckStatus some :
       {CheckStatus::known_discrepancy, CheckStatus::passes, CheckStatus::not_judged})
    if (count_of(counts, some) > 0) return some;
  return CheckStatus::not_run;
}

Data endings(const CaseInfo& info, const std::vector<const Run*>& runs) {
  Data out = list();
  for (const Run* run : runs) {
    if (run->status == Status::solved) continue;
    Data data = object();
    data.set("variant", info.variant_title(run->variant));
    data.set("status", to_string(run->status));
    set_text(data, "reason", run->reason);
    set_check_status(data, check_status(*run));
    out.push_back(data);
  }
  return out;
}

Data warnings(const CaseInfo& info, const std::vector<const Run*>& runs) {
  Data out = list();
  for (const Run* run : runs) {
    for (const std::string& text : run->warnings) {
      Data data = object();
      data.set("variant", info.variant_title(run->variant));
      data.set("text", text);
      out.push_back(data);
    }
  }
  return out;
}

Data texts(const std::vector<std::string>& strings) {
  Data out = list();
  for (const std::string& text : strings) {
    Data data = object();
    data.set("text", text);
    out.push_back(data);
  }
  return out;
}

/// What the contents and the page of its family say of a case.
Data case_entry(const CaseInfo& info, const Family& family) {
  const std::vector<const Run*> runs = family.runs_of(info.id);
  Data data = object();
  data.set("case_link", case_link(info.id));
  data.set("case_id", info.id);
  data.set("case_title", info.title);
  data.set("short_title", family.short_title(info));
  set_text(data, "variants_count", runs.size() > 1 ? count(runs.size(), "variant") : "");
  data.set("counts", counts_list(counts_of(runs)));
  set_check_status(data, overall(runs));
  return data;
}

}  // namespace

Data case_section(const CaseInfo& info, const Family& family, const Results& results) {
  const std::vector<const Run*> runs = family.runs_of(info.id);
  const Gallery& gallery = family.galleries.at(info.id);
  Data data = case_entry(info, family);
  data.set("case_anchor", case_anchor(info.id));
  data.set("family_title", family.title);
  data.set("family_link", family_link(family.id));
  set_text(data, "description", info.description);
  data.set("labels", texts(info.labels));
  data.set("endings", endings(info, runs));
  data.set("warnings", warnings(info, runs));
  set_effects(data, runs);
  set_model_probabilities(data, runs);
  data.set("problems", texts(gallery.problems));
  set_flag(data, "has_figures", !gallery.shown.empty() || !gallery.problems.empty());
  data.set("figures", figures_data(gallery.shown));
  set_text(data, "folded_figures_title",
           gallery.folded.empty() ? "" : count(gallery.folded.size(), "further figure"));
  data.set("folded_figures", figures_data(gallery.folded));
  data.set("tables", case_tables(info, runs, results));
  const Data tables = variant_tables(info, runs);
  set_flag(data, "has_variant_tables", tables.is_non_empty_list());
  data.set("variant_tables", tables);
  data.set("csv", "checks/" + slug(info.id) + ".csv");
  return data;
}

Data family_section(const Family& family, const Results& results) {
  Data data = object();
  data.set("family_anchor", "family-" + slug(family.id));
  data.set("family_link", family_link(family.id));
  data.set("family_title", family.title);
  const std::string cases_count = count(family.cases.size(), "case");
  data.set("cases_count", cases_count);
  data.set("extent", cases_count + ", " + count(total(counts_of(family.runs)), "check"));
  data.set("counts", counts_list(counts_of(family.runs)));
  set_check_status(data, overall(family.runs));
  set_flag(data, "has_overview", !family.overview.empty());
  data.set("overview", figures_data(family.overview));
  const Data matrices = comparison_matrices(family, results);
  set_flag(data, "has_common", !family.overview.empty() || matrices.is_non_empty_list());
  data.set("matrices", matrices);
  Data cases = list();
  for (const CaseInfo* info : family.cases) cases.push_back(case_entry(*info, family));
  data.set("cases", cases);
  return data;
}

}  // namespace trammel::reports
