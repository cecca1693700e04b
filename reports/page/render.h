#pragma once

#include <string>

#include "reports/text/html.h"

/// Conversion of templates and their data to HTML pages, and the links between pages.
namespace trammel::reports {

/// Returns the HTML of a template, with variables replaced by the data. {{> name_partial}} includes
/// another template. Control characters that HTML cannot contain become spaces. Numbers such as
/// 1e-6 become 10⁻⁶ in the text.
/// @throws std::logic_error  if the template is not valid.
[[nodiscard]] std::string render(const std::string& template_name, Data data);

/// Converts links that are relative to the folder of the report ("cases/a.html#check-b") to links
/// that are relative to the page at `page` ("cases/a.html").
[[nodiscard]] std::string with_relative_links(const std::string& html, const std::string& page);

}  // namespace trammel::reports
