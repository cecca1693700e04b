#pragma once

#include <initializer_list>
#include <string>

#include "reports/text/html.h"

namespace trammel::reports {

/// The templates that another one includes, by their names.
void set_partials(Data& data, std::initializer_list<const char*> names);

/// A template filled in, without the control characters that HTML cannot hold; numbers as 1e-6 in
/// its text are 10⁻⁶.
/// @throws std::logic_error  where the template is broken.
[[nodiscard]] std::string render(const std::string& template_name, const Data& data);

}  // namespace trammel::reports
