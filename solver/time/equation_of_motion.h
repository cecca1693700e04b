#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "solver/model/counters.h"

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

}  // namespace trammel::solver
