#include "reports/sections/check_status_data.h"

#include "reports/drawing/figure.h"
#include "reports/text/number.h"

namespace trammel::reports {

void set_check_status(Data& data, CheckStatus status) {
  data.set("status_text", to_text(status));
  data.set("status_class", css_class(status));
  data.set("sign", sign(status));
}

Data counts_list(const Counts& counts) {
  Data out = list();
  const auto all = static_cast<double>(total(counts));
  for (const CheckStatus which : kAllCheckStatuses) {
    const std::size_t n = count_of(counts, which);
    if (n == 0) continue;
    Data entry = object();
    set_check_status(entry, which);
    entry.set("n", std::to_string(n));
    entry.set("percent", shortest(100.0 * static_cast<double>(n) / all));
    out.push_back(entry);
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
