#include "reports/page/render.h"

#include <algorithm>
#include <stdexcept>

#include "reports/text/number.h"
#include "reports/text/templates.h"

namespace trammel::reports {

std::string render(const std::string& template_name, const Data& data) {
  kainjow::mustache::mustache page(template_text(template_name));
  std::string html = page.render(data);
  if (!page.is_valid()) throw std::logic_error(template_name + ": " + page.error_message());
  std::replace_if(
      html.begin(), html.end(), [](char c) { return is_control(c) && c != '\n' && c != '\t'; },
      ' ');
  return html;
}

}  // namespace trammel::reports
