#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "solver/model/effects.h"
#include "solver/model/numbers.h"

/// The equation of motion (paper Eq. 13, 18),  M(t) q'' + C(t) q' + K(t) q = f(t).
namespace trammel::solver {

/// What energies are told of where q is measured from axes that move: u = T(t) q and its forces.
struct WorkingMotion {
  Eigen::VectorXd u, load, drag;   ///< drag: what damping takes [SI]
  double kinetic = 0, strain = 0;  ///< [J]
};

/// The equation as the integrator sees it. The matrices are square, stored whole, in compressed
/// form; K and C may have a skew part that is small beside M / h^2 (gyroscopic terms).
struct EquationOfMotion {
  SparseMatrix M, C, K;  ///< at the start [SI]; an empty C means no damping
  /// Writes f(t) [SI]; empty: no load. At a time of jump it gives the value after the jump.
  std::function<void(double time, Eigen::VectorXd& f)> load;
  /// Writes the values of M, C and K at `time`; empty: constant. The three then share one pattern,
  /// which stays.
  std::function<void(double time, SparseMatrix& M, SparseMatrix& C, SparseMatrix& K)> update;
  /// Of a state at a time, at one of jump after it; empty: q itself and the terms of the equation.
  std::function<WorkingMotion(double time, const Eigen::VectorXd& q, const Eigen::VectorXd& v)>
      working_motion;
  /// Times at which the load or its slope jumps [s]; a step ends at each.
  std::vector<double> breakpoints;
};

/// M, C and K at the time last asked for, on one pattern; without damping C is zero.
class EquationMatrices {
 public:
  /// @throws ModelError  where the matrices are not square, of one size and, if they change with
  ///                     time, of one pattern.
  /// @pre the equation outlives this
  explicit EquationMatrices(const EquationOfMotion& equation);

  void update(double time);
  [[nodiscard]] bool constant() const { return !equation_.update; }
  [[nodiscard]] const std::vector<double>& breakpoints() const { return equation_.breakpoints; }
  void load(double time, Eigen::VectorXd& f) const;

  [[nodiscard]] const SparseMatrix& M() const { return M_; }
  [[nodiscard]] const SparseMatrix& C() const { return C_; }
  [[nodiscard]] const SparseMatrix& K() const { return K_; }
  /// Largest column sums of magnitudes.
  [[nodiscard]] double norm_M() const { return norm_M_; }
  [[nodiscard]] double norm_C() const { return norm_C_; }
  [[nodiscard]] double norm_K() const { return norm_K_; }

 private:
  const EquationOfMotion& equation_;
  SparseMatrix M_, C_, K_;
  double norm_M_ = 0, norm_C_ = 0, norm_K_ = 0;
};

// Loads whose factors are linear between given times, constant outside them, and jump if a time
// is given twice. At a jump a factor has the value after it.

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
