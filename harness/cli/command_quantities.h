#pragma once

#include <string>

namespace trammel::harness {

/// The quantities that each analysis can give, or those that a case gives, with unit and meaning.
/// @param name  of a case or its file; empty: all analyses
/// @returns the exit status
int quantities_command(const std::string& name, bool json);

}  // namespace trammel::harness
