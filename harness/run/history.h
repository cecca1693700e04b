#pragma once

#include <filesystem>

#include "harness/results/results.h"

/// What calls of the program came to over time, in an SQLite file: a row for each call, the time
/// and counted work of each run that it computed, and the verdict and value of each check entry
/// where they are other than before.
namespace trammel::harness {

using results::History;
using results::HistoryCall;
using results::HistoryChange;
using results::HistoryDrift;

/// Adds a call. @throws InputError  where the file is no such history or cannot be written
void append_history(const std::filesystem::path& file, const results::Results& results);

/// @throws InputError  where the file is not there or is no such history
[[nodiscard]] History read_history(const std::filesystem::path& file);

}  // namespace trammel::harness
