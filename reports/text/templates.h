#pragma once

#include <string>

namespace trammel::reports {

/// The text of a file of templates/, built into the program. @throws std::logic_error if there is
/// no such file.
[[nodiscard]] const std::string& template_text(const std::string& name);

}  // namespace trammel::reports
