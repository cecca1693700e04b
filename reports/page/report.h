#pragma once

#include <filesystem>
#include <vector>

#include "harness/results/results.h"
#include "harness/results/side_comparison.h"
#include "reports/data/results.h"

/// HTML pages and JUnit XML files that the commands of the program trammel write.
namespace trammel::reports {

/// Writes a report of complete results into `out`: `index.html`, a page for each family and case,
/// and figures (SVG) with their data (CSV). Files are first written to a temporary folder. At
/// the end, all files of the temporary folder replace an earlier report. If writing fails, the
/// earlier report does not change.
/// @returns the path of `index.html`.
std::filesystem::path write_report(const Results& results, const std::filesystem::path& out);

/// Writes a self-contained page that compares sets of results ("sides"), such as variants or
/// results of different dates. It shows time and accuracy, changed modes and numbers, and curves.
/// @throws std::runtime_error  if a figure cannot be drawn or the file cannot be written
void write_comparison(const results::SideComparison& comparison, const std::filesystem::path& file);

/// Writes `index.html` into `out`, which compares the results of several simulation codes. Each row
/// has a variant of a case, with one check that decides a grade and its expected value. Each cell
/// has the grade of a code, its difference from the expected value, and its computing time.
/// @returns the path of the page. @throws std::runtime_error  if a results file cannot be read.
std::filesystem::path write_code_comparison(const std::vector<std::filesystem::path>& results_json,
                                            const std::filesystem::path& out);

/// Writes results as JUnit XML: a testsuite for each case, a testcase for each check of a run, and
/// one with the name "status" for each run. The names do not depend on the outcome. A known
/// discrepancy has the element `skipped` of type trammel.known-discrepancy; a check without a run
/// has it with type trammel.not-run. The system-out contains values, reasons and warnings.
void write_junit(const results::Results& results, const std::filesystem::path& junit_xml);

}  // namespace trammel::reports
