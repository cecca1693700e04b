#include "harness/base/progress.h"

#include <unistd.h>

#include <cstdio>
#include <string>
#include <utility>

namespace trammel::harness {

Progress::Progress(std::string items)
    : items_(std::move(items)), terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (line_shown_) std::fputs("\r\033[K", stderr);
}

void Progress::show(std::size_t done, std::size_t all) {
  const auto now = std::chrono::steady_clock::now();
  const bool each_time = terminal_ && all > 1;
  if (!each_time && now - last_shown_ < std::chrono::seconds(5)) return;
  last_shown_ = now;
  const std::chrono::duration<double> spent = now - start_;
  line_shown_ = terminal_;
  const std::string of_all = all > 0 ? " of " + std::to_string(all) : "";  // 0: unknown total
  std::fprintf(stderr, "%strammel: %zu%s %s, %.0f s%s", terminal_ ? "\r" : "", done, of_all.c_str(),
               items_.c_str(), spent.count(), terminal_ ? "\033[K" : "\n");
  std::fflush(stderr);
}

}  // namespace trammel::harness
