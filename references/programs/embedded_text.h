#pragma once

#include <string>

namespace trammel::references {

/// The text of a file that is built into the program, by its name. @throws std::logic_error  if
/// there is no such file.
[[nodiscard]] const std::string& embedded_text(const std::string& file);

}  // namespace trammel::references
