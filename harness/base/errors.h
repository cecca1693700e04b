#pragma once

#include <stdexcept>
#include <string>

namespace trammel::harness {

/// Bad input or bad usage. what() is one line with the place and the expectation. Exit status 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  /// "file: /pointer: message"; the pointer of a whole document is written "/".
  InputError(const std::string& file, const std::string& pointer, const std::string& message)
      : std::runtime_error(file + ": " + (pointer.empty() ? "/" : pointer) + ": " + message) {}
};

/// SIGINT or SIGTERM was received. The exit status is 128 + the signal.
struct Interrupted : std::runtime_error {
  explicit Interrupted(int number) : std::runtime_error("interrupted"), signal(number) {}
  int signal;
};

}  // namespace trammel::harness
