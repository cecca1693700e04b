#pragma once

#include <iosfwd>
#include <string>
#include <vector>

/// The command trammel_derive: stored references against what their derivations give today.
namespace trammel::references {

/// @param command_line  the words of it, without the program's name.
/// @returns the exit status: 0 everything holds, 1 a stored value is not what comes out, 2 bad
///          usage or input (one line on `err`), 3 our own fault.
[[nodiscard]] int derive_command(const std::vector<std::string>& command_line, std::ostream& out,
                                 std::ostream& err);

}  // namespace trammel::references
