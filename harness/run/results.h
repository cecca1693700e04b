#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/analysis/analysis.h"
#include "harness/results/results.h"
#include "harness/run/run.h"

namespace trammel::harness {

/// Copies status, quantities, effects, drawing and cost of an analysis into its run.
void record_result(AnalysisResult result, Run& run);

/// Returns the contents of results.json: the runs with their cases, references and environment.
/// @param store  folder of the run store
[[nodiscard]] results::Results collect_results(std::vector<Run> runs,
                                               const std::vector<Case>& cases,
                                               const References& references,
                                               const std::filesystem::path& store = {});

/// Returns the hash of a case with all cases that it extends, for CaseInfo::hash.
[[nodiscard]] std::string case_hash(const Case& given);

/// History of the calls of `trammel run` in an SQLite file. It contains totals of each call, and
/// time and counted work of each computed run. Verdict and value of a check entry are added if they
/// differ from those of the previous call.

using results::History;
using results::HistoryCall;
using results::HistoryChange;
using results::HistoryDrift;

/// Adds the results of a call to the history.
/// @throws InputError  if the file is not a history of trammel, or cannot be written.
void append_history(const std::filesystem::path& file, const results::Results& results);

/// Reads the history.
/// @throws InputError  if the file does not exist or is not a history of trammel.
[[nodiscard]] History read_history(const std::filesystem::path& file);

}  // namespace trammel::harness
