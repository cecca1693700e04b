#pragma once

#include <filesystem>
#include <string>

#include "harness/base/json.h"

namespace trammel::harness {

/// Returns the version, commit, date, compiler and flags, libraries and processor of this program.
[[nodiscard]] Json build_and_machine_info();

/// Returns the folder that contains cases/ and references/: $TRAMMEL_HOME if set, else the source
/// tree of the build, else share/trammel of the installation.
/// @throws InputError  if none of these folders exists.
[[nodiscard]] const std::filesystem::path& data_root();

/// Returns the UUID of version 5 (RFC 9562) of a text: 122 bits of its SHA-1.
[[nodiscard]] std::string content_hash(const std::string& text);

/// Returns the content hash of a file, or an empty string if the file cannot be read.
[[nodiscard]] std::string file_hash(const std::filesystem::path& file);

/// Returns a hash that identifies this program by the linker's build id.
[[nodiscard]] std::string program_hash();

}  // namespace trammel::harness
