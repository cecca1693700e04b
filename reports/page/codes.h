#pragma once

#include <filesystem>
#include <vector>

namespace trammel::reports {

/// Writes `index.html` into `out`: the results of several codes, case by code, trammel's own as
/// one of them. Each row has the check that says most of it, with the expected value; each cell how
/// the code did there, its difference and its time.
/// @returns the page's path. @throws std::runtime_error on an unreadable results file.
std::filesystem::path write_codes(const std::vector<std::filesystem::path>& results_json,
                                  const std::filesystem::path& out);

}  // namespace trammel::reports
