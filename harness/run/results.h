#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/analysis/analysis.h"
#include "harness/results/results.h"
#include "harness/run/run.h"

namespace trammel::harness {

/// Fills a run with the result of its analysis.
void record_result(AnalysisResult result, Run& run);

/// The runs with their cases, references and environment.
/// @param store  folder in which the runs are stored
[[nodiscard]] results::Results results_of(std::vector<Run> runs, const std::vector<Case>& cases,
                                          const References& references,
                                          const std::filesystem::path& store = {});

/// Of the case with all that it extends, as its `CaseInfo` has it.
[[nodiscard]] std::string case_hash(const Case& given);

}  // namespace trammel::harness
