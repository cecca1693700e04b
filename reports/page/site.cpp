#include "reports/page/site.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "reports/data/check_text.h"
#include "reports/page/render.h"
#include "reports/text/files.h"

namespace trammel::reports {

namespace {

using Json = nlohmann::json;

/// A page of the report that consists of sections. The key of a section is the name of its data and
/// of its template.
struct SectionPage {
  const char *path, *title, *short_title;
  std::vector<const char*> keys;
};
const std::vector<SectionPage>& section_pages() {
  static const std::vector<SectionPage> pages = {
      {"summary.html", "Summary for an audit", "Summary", {"audit"}},
      {"paper.html", "The paper", "Paper", {"claims", "known"}},
      {"cost.html", "Accuracy and computing time", "Cost", {"cost"}},
      {"stress.html", "Numerical stability", "Stability", {"stress_suite"}},
      {"effects.html", "Effects", "Effects", {"effects"}},
      {"orders.html", "Orders of convergence", "Orders", {"orders"}},
      {"uncertainty.html", "Validation uncertainty", "Uncertainty", {"validation_uncertainty"}},
      {"coverage.html", "Coverage", "Coverage", {"coverage"}},
      {"faults.html", "Seeded faults and rounding", "Faults", {"detection", "certification"}},
      {"environment.html", "Environment", "Environment", {"history", "environment"}}};
  return pages;
}

/// Returns true if a section of the report has content. Some sections have content only for the
/// full catalogue of cases.
bool has_content(const Data& index, const std::string& key) {
  const Data* rows = index.get(key)->get("has_rows");
  return rows == nullptr || rows->is_true();
}
bool has_content(const Data& index, const SectionPage& page) {
  return std::ranges::any_of(page.keys, [&](const char* key) { return has_content(index, key); });
}

void copy(const Data& from, Data& to, std::initializer_list<const char*> keys) {
  for (const char* key : keys) to.set(key, *from.get(key));
}

/// Returns the data of the front page and of all pages of sections.
Data site_data(const Results& results, const std::vector<Family>& families,
               const StudyFigures& figures) {
  const Data of_catalogue = object({{"has_rows", results.claims.has_value()}});
  const Data summary = summary_section(results, families);
  return object(
      {{"environment", environment_section(results)},
       {"claims", claims_section(results)},
       {"known", discrepancy_section(results, families)},
       {"audit", audit_section(results, families, summary)},
       {"cost", cost_section(results, figures)},
       {"stress_suite", stress_suite_section(families, figures)},
       {"effects", effects_section(results, figures)},
       {"orders", convergence_section(results, families, figures)},
       {"validation_uncertainty", validation_uncertainty_section(families, figures)},
       {"coverage", coverage_section(results)},
       {"detection", of_catalogue},
       {"certification", of_catalogue},
       {"history", call_history_section(results, figures)},
       {"has_catalogue", results.claims.has_value()},
       {"missing", results.missing},
       {"has_runs", !results.runs.empty() || (figures.cost.empty() && figures.effects.empty())},
       {"summary", summary},
       {"front", front_page_section(results, families, figures)},
       {"groups", groups_of_families(families)}});
}

/// Returns links to the front page and to the pages of sections, for the navigation bar of the page
/// at `path`.
Data links_to_pages(const Data& index, const std::string& path, bool has_references) {
  Data out = list();
  const auto add = [&](const std::string& title, const std::string& link) {
    out.push_back(object({{"title", title}, {"link", link}, {"is_here", link == path}}));
  };
  add("Overview", "index.html");
  for (const SectionPage& page : section_pages())
    if (has_content(index, page)) add(page.short_title, page.path);
  if (has_references) add("References", "references.html");
  if (index.get("has_runs")->is_true()) add("Search", "index.html#find");
  return out;
}

/// Returns the families for the table of contents of the page at `path`. The family to which this
/// page belongs is unfolded, so that its cases are listed.
Data family_contents(const std::vector<Data>& sections, const std::string& path) {
  return list_of(sections, [&](const Data& section) {
    const auto& entries = section.get("cases")->list_value();
    const auto is_here = [&](const Data& e) { return text_variable(e, "case_link") == path; };
    const bool is_family = text_variable(section, "family_link") == path;
    const bool open = is_family || std::ranges::any_of(entries, is_here);
    const auto contents = [&](const Data& entry) {
      Data data = object({{"is_here", is_here(entry)}});
      copy(entry, data, {"case_link", "short_title", "status_text", "status_class", "sign"});
      return data;
    };
    Data family = object({{"is_here", is_family},
                          {"open", open},
                          {"cases", open ? list_of(entries, contents) : list()}});
    copy(section, family,
         {"family_link", "family_title", "cases_count", "status_text", "status_class", "sign"});
    return family;
  });
}

/// Returns the data for the search on the front page: a row for each check of each variant, with
/// its value of the most severe status. The data are a script, because a page from a local file
/// cannot load JSON.
std::string check_search_script(const std::vector<Family>& families) {
  Json json = {{"cases", Json::array()}, {"rows", Json::array()}, {"roles", Json::array()}};
  for (const StatusStyle& style : kStatusStyles)
    json["statuses"].push_back({style.text, style.css_class, style.sign, style.severity});
  std::map<std::string, std::size_t> roles;
  for (const Family& family : families)
    for (const CaseInfo* info : family.cases) {
      for (const Run* run : family.runs_of(info->id))
        for (const CheckGroup& group : group_checks(*run)) {
          const Check& worst = group.worst();
          const auto [role, is_new] = roles.emplace(worst.role, roles.size());
          if (is_new) json["roles"].push_back(worst.role);
          const double share = difference_over_tolerance(worst);
          json["rows"].push_back(
              {json["cases"].size(), run->variant, check_title(worst), quantity_text(worst),
               role->second, static_cast<int>(find_status(worst)),
               std::isfinite(share) ? Json(std::round(1000 * share) / 1000) : Json(),
               slug(worst.name)});
        }
      json["cases"].push_back(
          {run_name(*info), info->title, family.title, info->labels, case_link(info->id)});
    }
  return "window.trammelChecks = " + json.dump(-1, ' ', false, Json::error_handler_t::replace) +
         ";\n";
}

Data page_heading(const Data& section, const char* title) {
  Data data = object({{"heading", text_variable(section, title)}});
  copy(section, data, {"status_class", "status_text", "sign"});
  return data;
}

/// Returns the HTML of the template `name`, filled in with the data `section`.
std::string body_of(const std::string& name, const Data& section) {
  return render(name + ".mustache", object({{name, section}}));
}

/// Returns the HTML of the sections of a page. A section can also contain figures of the front
/// page.
std::string html_of_sections(const Data& index, const std::vector<const char*>& keys) {
  std::string body;
  for (const std::string key : keys)
    if (has_content(index, key))
      body += render(key + ".mustache",
                     object({{key, *index.get(key)}, {"front", *index.get("front")}}));
  return body;
}

}  // namespace

std::vector<SiteFile> site_files(const Results& results, const std::vector<Family>& families,
                                 const StudyFigures& figures) {
  std::vector<Data> sections;
  for (const Family& family : families) sections.push_back(family_section(family, results));
  const Data index = site_data(results, families, figures);
  std::vector<SiteFile> files;
  const auto add = [&](const std::string& path, Data page, const std::string& body) {
    set(page, {{"environment", *index.get("environment")},
               {"sections", links_to_pages(index, path, !results.references.empty())},
               {"families", family_contents(sections, path)},
               {"is_index", path == "index.html"},
               {"has_sidebar", path != "index.html" && !families.empty()},
               {"body", body}});
    files.push_back({path, with_relative_links(render("page.mustache", page), path)});
  };
  for (std::size_t f = 0; f < families.size(); ++f) {
    const std::string link = family_link(families[f].id);
    add(link, page_heading(sections[f], "family_title"), body_of("family", sections[f]));
    const auto& cases = families[f].cases;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const Data data = case_section(*cases[i], families[f], results);
      Data title = page_heading(data, "case_title");
      set(title, {{"above", families[f].title},
                  {"above_link", link},
                  {"previous", i > 0 ? case_link(cases[i - 1]->id) : ""},
                  {"next", i + 1 < cases.size() ? case_link(cases[i + 1]->id) : ""}});
      add(case_link(cases[i]->id), title, body_of("case", data));
    }
  }
  if (!results.references.empty())
    add("references.html", object({{"heading", "References"}}),
        body_of("references", references_section(results)));
  for (const SectionPage& page : section_pages())
    if (has_content(index, page))
      add(page.path, object({{"heading", page.title}}), html_of_sections(index, page.keys));
  const bool has_runs = index.get("has_runs")->is_true();
  add("index.html",
      object({{"heading",
               has_runs ? "Verification and validation report" : "Accuracy and computing time"}}),
      render("index.mustache", index) +
          (has_runs ? "" : html_of_sections(index, {"cost", "effects"})));
  files.push_back({"style.css", template_text("style.css")});
  files.push_back({"figures/figure.css", template_text("figure.css")});
  files.push_back({"report.js", template_text("page.js")});
  files.push_back({"checks/index.js", check_search_script(families)});
  return files;
}

}  // namespace trammel::reports
