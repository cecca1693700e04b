#pragma once

#include <filesystem>

#include "harness/base/json.h"
#include "harness/results/results.h"

/// results.json holds the outcomes of runs and their verdicts. Their series, drawings and studies
/// of convergence and uncertainty stay in the run store.
namespace trammel::harness {

inline constexpr std::size_t kLineDepth = 4;  ///< of results as text: a check is a line

/// Writes results.json into the folder, all of it or nothing, and what was judged beside the
/// computations of the store. @returns its path.
/// @throws InputError  where the folder cannot be made or written.
std::filesystem::path write_results(const results::Results& results,
                                    const std::filesystem::path& folder);

/// What stands in the file itself; `store` as it is seen from here.
/// @throws InputError  with the JSON pointer of what is wrong.
[[nodiscard]] results::Results read_summary(const std::filesystem::path& file);
/// The same of what has been read from there.
[[nodiscard]] results::Results read_summary(const std::filesystem::path& file, Json json);

/// Adds the series, drawing and studies that the store has of a run. @returns whether it has them
[[nodiscard]] bool take_stored(results::Run& run, const std::filesystem::path& store);

/// A results file with what the store has of its runs. A copy without its store is whole but for
/// that, which `missing` says.
/// @throws InputError  with the JSON pointer of what is wrong.
[[nodiscard]] results::Results load_results(const std::filesystem::path& file);

/// A folder of results that this process alone writes, as long as the lock lives. Found out before
/// hours are spent.
class OutputLock {
 public:
  /// @throws InputError  where the folder cannot be made or written, or another process has it.
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
