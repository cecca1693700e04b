#pragma once

#include <map>
#include <string>
#include <vector>

namespace trammel::reports {

/// Sections name what they link to as seen from the folder of the report, "cases/a.html#check-b":
/// where a page stands and whether all pages are one file is decided here, on the finished text.

/// As these links read on the page at `page` ("cases/a.html").
/// @param moved  where targets stand instead
[[nodiscard]] std::string linked_from(const std::string& html, const std::string& page,
                                      const std::map<std::string, std::string>& moved);

/// As they read where one file holds all pages: ids of the page's own get its anchor before them.
[[nodiscard]] std::string linked_within(const std::string& html, const std::string& page);

/// Every target of href and src.
[[nodiscard]] std::vector<std::string> targets_in(const std::string& html);

}  // namespace trammel::reports
