#pragma once

#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reports/data/results.h"
#include "reports/drawing/figure.h"
#include "reports/text/html.h"

/// From templates to pages: their parts, and the links between them.
namespace trammel::reports {

/// The templates that another one includes, by their names.
void set_partials(Data& data, std::initializer_list<const char*> names);

/// A template filled in, without the control characters that HTML cannot hold; numbers as 1e-6 in
/// its text are 10⁻⁶.
/// @throws std::logic_error  where the template is broken.
[[nodiscard]] std::string render(const std::string& template_name, const Data& data);

/// Sections name what they link to as seen from the folder of the report, "cases/a.html#check-b":
/// where a page stands and whether all pages are one file is decided here, on the finished text.

/// As these links read on the page at `page` ("cases/a.html").
[[nodiscard]] std::string linked_from(const std::string& html, const std::string& page);

/// As they read where one file holds all pages: ids of the page's own get its anchor before them.
[[nodiscard]] std::string linked_within(const std::string& html, const std::string& page);

/// Every target of href and src.
[[nodiscard]] std::vector<std::string> targets_in(const std::string& html);

/// What changed over the calls that a history keeps.
/// @param figure  drawn
[[nodiscard]] Data history_section(const Results& results, const std::optional<Figure>& figure);

}  // namespace trammel::reports
