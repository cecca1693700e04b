#include "harness/base/progress.h"

#include <unistd.h>

#include <cstdio>
#include <string>

namespace trammel::harness {

Progress::Progress() : terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (shown_) std::fputs("\r\033[K", stderr);
}

void Progress::show(std::size_t done, std::size_t all) {
  if (!terminal_ || all < 2) return;
  constexpr std::size_t width = 40;
  const std::size_t filled = width * done / all;
  const std::string bar = std::string(filled, '#') + std::string(width - filled, '.');
  std::fprintf(stderr, "\r[%s] %zu of %zu\033[K", bar.c_str(), done, all);
  std::fflush(stderr);
  shown_ = true;
}

}  // namespace trammel::harness
