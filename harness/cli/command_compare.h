#pragma once

#include <string>

namespace trammel::harness {

/// Two variants, or two result files, quantity by quantity. @returns the exit status
int compare_command(const std::string& a, const std::string& b);

}  // namespace trammel::harness
