#pragma once

#include <string>
#include <vector>

/// Names from before version 0.1 and what they are called now, by cases/schema/renamed.json. Each
/// function returns what it was given where that never had another name. To go with 0.2.
namespace trammel::harness {

/// @param path  to the key, which is its last entry; keys around it may be former or present ones
[[nodiscard]] std::string current_key(const std::vector<std::string>& path);

/// "relative_error:serial_distance" -> "relative_error:serial_singularity_distance"
[[nodiscard]] std::string current_quantity(const std::string& name);

/// A word of the command line.
[[nodiscard]] std::string current_command(const std::string& word);

}  // namespace trammel::harness
