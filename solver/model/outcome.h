#pragma once

#include <string>

namespace trammel::solver {

/// How a computation ended. A numerical outcome is a value, never an exception.
enum class Status { solved, singular, not_converged };

struct Outcome {
  Status status = Status::solved;
  std::string reason;  ///< in words; empty when solved
  [[nodiscard]] bool solved() const { return status == Status::solved; }
};

}  // namespace trammel::solver
