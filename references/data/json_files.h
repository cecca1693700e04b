#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace trammel::references {

/// The JSON files of all rooms below a folder, each with its name less ".json"; none where there is
/// no such folder. By readdir, as std::filesystem takes 7,000 instructions a file and a walk comes
/// before every command.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> json_files(
    const std::string& folder);

/// Content of a file. A string would be cleared first, which takes longer than reading.
struct FileText {
  std::unique_ptr<char[]> bytes;
  std::string_view text;
};

/// Reads a file. The text is empty if there is no file, or if it cannot be read.
[[nodiscard]] FileText read_file(const std::string& file);

}  // namespace trammel::references
