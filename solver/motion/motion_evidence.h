#pragma once

#include <Eigen/Core>
#include <limits>

#include "solver/model/evidence.h"
#include "solver/model/numbers.h"
#include "solver/motion/equation_of_motion.h"
#include "solver/motion/transient.h"

namespace trammel::solver {

/// Motions below have no digits: what numerical damping leaves of a vibration ends in them.
inline constexpr double kUnderflow = std::numeric_limits<double>::min() / kEps;

/// Residuals of a motion, taken step by step with matrices and loads of its own.
///
/// The energy that a step is held to follows from equilibrium at both of its ends and from the
/// scheme's relations between them (time_scheme.h). With x- the mean of x at the ends and dx its
/// change, T and V the kinetic and the strain energy,
///   dT + dV = dq.f- - dq.(C v)- + h (a- + (gamma - 1/2) da).(M v)-
///             - (h v- + h^2 (beta - gamma/2) da).(M A)-,
/// where the last two terms vanish for average acceleration and are otherwise what the scheme adds
/// or takes away. Matrices that change exchange (q_0.K_1 q_1 - q_1.K_0 q_0)/2, and M, v the same.
/// Source: Krenk, Energy conservation in Newmark based time integration algorithms, Comput. Methods
/// Appl. Mech. Engrg. 195 (2006), for alpha_m = alpha_f = 0, where a = A.
class MotionEvidence {
 public:
  /// @pre the equation outlives this
  explicit MotionEvidence(const EquationOfMotion& equation, const TimeScheme& scheme = {});

  /// |M A + C v + K q - f| over its terms, row by row, the largest. A coordinate counts with at
  /// least a thousandth of the largest one, made alike by the diagonal of M + step^2 K: where
  /// nothing moves but rounding, a row has no digits.
  void add_equilibrium(double time, double load_time, const Eigen::VectorXd& q,
                       const Eigen::VectorXd& v, const Eigen::VectorXd& A, double step);
  /// The scheme's relations between two states.
  void add_relations(const TransientState& from, const TransientState& to, double h);
  /// @param from  its energies, too
  void add_energy(const TransientState& from, const TransientState& to, double h);
  /// What is out of equilibrium where a segment starts does work in its first step: coordinates
  /// without mass have no acceleration that would balance it.
  void begin_segment(const Eigen::VectorXd& unbalanced) { unbalanced_ = unbalanced; }

  [[nodiscard]] Evidence result() const;

 private:
  void find_scale(double step);
  void set_sizes(const Eigen::VectorXd& x);
  void add_product(const SparseMatrix& A, const Eigen::VectorXd& x);

  EquationMatrices matrices_;
  TimeScheme scheme_;
  Evidence evidence_;
  double energy_ = 0, largest_imbalance_ = 0, throughput_ = 0, largest_energy_ = 0;
  bool has_energy_ = false;
  Eigen::VectorXd scale_, size_, sum_, terms_, f_, unbalanced_;
};

}  // namespace trammel::solver
