#pragma once

#include <string>
#include <string_view>

namespace trammel::references {

struct Source {
  std::string text;  ///< full citation
  std::string doi;   ///< empty where there is none
};

/// Reads a member of a bibliography, {"key": {"text": "...", "doi": "..."}}.
/// @param place  "file: /key" in messages
/// @throws ReferenceError  if the member is no source.
[[nodiscard]] Source read_source(std::string_view json, const std::string& place);

}  // namespace trammel::references
