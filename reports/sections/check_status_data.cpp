#include "reports/drawing/figure.h"
#include "reports/sections/sections.h"
#include "reports/text/number.h"

namespace trammel::reports {

Data with_status(CheckStatus status, std::initializer_list<Entry> entries) {
  Data data = object(entries);
  set(data, {{"status_text", to_text(status)},
             {"status_class", css_class(status)},
             {"sign", sign(status)}});
  return data;
}

Data counts_list(const Counts& counts) {
  Data out = list();
  const auto all = static_cast<double>(total(counts));
  for (const CheckStatus which : kAllCheckStatuses) {
    const std::size_t n = count_of(counts, which);
    if (n == 0) continue;
    out.push_back(with_status(
        which,
        {{"n", std::to_string(n)}, {"percent", shortest(100.0 * static_cast<double>(n) / all)}}));
  }
  return out;
}

std::string case_link(const std::string& id) {
  return "cases/" + slug(id) + ".html";
}
std::string case_anchor(const std::string& id) {
  return "case-" + slug(id);
}
std::string family_link(const std::string& id) {
  return "families/" + slug(id) + ".html";
}
std::string reference_link(const std::string& id) {
  return "references.html#ref-" + slug(id);
}

}  // namespace trammel::reports
