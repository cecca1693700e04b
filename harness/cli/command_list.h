#pragma once

#include <string>
#include <vector>

namespace trammel::harness {

/// A table of the catalogue's cases with one of these labels. @returns the exit status
int list_cases(const std::vector<std::string>& labels, bool json);
/// What a case models, checks and compares with. @returns the exit status
int describe_case(const std::string& name, bool json);

}  // namespace trammel::harness
