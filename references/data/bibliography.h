#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace trammel::references {

struct Source {
  std::string text;  ///< full citation
  std::string doi;   ///< empty where there is none
};

using Bibliography = std::map<std::string, Source>;

/// @param file  {"key": {"text": "...", "doi": "..."}}; a file that is not there is an empty
///              bibliography.
/// @throws ReferenceError  where the file is there but is no bibliography.
[[nodiscard]] Bibliography load_bibliography(const std::filesystem::path& file);

}  // namespace trammel::references
