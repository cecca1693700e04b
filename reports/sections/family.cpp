#include <algorithm>

#include "reports/data/check_text.h"
#include "reports/sections/sections.h"
#include "reports/text/html.h"
#include "reports/text/number.h"

namespace trammel::reports {

Data figure_data(const Figure& figure) {
  return object({{"id", figure.id},
                 {"number", std::to_string(figure.number)},
                 {"figure_title", figure.title},
                 {"caption", figure.caption},
                 {"svg", figure.svg},
                 {"file", "figures/" + figure.id},
                 {"size", std::to_string(figure.width) + " / " + std::to_string(figure.height)},
                 {"link", figure.is_linked ? "figures/" + figure.id + ".svg" : ""}});
}

namespace {

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
    out.push_back(with_status(check_status(*run), {{"variant", info.variant_title(run->variant)},
                                                   {"status", to_string(run->status)},
                                                   {"reason", run->reason}}));
  }
  return out;
}

Data warnings(const CaseInfo& info, const std::vector<const Run*>& runs) {
  Data out = list();
  for (const Run* run : runs)
    for (const std::string& text : run->warnings)
      out.push_back(object({{"variant", info.variant_title(run->variant)}, {"text", text}}));
  return out;
}

/// What the contents and the page of its family say of a case.
Data case_entry(const CaseInfo& info, const Family& family) {
  const std::vector<const Run*> runs = family.runs_of(info.id);
  return with_status(overall(runs),
                     {{"case_link", case_link(info.id)},
                      {"case_id", info.id},
                      {"case_title", info.title},
                      {"short_title", family.short_title(info)},
                      {"variants_count", runs.size() > 1 ? count(runs.size(), "variant") : ""},
                      {"counts", counts_list(counts_of(runs))}});
}

}  // namespace

Data case_section(const CaseInfo& info, const Family& family, const Results& results) {
  const std::vector<const Run*> runs = family.runs_of(info.id);
  const Gallery& gallery = family.galleries.at(info.id);
  const Data tables = variant_tables(info, runs);
  const Data warned = warnings(info, runs);
  Data data = case_entry(info, family);
  set(data, {{"case_anchor", case_anchor(info.id)},
             {"family_title", family.title},
             {"family_link", family_link(family.id)},
             {"description", info.description},
             {"labels", texts(info.labels)},
             {"endings", endings(info, runs)},
             {"warnings", warned},
             {"warnings_title",
              warned.is_non_empty_list() ? count(warned.list_value().size(), "warning") : ""},
             {"warnings_open", warned.list_value().size() <= 2},
             {"problems", texts(gallery.problems)},
             {"has_figures", !gallery.shown.empty() || !gallery.problems.empty()},
             {"figures", list_of(gallery.shown, figure_data)},
             {"folded_figures_title",
              gallery.folded.empty() ? "" : count(gallery.folded.size(), "further figure")},
             {"folded_figures", list_of(gallery.folded, figure_data)},
             {"tables", case_tables(info, runs, results)},
             {"has_variant_tables", tables.is_non_empty_list()},
             {"variant_tables", tables},
             {"csv", "checks/" + slug(info.id) + ".csv"}});
  set_errors(data, runs);
  set_effects(data, runs);
  set_model_probabilities(data, runs);
  return data;
}

Data family_section(const Family& family, const Results& results) {
  const std::string cases_count = count(family.cases.size(), "case");
  const Counts counts = counts_of(family.runs);
  const Data matrices = comparison_matrices(family, results);
  const auto entry = [&](const CaseInfo* info) { return case_entry(*info, family); };
  return with_status(overall(family.runs),
                     {{"family_anchor", "family-" + slug(family.id)},
                      {"family_link", family_link(family.id)},
                      {"family_title", family.title},
                      {"cases_count", cases_count},
                      {"extent", cases_count + ", " + count(total(counts), "check")},
                      {"counts", counts_list(counts)},
                      {"has_overview", !family.overview.empty()},
                      {"overview", list_of(family.overview, figure_data)},
                      {"has_common", !family.overview.empty() || matrices.is_non_empty_list()},
                      {"matrices", matrices},
                      {"cases", list_of(family.cases, entry)}});
}

}  // namespace trammel::reports
