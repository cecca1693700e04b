#pragma once

#include <string>
#include <vector>

namespace trammel::testing {

/// Walks the tags of HTML or XML. @returns an empty text if every element is closed in order, else
/// what is wrong. `html`: void elements need no end, script and style hold plain text.
[[nodiscard]] std::string markup_fault(const std::string& text, bool html);

/// How often `part` stands in `text`.
[[nodiscard]] std::size_t occurrences(const std::string& text, const std::string& part);

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Values of all attributes of this name.
[[nodiscard]] std::vector<std::string> attribute_values(const std::string& text,
                                                        const std::string& name);

}  // namespace trammel::testing
