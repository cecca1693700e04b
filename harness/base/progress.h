#pragma once

#include <cstddef>

namespace trammel::harness {

/// A bar on standard error while things are computed; nothing where that is no terminal.
class Progress {
 public:
  Progress();
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void show(std::size_t done, std::size_t all);

 private:
  bool terminal_;
  bool shown_ = false;
};

}  // namespace trammel::harness
