#pragma once

#include <filesystem>

#include "harness/base/json.h"
#include "harness/results/results.h"

/// results.json contains the outcomes of runs and their verdicts. Series, drawings and studies of
/// convergence and uncertainty remain in the run store.
namespace trammel::harness {

/// Nesting depth of single lines in results: a check is one line.
inline constexpr std::size_t kLineDepth = 4;

/// Writes results.json into the folder, completely or not at all. Judged studies are written next
/// to the computations of the store.
/// @returns the path of results.json
/// @throws InputError  if the folder cannot be created or written.
std::filesystem::path write_results(const results::Results& results,
                                    const std::filesystem::path& folder);

/// Reads the content of the file without the store. The path of `store` is made relative to the
/// working directory.
/// @throws InputError  with the JSON pointer of an invalid value.
[[nodiscard]] results::Results read_summary(const std::filesystem::path& file);
/// Reads the same content from JSON that has already been parsed.
[[nodiscard]] results::Results read_summary(const std::filesystem::path& file, Json json);

/// Adds the series, drawing and studies of a run from the store.
/// @returns whether the store contains them
[[nodiscard]] bool load_stored_data(results::Run& run, const std::filesystem::path& store);

/// Reads a results file and the stored data of its runs. Without its store, a copy of the file is
/// complete except for these data, and `missing` reports it.
/// @throws InputError  with the JSON pointer of an invalid value.
[[nodiscard]] results::Results load_results(const std::filesystem::path& file);

/// Exclusive access to a results folder during the lifetime of the lock. It is acquired before any
/// long computation.
class OutputLock {
 public:
  /// @throws InputError  if the folder cannot be created or written, or is locked by another
  ///   process.
  explicit OutputLock(const std::filesystem::path& folder);
  ~OutputLock();
  OutputLock(const OutputLock&) = delete;
  OutputLock& operator=(const OutputLock&) = delete;

 private:
  void acquire();

  std::filesystem::path folder_, file_;
  int descriptor_ = -1;
};

}  // namespace trammel::harness
