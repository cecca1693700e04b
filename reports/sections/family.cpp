#include "harness/base/text.h"
#include "harness/results/run_grade.h"
#include "reports/sections/sections.h"
#include "reports/text/number.h"

namespace trammel::reports {

Data status_data(CheckStatus status, std::initializer_list<Entry> entries) {
  Data data = object(entries);
  const StatusStyle& style = find_style(status);
  set(data, {{"status_text", style.text}, {"status_class", style.css_class}, {"sign", style.sign}});
  return data;
}

Data data_of_status_counts(const Counts& counts) {
  Data out = list();
  const auto all = static_cast<double>(total(counts));
  for (const auto& [status, n] : counts)
    out.push_back(
        status_data(status, {{"n", std::to_string(n)},
                             {"percent", shortest_decimal(100.0 * static_cast<double>(n) / all)}}));
  return out;
}

std::string case_link(const std::string& id) {
  return "cases/" + slug(id) + ".html";
}
std::string family_link(const std::string& id) {
  return "families/" + slug(id) + ".html";
}
std::string reference_link(const std::string& id) {
  return "references.html#ref-" + slug(id);
}

std::string run_name(const CaseInfo& info) {
  return info.file.empty() ? info.id : harness::shell_quoted(info.file);
}

Data figure_data(const Figure& figure) {
  return object({{"id", figure.id},
                 {"figure_title", figure.title},
                 {"caption", figure.caption},
                 {"svg", figure.svg},
                 {"file", "figures/" + figure.id},
                 {"size", std::to_string(figure.width) + " / " + std::to_string(figure.height)},
                 {"link", figure.is_linked ? "figures/" + figure.id + ".svg" : ""}});
}

namespace {

Counts counts_of_checks(const std::vector<const Run*>& runs) {
  Counts counts;
  for (const Run* run : runs) add_check_counts(counts, *run);
  return counts;
}

/// Returns the most severe status among the runs and all their checks.
CheckStatus worst_status(const std::vector<const Run*>& runs) {
  Counts counts = counts_of_checks(runs);
  for (const Run* run : runs)
    if (find_status(*run) != CheckStatus::passes) ++counts[find_status(*run)];
  for (const CheckStatus status :
       {CheckStatus::error, CheckStatus::fails, CheckStatus::changed_discrepancy,
        CheckStatus::known_discrepancy, CheckStatus::passes, CheckStatus::not_judged})
    if (count_of(counts, status) > 0) return status;
  return CheckStatus::not_run;
}

/// Returns the runs that were not solved, with their reasons.
Data endings(const CaseInfo& info, const std::vector<const Run*>& runs) {
  Data out = list();
  for (const Run* run : runs)
    if (run->status != Status::solved)
      out.push_back(status_data(find_status(*run), {{"variant", info.variant_title(run->variant)},
                                                    {"status", to_string(run->status)},
                                                    {"reason", run->reason}}));
  return out;
}

Data warnings(const CaseInfo& info, const std::vector<const Run*>& runs) {
  Data out = list();
  for (const Run* run : runs)
    for (const std::string& text : run->warnings)
      out.push_back(object({{"variant", info.variant_title(run->variant)}, {"text", text}}));
  return out;
}

/// Returns the template data of a case for the table of contents and for the page of its family.
Data case_entry(const CaseInfo& info, const Family& family) {
  const std::vector<const Run*> runs = family.runs_of(info.id);
  return status_data(worst_status(runs),
                     {{"case_link", case_link(info.id)},
                      {"case_id", info.id},
                      {"run_name", run_name(info)},
                      {"case_title", info.title},
                      {"short_title", family.short_title(info)},
                      {"variants_count", runs.size() > 1 ? count(runs.size(), "variant") : ""},
                      {"counts", data_of_status_counts(counts_of_checks(runs))}});
}

/// Returns the first still drawing (SVG) of a mode shape, deformed shape or geometry among the
/// cases of a family, as a thumbnail.
std::string thumbnail_of_family(const Family& family) {
  for (const CaseInfo* info : family.cases)
    for (const auto part : {&Gallery::shown, &Gallery::sketch})
      for (const Figure& figure : family.galleries.at(info->id).*part) {
        const std::string still = figure.svg.substr(0, figure.svg.find("<style>"));
        const bool is_plot = still.find(" data-axes=") != std::string::npos;
        const bool is_small = still.size() <= 5000 || family.cases.size() == 1;
        if (is_small && (!is_plot || family.galleries.at(info->id).sketch.empty()))
          return still + (still == figure.svg ? "" : "</svg>");
      }
  return "";
}

/// Returns the largest difference from a target as text: "+332 %, frequency (Hz)". Empty if every
/// check passes.
std::string largest_difference_text(const std::vector<const Run*>& runs) {
  const Check* worst = nullptr;
  for (const Run* run : runs)
    if (const Check* check = results::decisive_check(*run);
        check != nullptr && (worst == nullptr || is_worse_than(*check, *worst)))
      worst = check;
  const bool differs = worst != nullptr && find_status(*worst) != CheckStatus::passes;
  return differs ? difference_text(*worst) + ", " + quantity_text(*worst) : "";
}

}  // namespace

Data groups_of_families(const std::vector<Family>& families) {
  Data groups = list();
  for (auto family = families.begin(); family != families.end();) {
    const Family& first = *family;
    std::vector<const Run*> runs;
    std::size_t cases = 0;
    std::string thumbnail;
    for (; family != families.end() && family->group == first.group; ++family) {
      runs.insert(runs.end(), family->runs.begin(), family->runs.end());
      cases += family->cases.size();
      if (thumbnail.empty()) thumbnail = thumbnail_of_family(*family);
    }
    groups.push_back(object({{"family_link", family_link(first.id)},
                             {"group_title", first.group},
                             {"cases_count", count(cases, "case")},
                             {"counts", data_of_status_counts(counts_of_checks(runs))},
                             {"thumbnail", thumbnail},
                             {"largest", largest_difference_text(runs)}}));
  }
  return groups;
}

Data case_section(const CaseInfo& info, const Family& family, const Results& results) {
  const std::vector<const Run*> runs = family.runs_of(info.id);
  const Gallery& gallery = family.galleries.at(info.id);
  const Data warned = warnings(info, runs);
  Data data = case_entry(info, family);
  set(data, {{"description", info.description},
             {"labels", texts(info.labels)},
             {"endings", endings(info, runs)},
             {"warnings", warned},
             {"warnings_title",
              warned.is_non_empty_list() ? count(warned.list_value().size(), "warning") : ""},
             {"problems", texts(gallery.problems)},
             {"sketch", list_of(gallery.sketch, figure_data)},
             {"has_figures", !gallery.shown.empty()},
             {"figures", list_of(gallery.shown, figure_data)},
             {"folded_figures_title",
              gallery.folded.empty() ? "" : count(gallery.folded.size(), "further figure")},
             {"folded_figures", list_of(gallery.folded, figure_data)},
             {"tables", case_check_tables(info, runs, results)},
             {"variant_tables", object({{"tables", variant_tables(info, runs)}})},
             {"csv", "checks/" + slug(info.id) + ".csv"}});
  set_run_tables(data, info, runs);
  return data;
}

Data family_section(const Family& family, const Results& results) {
  const std::string cases_count = count(family.cases.size(), "case");
  const Counts counts = counts_of_checks(family.runs);
  const Data matrices = comparison_matrices(family, results);
  const auto entry = [&](const CaseInfo* info) { return case_entry(*info, family); };
  return status_data(worst_status(family.runs),
                     {{"family_link", family_link(family.id)},
                      {"family_title", family.title},
                      {"cases_count", cases_count},
                      {"extent", cases_count + ", " + count(total(counts), "check")},
                      {"counts", data_of_status_counts(counts)},
                      {"has_overview", !family.overview.empty()},
                      {"overview", list_of(family.overview, figure_data)},
                      {"has_common", !family.overview.empty() || matrices.is_non_empty_list()},
                      {"matrices", matrices},
                      {"cases", list_of(family.cases, entry)}});
}

}  // namespace trammel::reports
