#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/model/numbers.h"
#include "solver/time/equation_of_motion.h"

/// Loads whose factors are linear between given times, constant outside them, and jump if a time
/// is given twice. At a jump a factor has the value after it.
namespace trammel::solver {

/// Between two of the times, or outside them: x = (1 - share) x[left] + share x[right].
struct TimeInterval {
  Index left = 0, right = 0;
  double share = 0;
  double length = 1;  ///< [s]
};
/// @param times  ascending
[[nodiscard]] TimeInterval find_interval(const std::vector<double>& times, double t);

/// Factor on loads. 1 throughout by default.
struct LoadHistory {
  std::vector<double> time{0.0};    ///< [s]
  std::vector<double> factor{1.0};  ///< one for each time [-]

  [[nodiscard]] bool constant() const { return time.size() == 1; }
  /// Where its slope changes or it jumps [s].
  [[nodiscard]] std::vector<double> bends() const;
  [[nodiscard]] double at(double t) const;
  /// The time whose loads act on the state in which a step of integration ends at `t`: at a jump,
  /// just before it.
  [[nodiscard]] double end_of_step(double t) const;
};

/// f(t) = pattern * factor(t).
struct PiecewiseLinearLoad {
  Eigen::MatrixXd pattern;   ///< coordinate x load [SI]
  std::vector<double> time;  ///< ascending [s]
  Eigen::MatrixXd factor;    ///< load x time [-]

  void at(double t, Eigen::VectorXd& f) const;
  /// Makes it the load of the equation, with its times as breakpoints.
  void apply_to(EquationOfMotion& equation) const;
  /// @throws ModelError  for sizes that differ or times that descend.
  void check() const;
};

/// From `start` on, the load does not change.
[[nodiscard]] PiecewiseLinearLoad step_load(const Eigen::VectorXd& pattern, double start = 0);

/// The product of a history and one load, and another load that always acts.
[[nodiscard]] PiecewiseLinearLoad load_by_history(const LoadHistory& history,
                                                  const Eigen::VectorXd& varied,
                                                  const Eigen::VectorXd& constant);

}  // namespace trammel::solver
