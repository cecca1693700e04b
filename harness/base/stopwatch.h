#pragma once

#include <chrono>

namespace trammel::harness {

/// Wall time, and processor time of the calling thread, since it was made [s].
class Stopwatch {
 public:
  Stopwatch();
  [[nodiscard]] double wall_s() const;
  [[nodiscard]] double cpu_s() const;

 private:
  std::chrono::steady_clock::time_point wall_;
  double cpu_;
};

}  // namespace trammel::harness
