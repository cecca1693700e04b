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

/// What calls of the program came to over time, in an SQLite file: a row for each call, the time
/// and counted work of each run that it computed, and the verdict and value of each check entry
/// where they are other than before.

using results::History;
using results::HistoryCall;
using results::HistoryChange;
using results::HistoryDrift;

/// Adds a call. @throws InputError  where the file is no such history or cannot be written
void append_history(const std::filesystem::path& file, const results::Results& results);

/// @throws InputError  where the file is not there or is no such history
[[nodiscard]] History read_history(const std::filesystem::path& file);

}  // namespace trammel::harness
