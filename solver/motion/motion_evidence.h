#pragma once

#include <Eigen/Core>
#include <limits>

#include "solver/model/evidence.h"
#include "solver/model/numbers.h"
#include "solver/motion/equation_of_motion.h"
#include "solver/motion/transient.h"

namespace trammel::solver {

/// Magnitude below which motions are treated as zero, because underflow removes their digits.
/// Numerical damping can reduce motions to such magnitudes.
inline constexpr double kUnderflow = std::numeric_limits<double>::min() / kEps;

/// Residuals of a motion, computed step by step with separate copies of matrices and loads.
///
/// The expected change of energy in a step of size h follows from equilibrium at both ends of the
/// step and from the relations of the scheme (time_scheme.h). x- is the mean of a quantity x at
/// both ends, and dx its change. T and V are the kinetic and the strain energy. A is the
/// acceleration that satisfies the equation of motion, and a the algorithmic acceleration (the
/// symbols are exchanged in time_scheme.h):
///
///   dT + dV = dq.f- - dq.(C v)- + h (a- + (gamma - 1/2) da).(M v)-
///             - (h v- + h^2 (beta - gamma/2) da).(M A)-.
///
/// The last two terms vanish for average acceleration. For other schemes, they are the energy that
/// the scheme adds or removes. Matrices that change with time add the energy (q_0.K_1 q_1 - q_1.K_0
/// q_0)/2, and the same expression with M and v.
/// Source: Krenk, Energy conservation in Newmark based time integration algorithms, Comput. Methods
/// Appl. Mech. Engrg. 195 (2006), for alpha_m = alpha_f = 0, where a = A.
class MotionEvidence {
 public:
  /// @pre `equation` must outlive this object.
  explicit MotionEvidence(const EquationOfMotion& equation, const TimeScheme& scheme = {});

  /// Adds the largest residual |M A + C v + K q - f| of a row, relative to the sum of the
  /// magnitudes of its terms. The load f is that at `load_time`, and the matrices are those at
  /// `time`. In the magnitudes, each coordinate has at least the fraction `kLeastFraction` of the
  /// largest coordinate. For this comparison, coordinates are scaled by the square root of the
  /// diagonal of M + step^2 K. Otherwise, rows whose motions are only round-off errors would have
  /// no scale.
  void add_equilibrium(double time, double load_time, const Eigen::VectorXd& q,
                       const Eigen::VectorXd& v, const Eigen::VectorXd& A, double step);
  /// Adds the residuals of the relations between q, v, a and A that define the time scheme
  /// (time_scheme.h), in a step of size h.
  void add_scheme_residual(const TransientState& from, const TransientState& to, double h);
  /// Adds the residual of the energy balance in a step of size h between two states.
  void add_energy_balance(const TransientState& from, const TransientState& to, double h);
  /// Starts a segment between two breakpoints. `unbalanced` are the forces that are not balanced at
  /// its start. They do work in the first step, because massless coordinates have no inertia forces
  /// that balance these forces.
  void begin_segment(const Eigen::VectorXd& unbalanced) { unbalanced_ = unbalanced; }

  /// Returns the largest residuals of all added states and steps.
  [[nodiscard]] Evidence result() const;

 private:
  void set_coordinate_scale(double step);
  void set_floored_magnitudes(const Eigen::VectorXd& x);
  void add_product(const SparseMatrix& A, const Eigen::VectorXd& x);

  EquationMatrices matrices_;
  TimeScheme scheme_;
  Evidence evidence_;
  double energy_ = 0, largest_imbalance_ = 0, throughput_ = 0, largest_energy_ = 0;
  bool has_energy_ = false;
  Eigen::VectorXd scale_, size_, sum_, terms_, f_, unbalanced_;
};

}  // namespace trammel::solver
