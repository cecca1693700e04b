#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/analysis/analysis.h"
#include "harness/results/results.h"
#include "harness/run/run.h"

namespace trammel::harness {

/// Copies the result of an analysis into its run.
void record_result(AnalysisResult result, Run& run);

/// Returns the runs with their cases, references and environment.
/// @param store  folder in which the runs are stored
[[nodiscard]] results::Results results_of(std::vector<Run> runs, const std::vector<Case>& cases,
                                          const References& references,
                                          const std::filesystem::path& store = {});

/// Returns the hash of the case with all cases that it extends, as in its `CaseInfo`.
[[nodiscard]] std::string case_hash(const Case& given);

/// History of calls in an SQLite file. It has a row for each call, with the time and counted work
/// of each computed run. Verdict and value of each check entry are added if they differ from the
/// previous call.

using results::History;
using results::HistoryCall;
using results::HistoryChange;
using results::HistoryDrift;

/// Adds a call.
/// @throws InputError  if the file is not such a history or cannot be written.
void append_history(const std::filesystem::path& file, const results::Results& results);

/// Reads the history.
/// @throws InputError  if the file does not exist or is not such a history.
[[nodiscard]] History read_history(const std::filesystem::path& file);

}  // namespace trammel::harness
