#pragma once

#include <filesystem>

namespace trammel::harness {

/// The folder that holds cases/ and references/: $TRAMMEL_HOME where set, else the source tree it
/// was built from, else share/trammel beside the installed program.
/// @throws InputError  where none of them is there.
[[nodiscard]] const std::filesystem::path& data_root();

}  // namespace trammel::harness
