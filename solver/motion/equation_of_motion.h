#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "solver/model/effects.h"
#include "solver/model/numbers.h"

/// Equation of motion (Varalakshmi & Srinivas 2017, Eq. 13, 18), M(t) q'' + C(t) q' + K(t) q =
/// f(t).
namespace trammel::solver {

/// State from which energies are computed if q is measured relative to moving axes. The state
/// contains the displacements u = T(t) q and the forces on u.
struct WorkingMotion {
  /// Displacements u, and load and damping forces on u [SI].
  Eigen::VectorXd u, load, drag;
  /// Kinetic energy and strain energy [J].
  double kinetic = 0, strain = 0;
};

/// Equation of motion for the integrator. The matrices are square, store both triangles, and are
/// compressed. K and C may have a skew-symmetric part (gyroscopic terms). This part must be small
/// compared with M / h^2 for time steps h.
struct EquationOfMotion {
  /// Matrices at the start of the motion [SI]. C is empty without damping.
  SparseMatrix M, C, K;
  /// Function that writes the load f(t) [SI]; empty: no load. If the load jumps at `time`, the
  /// function writes the value after the jump.
  std::function<void(double time, Eigen::VectorXd& f)> load;
  /// Function that writes M, C and K at `time`; empty: constant matrices. With `update`, the three
  /// matrices must have equal and constant sparsity patterns.
  std::function<void(double time, SparseMatrix& M, SparseMatrix& C, SparseMatrix& K)> update;
  /// Function that returns the working motion of a state at a time. If the load jumps at this time,
  /// the value after the jump is used. If the function is empty, energies are computed with u = q
  /// and with the forces f and C q' of the equation of motion.
  std::function<WorkingMotion(double time, const Eigen::VectorXd& q, const Eigen::VectorXd& v)>
      working_motion;
  /// Times at which the load or its slope jumps [s]. A time step ends at each breakpoint.
  std::vector<double> breakpoints;
};

/// Matrices M (mass), C (damping) and K (stiffness) at the time of the last update, with equal
/// sparsity patterns. C is zero without damping.
class EquationMatrices {
 public:
  /// Copies the matrices of an equation of motion.
  /// @throws ModelError  if the matrices are not square and of equal size, or change with time and
  ///   have different sparsity patterns.
  /// @pre `equation` must outlive this object.
  explicit EquationMatrices(const EquationOfMotion& equation);

  void update(double time);
  [[nodiscard]] bool is_constant() const { return !equation_.update; }
  [[nodiscard]] const std::vector<double>& breakpoints() const { return equation_.breakpoints; }
  void compute_load(double time, Eigen::VectorXd& f) const;

  [[nodiscard]] const SparseMatrix& M() const { return M_; }
  [[nodiscard]] const SparseMatrix& C() const { return C_; }
  [[nodiscard]] const SparseMatrix& K() const { return K_; }
  /// Returns a norm of the matrix M, C or K: the largest column sum of magnitudes.
  [[nodiscard]] double norm_M() const { return norm_M_; }
  [[nodiscard]] double norm_C() const { return norm_C_; }
  [[nodiscard]] double norm_K() const { return norm_K_; }

 private:
  const EquationOfMotion& equation_;
  SparseMatrix M_, C_, K_;
  double norm_M_ = 0, norm_C_ = 0, norm_K_ = 0;
};

// Loads whose factors are linear between given times, and constant before the first and after the
// last time. A factor jumps if a time is given twice. Its value at a jump is the value after the
// jump.

/// Interval between two successive given times, or the range before the first or after the last
/// time. A quantity x is interpolated as (1 - share) x[left] + share x[right].
struct TimeInterval {
  Index left = 0, right = 0;
  double share = 0;
  /// Length of the interval [s].
  double length = 1;
};
/// Finds the interval of `times` that contains the time t. It may be the range before the first or
/// after the last time.
/// @param times  ascending times [s].
/// @param t  time [s].
[[nodiscard]] TimeInterval find_interval(const std::vector<double>& times, double t);

/// Load factor as a function of time. By default, the factor is 1 at all times.
struct LoadHistory {
  /// Times at which factors are given, ascending [s].
  std::vector<double> time{0.0};
  /// Load factor at each time [-].
  std::vector<double> factor{1.0};

  [[nodiscard]] bool is_constant() const { return time.size() == 1; }
  /// Returns the times at which the factor or its slope jumps [s].
  [[nodiscard]] std::vector<double> breakpoint_times() const;
  /// Returns the load factor at time t [-].
  [[nodiscard]] double at(double t) const;
  /// Returns the time [s] at which loads are evaluated for a time step that ends at `t`. If the
  /// factor jumps at `t`, the returned time is just before `t`.
  [[nodiscard]] double step_end_load_time(double t) const;
};

/// Sum of loads, f(t) = pattern * factor(t). The factors are linear between given times.
struct PiecewiseLinearLoad {
  /// Load vectors [SI]: one row per coordinate, one column per load.
  Eigen::MatrixXd pattern;
  /// Times at which factors are given, ascending [s].
  std::vector<double> time;
  /// Load factors [-]: one row per load, one column per time.
  Eigen::MatrixXd factor;

  /// Writes the load vector at time t to `f`.
  void at(double t, Eigen::VectorXd& f) const;
  /// Sets this load as the load of an equation of motion, and adds its times to the breakpoints of
  /// the equation.
  void apply_to(EquationOfMotion& equation) const;
  /// Checks the sizes of `pattern`, `time` and `factor`, and the order of the times.
  /// @throws ModelError  if the sizes differ or the times descend.
  void check() const;
};

/// Returns a load that is constant after `start`, and zero before.
[[nodiscard]] PiecewiseLinearLoad step_load(const Eigen::VectorXd& pattern, double start = 0);

/// Returns the sum of two loads: `varied` times the load factor of a history, and `constant`.
[[nodiscard]] PiecewiseLinearLoad load_by_history(const LoadHistory& history,
                                                  const Eigen::VectorXd& varied,
                                                  const Eigen::VectorXd& constant);

}  // namespace trammel::solver
