#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/input/case.h"

/// Where cases are found: by name in the catalogue, or by file.
namespace trammel::harness {

/// Files of the catalogue that can be run, by name. A file without an analysis of its own or
/// inherited is there to be extended.
[[nodiscard]] std::vector<std::filesystem::path> catalogue_files();

/// The file meant by a name of the catalogue or by a path.
/// @throws InputError  with the nearest name, where there is none.
[[nodiscard]] std::filesystem::path find_case(const std::string& name_or_file);

/// The file meant by "extends" in `from`: relative to that file, or a name of the catalogue.
/// @throws InputError  where there is none.
[[nodiscard]] std::filesystem::path find_base_case(const std::string& name_or_file,
                                                   const std::filesystem::path& from);

/// All cases of the catalogue that carry one of the labels; all cases when no label is given.
/// @throws InputError  for a label that no case carries.
[[nodiscard]] std::vector<Case> load_catalogue(const std::vector<std::string>& labels);

}  // namespace trammel::harness
