#pragma once

#include <filesystem>

namespace trammel::harness {

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
