#include "harness/base/progress.h"

#include <unistd.h>

#include <cstdio>
#include <string>
#include <utility>

namespace trammel::harness {

Progress::Progress(std::string items)
    : items_(std::move(items)), terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (bar_shown_) std::fputs("\r\033[K", stderr);
}

void Progress::show(std::size_t done, std::size_t all) {
  if (all < 2) return;
  if (terminal_) {
    constexpr std::size_t width = 40;
    const std::size_t filled = width * done / all;
    const std::string bar = std::string(filled, '#') + std::string(width - filled, '.');
    std::fprintf(stderr, "\r[%s] %zu of %zu %s\033[K", bar.c_str(), done, all, items_.c_str());
    std::fflush(stderr);
    bar_shown_ = true;
    return;
  }
  const auto now = std::chrono::steady_clock::now();
  if (now - last_line_ < std::chrono::seconds(10)) return;
  std::fprintf(stderr, "trammel: %zu of %zu %s\n", done, all, items_.c_str());
  last_line_ = now;
}

}  // namespace trammel::harness
