#pragma once

#include <filesystem>

#include "harness/results/results.h"

namespace trammel::reports {

/// Writes results as JUnit XML: one testsuite a case, one testcase a check and one
/// for the ending of each run. A failed check is a failure, one that could not be judged an error,
/// one not run or not given is skipped; a known discrepancy that is as recorded is no
/// failure and says in its system-out that it does not agree.
void write_junit(const results::Results& results, const std::filesystem::path& junit_xml);

}  // namespace trammel::reports
