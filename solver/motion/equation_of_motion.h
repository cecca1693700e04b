#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "solver/model/effects.h"
#include "solver/model/numbers.h"

/// Equation of motion (Varalakshmi & Srinivas 2017, Eq. 13, 18), M(t) q'' + C(t) q' + K(t) q =
/// f(t).
namespace trammel::solver {

/// State from which energies are computed if q is measured relative to moving axes. It consists of
/// the displacements u = T(t) q and the forces that act on them.
struct WorkingMotion {
  Eigen::VectorXd u, load, drag;   ///< load and damping forces [SI]
  double kinetic = 0, strain = 0;  ///< [J]
};

/// Equation of motion for the integrator. The matrices are square, store both triangles, and are
/// compressed. K and C may have a skew-symmetric part that is small compared with M / h^2
/// (gyroscopic terms).
struct EquationOfMotion {
  SparseMatrix M, C, K;  ///< at the start [SI]; an empty C means no damping
  /// Function that writes the load f(t) [SI]; empty: no load. At a jump it writes the value after
  /// the jump.
  std::function<void(double time, Eigen::VectorXd& f)> load;
  /// Function that writes M, C and K at `time`; empty: constant matrices. With `update`, the
  /// entries of the three matrices have the same positions, which do not change.
  std::function<void(double time, SparseMatrix& M, SparseMatrix& C, SparseMatrix& K)> update;
  /// Function that returns the working motion of a state at a time, after a jump at this time. If
  /// it is empty, energies are computed with u = q, and with the forces f and C q' of the equation
  /// of motion.
  std::function<WorkingMotion(double time, const Eigen::VectorXd& q, const Eigen::VectorXd& v)>
      working_motion;
  /// Times at which the load or its slope jumps [s]. A step ends at each of them.
  std::vector<double> breakpoints;
};

/// M, C and K at the time of the last update, with entries at the same positions. C is zero without
/// damping.
class EquationMatrices {
 public:
  /// Copies the matrices.
  /// @throws ModelError  if the matrices are not square and of equal size, or change with time and
  ///   differ in their patterns.
  /// @pre The equation outlives this object.
  explicit EquationMatrices(const EquationOfMotion& equation);

  void update(double time);
  [[nodiscard]] bool is_constant() const { return !equation_.update; }
  [[nodiscard]] const std::vector<double>& breakpoints() const { return equation_.breakpoints; }
  void compute_load(double time, Eigen::VectorXd& f) const;

  [[nodiscard]] const SparseMatrix& M() const { return M_; }
  [[nodiscard]] const SparseMatrix& C() const { return C_; }
  [[nodiscard]] const SparseMatrix& K() const { return K_; }
  /// Returns the norm of the matrix M, C or K: the largest column sum of magnitudes.
  [[nodiscard]] double norm_M() const { return norm_M_; }
  [[nodiscard]] double norm_C() const { return norm_C_; }
  [[nodiscard]] double norm_K() const { return norm_K_; }

 private:
  const EquationOfMotion& equation_;
  SparseMatrix M_, C_, K_;
  double norm_M_ = 0, norm_C_ = 0, norm_K_ = 0;
};

// Loads whose factors are linear between given times and constant outside them. A factor jumps if a
// time is given twice. Its value at a jump is the value after the jump.

/// Interval between two given times, or the range before or after all times. A quantity x is
/// interpolated as (1 - share) x[left] + share x[right].
struct TimeInterval {
  Index left = 0, right = 0;
  double share = 0;
  double length = 1;  ///< [s]
};
/// Finds the interval between two entries of `times`, or the range before or after them, that
/// contains the time t.
/// @param times  ascending [s].
/// @param t  time [s].
[[nodiscard]] TimeInterval find_interval(const std::vector<double>& times, double t);

/// Factor on loads as a function of time. The default factor is 1 at all times.
struct LoadHistory {
  std::vector<double> time{0.0};    ///< [s]
  std::vector<double> factor{1.0};  ///< one for each time [-]

  [[nodiscard]] bool is_constant() const { return time.size() == 1; }
  /// Returns the times of jumps of the factor or its slope [s].
  [[nodiscard]] std::vector<double> breakpoint_times() const;
  /// Returns the load factor at time t [-].
  [[nodiscard]] double at(double t) const;
  /// Returns the time [s] at which loads are evaluated for the end `t` of a step. If the factor
  /// jumps at `t`, this time is just before `t`.
  [[nodiscard]] double step_end_load_time(double t) const;
};

/// Load f(t) = pattern * factor(t).
struct PiecewiseLinearLoad {
  Eigen::MatrixXd pattern;   ///< coordinate x load [SI]
  std::vector<double> time;  ///< ascending [s]
  Eigen::MatrixXd factor;    ///< load x time [-]

  /// Writes the load vector at time t to `f`.
  void at(double t, Eigen::VectorXd& f) const;
  /// Sets this load as the load of an equation, and adds its times to the breakpoints.
  void apply_to(EquationOfMotion& equation) const;
  /// Checks the sizes of `pattern`, `time` and `factor`, and the order of the times.
  /// @throws ModelError  if the sizes differ or the times descend.
  void check() const;
};

/// Returns a load that is constant after `start`, and zero before.
[[nodiscard]] PiecewiseLinearLoad step_load(const Eigen::VectorXd& pattern, double start = 0);

/// Returns the sum of the load `varied` times the factor of a history, and the load `constant`.
[[nodiscard]] PiecewiseLinearLoad load_by_history(const LoadHistory& history,
                                                  const Eigen::VectorXd& varied,
                                                  const Eigen::VectorXd& constant);

}  // namespace trammel::solver
