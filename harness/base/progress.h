#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace trammel::harness {

/// Progress on standard error: one line on a terminal, several lines in a log. A log is updated at
/// most every five seconds. The same limit applies to a terminal if the total is one or unknown.
class Progress {
 public:
  /// @param items  name of the counted items, in the plural: "runs"
  explicit Progress(std::string items);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// @param all  total number of items; 0 if it is unknown
  void show(std::size_t done, std::size_t all);

 private:
  std::string items_;
  bool terminal_, line_shown_ = false;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point last_shown_ = start_;
};

}  // namespace trammel::harness
