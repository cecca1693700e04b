#pragma once

#include <filesystem>

namespace trammel::reports {

/// Writes `index.html` with its figures (SVG) and their data (CSV) into `out`, from a results file
/// alone: beside a former report, whose place it takes when all is there, with what else lies in
/// the folder of unfinished files. Where it fails, the former one stays whole.
/// @returns the page's path. @throws std::runtime_error on an unreadable results file.
std::filesystem::path write_report(const std::filesystem::path& results_json,
                                   const std::filesystem::path& out);

}  // namespace trammel::reports
