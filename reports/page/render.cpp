#include "reports/page/render.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>

#include "reports/text/files.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

/// Numbers between the tags as people write them, but not within code and data.
std::string with_powers_in_text(const std::string& html) {
  constexpr std::array<std::string_view, 4> kAsTheyStand = {"code", "style", "script", "metadata"};
  std::string out;
  for (std::size_t from = 0; from < html.size();) {
    const std::size_t tag = std::min(html.find('<', from), html.size());
    out += with_powers(html.substr(from, tag - from));
    from = html.find('>', tag);
    for (const std::string_view name : kAsTheyStand)
      if (html.compare(std::min(tag + 1, html.size()), name.size(), name) == 0)
        from = html.find("</" + std::string(name), tag);
    from = from == std::string::npos ? html.size() : from + 1;
    out.append(html, tag, from - tag);
  }
  return out;
}

}  // namespace

void set_partials(Data& data, std::initializer_list<const char*> names) {
  for (const std::string name : names)
    data.set(name + "_partial", kainjow::mustache::partial(
                                    [file = name + ".mustache"] { return template_text(file); }));
}

std::string render(const std::string& template_name, const Data& data) {
  kainjow::mustache::mustache page(template_text(template_name));
  std::string html = page.render(data);
  if (!page.is_valid()) throw std::logic_error(template_name + ": " + page.error_message());
  std::ranges::replace_if(
      html, [](char c) { return is_control(c) && c != '\n' && c != '\t'; }, ' ');
  return with_powers_in_text(html);
}

}  // namespace trammel::reports
