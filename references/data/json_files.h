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

/// A folder and all below it.
[[nodiscard]] std::vector<std::string> folders(const std::string& folder);

/// The first file name.json in these folders; empty where there is none.
[[nodiscard]] std::string find_json_file(const std::vector<std::string>& folders,
                                         const std::string& name);

}  // namespace trammel::references
