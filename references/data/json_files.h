#pragma once

#include <string>
#include <utility>
#include <vector>

namespace trammel::references {

/// The JSON files of all rooms below a folder, each with its name less ".json"; none where there is
/// no such folder. By readdir, as std::filesystem takes 7,000 instructions a file and a walk comes
/// before every command.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> json_files(
    const std::string& folder);

}  // namespace trammel::references
