#pragma once

#include <filesystem>
#include <string>

namespace trammel::harness {

/// The UUID of version 5 (RFC 9562) that names a text: 122 bits of its SHA-1.
[[nodiscard]] std::string content_hash(const std::string& text);

/// The same of a file; empty where there is none that can be read.
[[nodiscard]] std::string file_hash(const std::filesystem::path& file);

/// What names this program's code: the linker's build id; of a program without one its file's hash.
[[nodiscard]] std::string program_hash();

}  // namespace trammel::harness
