#pragma once

#include <string>
#include <vector>

namespace trammel::testing {

/// Checks that all elements of HTML or XML are closed in order.
/// @returns an empty text or a description of the fault
/// @param html  true: void elements need no end; script and style contain plain text
[[nodiscard]] std::string markup_fault(const std::string& text, bool html);

/// Counts the occurrences of `part` in `text`.
[[nodiscard]] std::size_t occurrences(const std::string& text, const std::string& part);

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Returns the values of all attributes with this name.
[[nodiscard]] std::vector<std::string> attribute_values(const std::string& text,
                                                        const std::string& name);

}  // namespace trammel::testing
