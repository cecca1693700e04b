#pragma once

#include <stdexcept>
#include <string>

namespace trammel::harness {

/// Error in the input or usage. what() is one line: place, problem, expected input. Exit status 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  /// Composes "file: /pointer: message". The pointer of a complete document is written as "/".
  InputError(const std::string& file, const std::string& pointer, const std::string& message)
      : std::runtime_error(file + ": " + (pointer.empty() ? "/" : pointer) + ": " + message) {}
};

/// SIGINT or SIGTERM was received. The exit status is 128 + the number of the signal.
struct Interrupted : std::runtime_error {
  explicit Interrupted(int number) : std::runtime_error("interrupted"), signal(number) {}
  int signal;
};

}  // namespace trammel::harness
