#pragma once

#include <filesystem>

#include "reports/data/results.h"

namespace trammel::reports {

/// Writes a report of complete results into `out`: `index.html`, a page for each family and
/// case, figures (SVG) with their data (CSV); asked for a single file also `report.html`, which
/// needs no other. Beside a former report, whose place it takes when all is there, with what else
/// lies in the folder of unfinished files. Where it fails, the former one stays whole.
/// @returns the path of the page to open.
std::filesystem::path write_report(const Results& results, const std::filesystem::path& out,
                                   bool single_file = false);

}  // namespace trammel::reports
