#pragma once

#include <filesystem>
#include <string>

namespace trammel::reports {

/// Whole files as text. @throws std::runtime_error naming the file.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);
void write_file(const std::filesystem::path& path, const std::string& text);

}  // namespace trammel::reports
