#pragma once

#include <filesystem>

namespace trammel::reports {

/// Writes a report into `out` from a results file alone: `index.html`, a page for each family and
/// case, figures (SVG) with their data (CSV); asked for a single file also `report.html`, which
/// needs no other. Beside a former report, whose place it takes when all is there, with what else
/// lies in the folder of unfinished files. Where it fails, the former one stays whole.
/// @returns the path of the page to open. @throws std::runtime_error on an unreadable results file.
std::filesystem::path write_report(const std::filesystem::path& results_json,
                                   const std::filesystem::path& out, bool single_file = false);

}  // namespace trammel::reports
