#pragma once

#include <string>
#include <vector>

namespace trammel::harness {

/// A table of the catalogue's cases with one of these labels. @returns the exit status
int list_cases(const std::vector<std::string>& labels, bool json);
/// What a case models, checks and compares with. @returns the exit status
int describe_case(const std::string& name, bool json);
/// The quantities that each analysis can give, or those that a case gives, with unit and meaning.
/// @param name  of a case or its file; empty: all analyses
/// @returns the exit status
int quantities_command(const std::string& name, bool json);

}  // namespace trammel::harness
