#pragma once

#include <filesystem>
#include <string>

#include "harness/base/json.h"

namespace trammel::harness {

/// What produced the numbers: version, commit, date, compiler and flags, libraries, processor.
[[nodiscard]] Json environment();

/// The folder that holds cases/ and references/: $TRAMMEL_HOME where set, else the source tree it
/// was built from, else share/trammel beside the installed program.
/// @throws InputError  where none of them is there.
[[nodiscard]] const std::filesystem::path& data_root();

/// The UUID of version 5 (RFC 9562) that names a text: 122 bits of its SHA-1.
[[nodiscard]] std::string content_hash(const std::string& text);

/// The same of a file; empty where there is none that can be read.
[[nodiscard]] std::string file_hash(const std::filesystem::path& file);

/// What names this program's code: the linker's build id; of a program without one its file's hash.
[[nodiscard]] std::string program_hash();

}  // namespace trammel::harness
