#pragma once

#include <chrono>

namespace trammel::harness {

/// Measures wall time and the calling thread's processor time since construction [s].
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
