#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace trammel::solver {

/// How a computation ended. A numerical outcome is a value, never an exception.
enum class Status { solved, singular, not_converged };

struct Outcome {
  Status status = Status::solved;
  std::string reason;  ///< in words; empty when solved
  [[nodiscard]] bool solved() const { return status == Status::solved; }
};

// What speaks for a solution: residuals that finding it did not use.

/// Each is relative to the magnitudes of the terms that it is the sum of: rounding alone leaves a
/// few eps, nonsense 1.
enum class Residual {
  equilibrium,          ///< K u = f row by row, with the matrices formed afresh
  recovered_forces,     ///< equilibrium of the forces that are reported: members, supports, loads
  eigenvalue_equation,  ///< K x = w^2 M x row by row, of every mode
  mode_count,           ///< modes missed, too many (Sylvester's law of inertia) or found twice
  equation_of_motion,   ///< row by row, the largest over the steps
  constraints,          ///< joints, drives and the closing of loops, over the size of the model
  energy,               ///< work of all forces less the change of energy, over the whole run
  load,  ///< |K u - f|, at least its round-off error, over |f|: small if the condition number is
};
inline constexpr std::array kResiduals = {Residual::equilibrium,
                                          Residual::recovered_forces,
                                          Residual::eigenvalue_equation,
                                          Residual::mode_count,
                                          Residual::equation_of_motion,
                                          Residual::constraints,
                                          Residual::energy,
                                          Residual::load};

struct ResidualRule {
  const char* name;  ///< in results, and in words
  double limit;      ///< above it a solution does not count as solved
  const char* why;
};
[[nodiscard]] const ResidualRule& rule_of(Residual kind);

/// Residual::load above it is said, not refused: the condition number has eaten the digits of the
/// forces; below it the loads are met to what is ever measured of them.
inline constexpr double kLoadWarning = 1e-6;

/// The largest residual of each kind that was taken.
class Evidence {
 public:
  /// What is not a number counts as infinite.
  void add(Residual kind, double value);
  void add(const Evidence& other);
  [[nodiscard]] bool has(Residual kind) const { return taken_[index(kind)]; }
  /// @pre has(kind)
  [[nodiscard]] double largest(Residual kind) const { return largest_[index(kind)]; }
  [[nodiscard]] bool empty() const;

 private:
  static std::size_t index(Residual kind) { return static_cast<std::size_t>(kind); }

  std::array<bool, kResiduals.size()> taken_{};
  std::array<double, kResiduals.size()> largest_{};
};

/// The one way to "solved": a claim stands where residuals were taken, those `needed` among them,
/// and all are within their limits; otherwise it has not converged.
[[nodiscard]] Outcome outcome_by_evidence(const Outcome& claimed, const Evidence& evidence,
                                          const std::vector<Residual>& needed = {});

}  // namespace trammel::solver
