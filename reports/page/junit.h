#pragma once

#include <filesystem>

namespace trammel::reports {

/// Writes what a results file says as JUnit XML: one testsuite a case, one testcase a check and one
/// for the ending of each run. A failed check is a failure, one that could not be judged an error,
/// one not run or not given is skipped; a known discrepancy that is as recorded is no
/// failure and says in its system-out that it does not agree.
/// @throws std::runtime_error on an unreadable results file.
void write_junit(const std::filesystem::path& results_json, const std::filesystem::path& junit_xml);

}  // namespace trammel::reports
