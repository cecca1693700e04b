#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace trammel::reports {

/// Whole files as text. @throws std::system_error  naming the file: the fault lies outside.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);
/// All of it or nothing: a file of its own name, renamed at the end. A link is replaced.
void write_file(const std::filesystem::path& path, const std::string& text);

/// Moves every file below `from` to the same place below `to`, the one named `last` after all
/// others, then removes `obsolete` (below `to`) where it was not replaced, and `from`. Links in the
/// way are replaced, not followed; signals that end the program wait.
/// @throws std::system_error  naming what is in the way, before anything is moved.
void replace_files(const std::filesystem::path& from, const std::filesystem::path& to,
                   const std::string& last, const std::vector<std::filesystem::path>& obsolete);

}  // namespace trammel::reports
