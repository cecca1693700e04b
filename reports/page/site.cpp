#include "reports/page/site.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "reports/data/check_text.h"
#include "reports/page/render.h"
#include "reports/sections/sections.h"
#include "reports/text/files.h"
#include "reports/text/html.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

using Json = nlohmann::json;

constexpr std::size_t kMaxDrawingBytes = 3'200'000;  ///< of a single file: a mail may carry 6 MB
constexpr const char* kNoDrawing = "<p class=\"muted\">This drawing is left out.</p>";
constexpr const char *kBody = "<!--body-->", *kLeftOut = "<!--left out-->";

/// A page with some sections: the keys of their data are the names of their templates.
struct SectionPage {
  const char *path, *title;
  std::vector<const char*> keys;
};
const std::vector<SectionPage>& section_pages() {
  static const std::vector<SectionPage> pages = {
      {"paper.html", "The paper", {"claims", "known"}},
      {"cost.html", "Accuracy and computing time", {"cost"}},
      {"stress.html", "Numerical stability", {"stress_suite"}},
      {"effects.html", "Effects", {"effects"}},
      {"orders.html", "Orders of convergence", {"orders"}},
      {"uncertainty.html", "Validation uncertainty", {"validation_uncertainty"}},
      {"coverage.html", "Coverage", {"coverage"}},
      {"faults.html", "Seeded faults and rounding", {"detection", "certification"}},
      {"environment.html", "Environment", {"environment", "history"}}};
  return pages;
}

/// What every template finds; headings below a page's title start with h`level`.
Data page_data(bool single, int level) {
  Data data = object({{"single", single},
                      {"level", std::to_string(level)},
                      {"sublevel", std::to_string(level + 1)}});
  set_partials(
      data, {"summary", "front", "claims_table", "questions", "roles", "families", "variants",
             "figure", "checks", "matrix", "counts", "rows", "head", "matrix_row", "cell", "find"});
  return data;
}

/// Whether a section has anything to show; parts of the program itself only with the catalogue.
bool is_there(const Data& index, const std::string& key) {
  const Data* rows = index.get(key)->get("has_rows");
  return rows == nullptr || rows->is_true();
}

Data index_data(const Results& results, const std::vector<Family>& families,
                const CostPanels& panels, const std::optional<Figure>& over_time, bool single) {
  Data index = page_data(single, 2);
  const Data of_catalogue = object({{"has_rows", results.claims.has_value()}});
  const auto group = [&](const Family& family) {
    Data data = object();
    const Data section = family_section(family, results);
    for (const char* key : {"family_link", "family_title", "extent", "counts"})
      data.set(key, *section.get(key));
    return data;
  };
  set(index, {{"environment", environment_section(results)},
              {"claims", claims_section(results)},
              {"known", known_section(results, families)},
              {"cost", cost_section(results, families, panels)},
              {"stress_suite", stress_suite_section(families)},
              {"effects", effects_section(panels)},
              {"orders", orders_section(results, families)},
              {"validation_uncertainty", validation_uncertainty_section(families)},
              {"coverage", coverage_section(results, true)},
              {"detection", of_catalogue},
              {"certification", of_catalogue},
              {"history", history_section(results, over_time)},
              {"has_catalogue", results.claims.has_value()},
              {"missing", results.missing},
              {"has_runs", !results.runs.empty() || panels.empty()},
              {"summary", summary_section(results, families)},
              {"front", front_section(results, families, panels, count_printed(results))},
              {"families", list_of(families, group)}});
  return index;
}

bool is_there(const Data& index, const SectionPage& page) {
  return std::ranges::any_of(page.keys, [&](const char* key) { return is_there(index, key); });
}

/// The front page and the pages of sections for the contents of every page.
Data index_contents(const Data& index) {
  Data out = list();
  out.push_back(object({{"title", "Overview"}, {"link", "index.html"}}));
  for (const SectionPage& page : section_pages())
    if (is_there(index, page)) out.push_back(object({{"title", page.title}, {"link", page.path}}));
  return out;
}

void copy(const Data& from, Data& to, std::initializer_list<const char*> keys) {
  for (const char* key : keys) to.set(key, *from.get(key));
}

/// The families for the contents; on a page of its own, a family has its cases open.
Data family_contents(const std::vector<Data>& sections, const std::string& path) {
  return list_of(sections, [&](const Data& section) {
    Data family = object();
    copy(section, family,
         {"family_link", "family_title", "cases_count", "status_text", "status_class", "sign"});
    const auto& entries = section.get("cases")->list_value();
    const auto stands_here = [&](const Data& entry) {
      return text_under(entry, "case_link") == path;
    };
    const bool is_here = text_under(section, "family_link") == path;
    const bool open = is_here || std::ranges::any_of(entries, stands_here);
    const bool has_cases = open || path == "index.html";
    const auto case_contents = [&](const Data& entry) {
      Data contents = object({{"is_here", stands_here(entry)}});
      copy(entry, contents, {"case_link", "short_title", "status_text", "status_class", "sign"});
      return contents;
    };
    set(family, {{"is_here", is_here},
                 {"open", open},
                 {"has_cases", has_cases},
                 {"cases", has_cases ? list_of(entries, case_contents) : list()}});
    return family;
  });
}

/// All checks for the search of the index, as a script, which a page opened from a file can load: a
/// row for each check of each variant, of its worst entry.
std::string check_list(const std::vector<Family>& families) {
  Json json = {{"cases", Json::array()}, {"rows", Json::array()}, {"roles", Json::array()}};
  for (const CheckStatus status : kAllCheckStatuses)
    json["statuses"].push_back(
        {to_text(status), css_class(status), sign(status), severity(status)});
  std::map<std::string, std::size_t> roles;
  for (const Family& family : families)
    for (const CaseInfo* info : family.cases) {
      for (const Run* run : family.runs_of(info->id))
        for (const CheckGroup& group : group_checks(*run)) {
          const Check& worst = group.worst();
          const auto [role, fresh] = roles.emplace(worst.role, roles.size());
          if (fresh) json["roles"].push_back(worst.role);
          const double share = tolerance_fraction(worst);
          json["rows"].push_back(
              {json["cases"].size(), run->variant, check_title(worst), quantity_text(worst),
               role->second, static_cast<int>(check_status(worst)),
               std::isfinite(share) ? Json(std::round(1000 * share) / 1000) : Json(),
               slug(worst.name)});
        }
      json["cases"].push_back(
          {info->id, info->title, family.title, info->labels, case_link(info->id)});
    }
  return "window.trammelChecks = " + json.dump(-1, ' ', false, Json::error_handler_t::replace) +
         ";\n";
}

/// The frame around all bodies.
struct Frame {
  const Results& results;
  Data contents;
  std::vector<Data> families;  ///< their sections
  bool single;

  /// @param own  title, subtitle, way up and status of the page
  [[nodiscard]] std::string around(const std::string& path, Data own,
                                   const std::string& body) const {
    set(own, {{"environment", environment_section(results)},
              {"sections", contents},
              {"families", family_contents(families, path)},
              {"is_index", path == "index.html"},
              {"at_references", path == "references.html"},
              {"has_references", !results.references.empty()},
              {"single", single},
              {"style", template_text("figure.css") + template_text("style.css")},
              {"script", template_text("page.js")},
              {"body", body},
              {"left_out", kLeftOut}});
    return render("page.mustache", own);
  }
};

Data titled(const std::string& title) {
  return object({{"heading", title},
                 {"page_title", title},
                 {"subtitle", ""},
                 {"above", ""},
                 {"status_class", ""}});
}

Data titled_index(const Data& index) {
  const bool runs = index.get("has_runs")->is_true();
  Data data = titled(runs ? "Verification and validation report" : "Accuracy and computing time");
  data.set("subtitle", "Flexible-link planar parallel manipulators");
  if (runs) data.set("page_title", *index.get("summary")->get("verdict"));
  return data;
}

Data titled_by(const Data& section, const char* title) {
  Data data = titled(text_under(section, title));
  copy(section, data, {"status_class", "status_text", "sign"});
  return data;
}

/// The template of this name, filled in with what it finds under the same.
/// @param level  of its headings where one file holds all
std::string body_of(const std::string& name, const Data& section, bool single, int level) {
  Data data = page_data(single, single ? level : 2);
  data.set(name, section);
  return render(name + ".mustache", data);
}

std::string family_body(const Data& section, bool single) {
  return body_of("family", section, single, 3);
}
std::string case_body(const Data& section, bool single) {
  return body_of("case", section, single, 4);
}
std::string references_body(const Data& references, bool single) {
  return body_of("references", references, single, 3);
}

std::string sections_body(const Data& index, const SectionPage& page, bool single) {
  std::string body;
  for (const char* key : page.keys)
    if (is_there(index, key)) body += body_of(key, *index.get(key), single, 2);
  const std::string path = page.path, name = path.substr(0, path.find('.'));
  if (body.find(" id=\"" + name + "\"") == std::string::npos)
    body.insert(0, "<div id=\"" + name + "\"></div>\n");
  return body;
}

/// Without runs the page has the studies of cost and effects.
std::string index_body(const Data& index, bool single) {
  std::string body = render("index.mustache", index);
  if (index.get("has_runs")->is_true()) return body;
  for (const char* key : {"cost", "effects"})
    if (is_there(index, key)) body += body_of(key, *index.get(key), single, 2);
  return body;
}

void replace(std::string& html, const std::string& mark, const std::string& text) {
  html.replace(html.find(mark), mark.size(), text);
}

/// Keeps the first drawing of each page before the second of any, as long as all stay below
/// `max_bytes`. @returns how many are left out.
std::size_t leave_out_drawings(const std::vector<std::vector<Figure*>>& pages,
                               std::size_t max_bytes) {
  std::size_t size = 0, left_out = 0, longest = 0;
  for (const auto& page : pages) longest = std::max(longest, page.size());
  for (std::size_t rank = 0; rank < longest; ++rank) {
    for (const auto& page : pages) {
      if (rank >= page.size()) continue;
      Figure& figure = *page[rank];
      figure.is_linked = false;
      if (size + figure.svg.size() > max_bytes) figure.svg = kNoDrawing, ++left_out;
      size += figure.svg.size();
    }
  }
  return left_out;
}

}  // namespace

std::vector<SiteFile> site_files(const Results& results, const std::vector<Family>& families,
                                 const CostPanels& panels, const std::optional<Figure>& over_time) {
  const Data index = index_data(results, families, panels, over_time, false);
  Frame frame{results, index_contents(index), {}, false};
  for (const Family& family : families) frame.families.push_back(family_section(family, results));
  std::vector<SiteFile> files;
  const auto add = [&](const std::string& path, const Data& title, const std::string& body) {
    files.push_back({path, linked_from(frame.around(path, title, body), path)});
  };
  for (std::size_t f = 0; f < families.size(); ++f) {
    const Data& section = frame.families[f];
    add(family_link(families[f].id), titled_by(section, "family_title"),
        family_body(section, false));
    for (const CaseInfo* info : families[f].cases) {
      const Data data = case_section(*info, families[f], results);
      Data title = titled_by(data, "case_title");
      set(title, {{"above", families[f].title}, {"above_link", family_link(families[f].id)}});
      add(case_link(info->id), title, case_body(data, false));
    }
  }
  if (!results.references.empty())
    add("references.html", titled("References"),
        references_body(references_section(results), false));
  for (const SectionPage& page : section_pages())
    if (is_there(index, page))
      add(page.path, titled(page.title), sections_body(index, page, false));
  add("index.html", titled_index(index), index_body(index, false));
  files.push_back({"style.css", template_text("style.css")});
  files.push_back({"figures/figure.css", template_text("figure.css")});
  files.push_back({"report.js", template_text("page.js")});
  files.push_back({"checks/index.js", check_list(families)});
  return files;
}

std::string single_page(const Results& results, std::vector<Family> families, CostPanels panels,
                        std::optional<Figure> over_time) {
  std::vector<std::vector<Figure*>> pages = {panels.figures()};
  if (over_time) pages.front().push_back(&*over_time);
  for (Family& family : families)
    for (auto& [id, gallery] : family.galleries) gallery.folded.clear();
  for (auto& page : figures_by_page(families)) pages.push_back(std::move(page));
  const std::size_t left_out = leave_out_drawings(pages, kMaxDrawingBytes);
  const Data index = index_data(results, families, panels, over_time, true);
  Frame frame{results, index_contents(index), {}, true};
  std::string body = linked_within(index_body(index, true), "index.html");
  for (const SectionPage& page : section_pages())
    if (is_there(index, page)) body += linked_within(sections_body(index, page, true), page.path);
  for (const Family& family : families) {
    frame.families.push_back(family_section(family, results));
    body += linked_within(family_body(frame.families.back(), true), family_link(family.id));
    for (const CaseInfo* info : family.cases)
      body +=
          linked_within(case_body(case_section(*info, family, results), true), case_link(info->id));
  }
  if (!results.references.empty())
    body += linked_within(references_body(references_section(results), true), "references.html");
  Data title = titled_index(index);
  std::string html = linked_within(frame.around("index.html", title, kBody), "index.html");
  replace(html, kBody, body);
  std::string note =
      "All of it in one file: without the figures of further variants, the tables of every check "
      "where they are long and how references are derived again";
  if (left_out > 0) note += ", and without " + count(left_out, "drawing") + " for its size";
  replace(html, kLeftOut, note + ". The report in many pages has them.");
  return html;
}

}  // namespace trammel::reports
