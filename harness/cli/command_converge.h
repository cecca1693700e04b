#pragma once

#include <string>

namespace trammel::harness {

/// What a case's refinements show. @returns the exit status
int converge_command(const std::string& name, const std::string& variant, unsigned jobs, bool json);

}  // namespace trammel::harness
