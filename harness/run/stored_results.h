#pragma once

#include <filesystem>

#include "harness/base/json.h"
#include "harness/results/results.h"

/// results.json contains the outcomes of runs and their verdicts. Series, drawings and studies of
/// convergence and uncertainty remain in the run store.
namespace trammel::harness {

/// Minimum nesting depth in results.json of values that are written in one line, such as a check.
inline constexpr std::size_t kLineDepth = 4;

/// Writes results.json into the folder, completely or not at all. Convergence studies are written
/// into the store, next to the files of the runs.
/// @returns the path of results.json
/// @throws InputError  if the folder cannot be created or written.
std::filesystem::path write_results(const results::Results& results,
                                    const std::filesystem::path& folder);

/// Reads results.json without the run store. The path of the store becomes relative to the working
/// directory.
/// @throws InputError  with the JSON pointer of an invalid value.
[[nodiscard]] results::Results read_results_json(const std::filesystem::path& file);
/// Reads the contents of results.json from parsed JSON; `file` is used for paths and messages.
[[nodiscard]] results::Results read_results_json(const std::filesystem::path& file, Json json);

/// Adds the series, drawing and studies of a run from the store.
/// @returns whether the store contains these data
[[nodiscard]] bool load_stored_data(results::Run& run, const std::filesystem::path& store);

/// Reads a results file and the stored data of its runs. If the store lacks data of some runs,
/// Results::missing contains a message.
/// @throws InputError  with the JSON pointer of an invalid value.
[[nodiscard]] results::Results load_results(const std::filesystem::path& file);

/// Exclusive access to a results folder during the lifetime of the lock. The lock is acquired
/// before a computation.
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
