#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace trammel::harness {

/// How far a computation is, on standard error: a bar that is rewritten on a terminal, elsewhere
/// (in a log) a line; of a single item, and in a log, at most every five seconds.
class Progress {
 public:
  /// @param items  what is counted, in the plural: "runs"
  explicit Progress(std::string items);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// @param all  0 where nobody knows how many there will be
  void show(std::size_t done, std::size_t all);

 private:
  std::string items_;
  bool terminal_;
  bool bar_shown_ = false;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point last_shown_ = start_;
};

}  // namespace trammel::harness
