#pragma once

#include <string>
#include <vector>

namespace trammel::harness {

enum class ReferenceFormat { table, csv, json };

/// The stored references of these names, or all: a line each, or every value with its unit,
/// uncertainty, source and place. @returns the exit status
/// @throws InputError  where there is none of a name.
int list_references(const std::vector<std::string>& names, ReferenceFormat format);

}  // namespace trammel::harness
