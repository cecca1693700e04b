#pragma once

#include <string>
#include <vector>

namespace trammel::reports {

/// "axial-flexibility" and "mean_square" as words with blanks between them.
[[nodiscard]] std::string spaced(std::string name);

[[nodiscard]] std::string capitalized(std::string text);

/// "3.9 to 4.1", or "4" where both ends read alike.
[[nodiscard]] std::string low_to_high(const std::string& low, const std::string& high);

/// Adds to a list in words: after a separator, but for the first item.
void add_item(std::string& list, const std::string& item, const std::string& separator = ", ");

/// What stands between blanks: heads of a table's columns.
[[nodiscard]] std::vector<std::string> words_in(const std::string& text);

}  // namespace trammel::reports
