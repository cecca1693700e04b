#include <functional>

#include "reports/page/render.h"

namespace trammel::reports {

namespace {

/// The text with each value of the attribute (in double quotes, which no text holds unescaped)
/// replaced by what `change` makes of it.
std::string with_attribute(const std::string& html, const std::string& attribute,
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

bool is_outside(const std::string& target) {
  return target.starts_with("https:");
}

/// "cases/a.html" stands under "case-a", "families/b.html" under "family-b".
std::string anchor_of(const std::string& page) {
  const std::size_t slash = page.find('/');
  if (slash == std::string::npos) return "";
  const std::string name = page.substr(slash + 1, page.rfind('.') - slash - 1);
  return (page.starts_with("cases/") ? "case-" : "family-") + name;
}

/// In one file the parts of index.html and references.html keep their names.
std::string anchor_within(const std::string& page, const std::string& fragment) {
  const std::string anchor = anchor_of(page);
  if (anchor.empty()) return fragment.empty() ? page.substr(0, page.find('.')) : fragment;
  return fragment.empty() ? anchor : anchor + "-" + fragment;
}

}  // namespace

std::string linked_from(const std::string& html, const std::string& page) {
  const auto change = [&](const std::string& target) {
    if (target.empty() || target[0] == '#' || is_outside(target)) return target;
    if (target.starts_with(page + "#")) return target.substr(page.size());
    return (page.find('/') == std::string::npos ? "" : "../") + target;
  };
  return with_attribute(with_attribute(html, "href", change), "src", change);
}

std::string linked_within(const std::string& html, const std::string& page) {
  const std::string anchor = anchor_of(page);
  const auto link = [&](const std::string& target) {
    if (is_outside(target)) return target;
    const std::size_t hash = target.find('#');
    const std::string file = target.substr(0, hash);
    return "#" + anchor_within(file.empty() ? page : file,
                               hash == std::string::npos ? "" : target.substr(hash + 1));
  };
  const auto id = [&](const std::string& own) {
    return own == anchor ? own : anchor_within(page, own);
  };
  return with_attribute(with_attribute(html, "href", link), "id", id);
}

std::vector<std::string> targets_in(const std::string& html) {
  std::vector<std::string> targets;
  const auto collect = [&](const std::string& target) {
    targets.push_back(target);
    return target;
  };
  (void)with_attribute(with_attribute(html, "href", collect), "src", collect);
  return targets;
}

}  // namespace trammel::reports
