#include "reports/page/render.h"

#include <algorithm>
#include <array>
#include <functional>
#include <stdexcept>
#include <string_view>

#include "reports/text/files.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

/// Names of the templates in reports/templates that other templates can include.
constexpr std::array<const char*, 18> kPartials = {
    "cell",   "checks", "claims_table", "counts",  "error_coverage", "families",
    "figure", "find",   "front",        "head",    "matrix",         "questions",
    "roles",  "rows",   "study",        "summary", "table",          "tables"};

/// Replaces numbers such as 1e-6 by 10⁻⁶ in an HTML text, except in code, styles, scripts and
/// metadata.
std::string typeset_powers_in_html(const std::string& html) {
  constexpr std::array<std::string_view, 4> kUnchanged = {"code", "style", "script", "metadata"};
  std::string out;
  for (std::size_t from = 0; from < html.size();) {
    const std::size_t tag = std::min(html.find('<', from), html.size());
    out += with_powers_of_ten(html.substr(from, tag - from));
    from = html.find('>', tag);
    for (const std::string_view name : kUnchanged)
      if (html.compare(std::min(tag + 1, html.size()), name.size(), name) == 0)
        from = html.find("</" + std::string(name), tag);
    from = from == std::string::npos ? html.size() : from + 1;
    out.append(html, tag, from - tag);
  }
  return out;
}

/// Applies the function `change` to all values of an attribute in an HTML text. The values must be
/// in double quotes.
std::string change_attribute_values(const std::string& html, const std::string& attribute,
                                    const std::function<std::string(const std::string&)>& change) {
  const std::string open = " " + attribute + "=\"";
  std::string out;
  std::size_t from = 0;
  for (std::size_t at = html.find(open); at != std::string::npos; at = html.find(open, from)) {
    const std::size_t begin = at + open.size(), end = html.find('"', begin);
    out.append(html, from, begin - from);
    out += change(html.substr(begin, end - begin));
    from = end;
  }
  return out.append(html, from);
}

}  // namespace

std::string render(const std::string& template_name, Data data) {
  for (const std::string name : kPartials)
    data.set(name + "_partial", kainjow::mustache::partial(
                                    [file = name + ".mustache"] { return template_text(file); }));
  kainjow::mustache::mustache page(template_text(template_name));
  std::string html = page.render(data);
  if (!page.is_valid()) throw std::logic_error(template_name + ": " + page.error_message());
  std::ranges::replace_if(
      html, [](char c) { return is_control(c) && c != '\n' && c != '\t'; }, ' ');
  return typeset_powers_in_html(html);
}

std::string with_relative_links(const std::string& html, const std::string& page) {
  const auto change = [&](const std::string& target) {
    if (target.empty() || target[0] == '#' || target.starts_with("https:")) return target;
    if (target.starts_with(page + "#")) return target.substr(page.size());
    return (page.find('/') == std::string::npos ? "" : "../") + target;
  };
  return change_attribute_values(change_attribute_values(html, "href", change), "src", change);
}

}  // namespace trammel::reports
