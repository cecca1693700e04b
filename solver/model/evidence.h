#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace trammel::solver {

/// Status of a computation. Numerical failures are reported by this value, never by an exception.
enum class Status { solved, singular, not_converged };

/// Status of a computation with its reason.
struct Outcome {
  Status status = Status::solved;
  std::string reason;  ///< explanation of a failure; empty if the status is `solved`
  [[nodiscard]] bool solved() const { return status == Status::solved; }
};

// Independent residuals that support a solution. The solution method does not use these residuals.

/// Type of a residual. Each residual is a sum that is zero for the exact solution, divided by the
/// sum of the magnitudes of its terms. A residual is a few eps (2.2e-16) if only round-off errors
/// exist, and about 1 for a meaningless solution.
enum class Residual {
  equilibrium,          ///< K u - f, row by row; K and f are assembled again for this check
  recovered_forces,     ///< sum of the reported member forces, reactions and loads on each node
  eigenvalue_equation,  ///< K x - w^2 M x, row by row, for every mode
  mode_count,  ///< number of missing, superfluous (Sylvester's law of inertia) and duplicate modes
  equation_of_motion,  ///< equation of motion, row by row; the largest over all steps
  constraints,  ///< position error of joints, drives and closed loops, relative to the model size
  energy,       ///< work of all forces minus the change of energy, over all time steps
  load,  ///< |K u - f| / |f|, or its round-off error if larger; increases with ill-conditioning
};
inline constexpr std::array kResiduals = {Residual::equilibrium,
                                          Residual::recovered_forces,
                                          Residual::eigenvalue_equation,
                                          Residual::mode_count,
                                          Residual::equation_of_motion,
                                          Residual::constraints,
                                          Residual::energy,
                                          Residual::load};

/// Name and limit of a type of residual.
struct ResidualRule {
  const char* name;  ///< name of the residual in results and messages
  double limit;      ///< a solution with a larger residual does not count as solved
  /// Description of the error term on which the limit of the residual is based.
  const char* why;
};
/// Returns the name and the limit of a type of residual.
[[nodiscard]] const ResidualRule& residual_rule(Residual kind);

/// Value of Residual::load above which a warning is issued. The solution is not rejected. Above
/// this value, ill-conditioning impairs the accuracy of the forces. Below this value, the solution
/// satisfies the loads more accurately than loads can be measured.
inline constexpr double kLoadWarning = 1e-6;

/// Collection of computed residuals, which stores the largest residual of each type.
class Evidence {
 public:
  /// Records a residual. NaN and negative values count as infinite.
  void add(Residual kind, double value);
  /// Records the residuals that another `Evidence` object contains.
  void add(const Evidence& other);
  [[nodiscard]] bool has(Residual kind) const { return taken_[index(kind)]; }
  /// Returns the largest recorded residual of a type, or 0 if none was recorded.
  [[nodiscard]] double largest(Residual kind) const { return largest_[index(kind)]; }
  [[nodiscard]] bool empty() const;

 private:
  static std::size_t index(Residual kind) { return static_cast<std::size_t>(kind); }

  std::array<bool, kResiduals.size()> taken_{};
  std::array<double, kResiduals.size()> largest_{};
};

/// Returns the outcome of a solution after a check of its residuals. A solved outcome is returned
/// unchanged under three conditions: residuals were computed, the residuals include all types in
/// `needed`, and all residuals are within their limits. Otherwise, the outcome is `not_converged`.
/// An outcome that is a failure is returned unchanged.
[[nodiscard]] Outcome outcome_by_evidence(const Outcome& claimed, const Evidence& evidence,
                                          const std::vector<Residual>& needed = {});

}  // namespace trammel::solver
