#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "solver/motion/equation_of_motion.h"
#include "solver/motion/integrate.h"

/// Motions of linear systems by integration in time.
namespace trammel::solver {

/// Energies of a motion, and work and dissipation since its start [J]. The sum kinetic + strain -
/// work + dissipated is constant if neither the time scheme nor changing matrices add or remove
/// energy.
struct MotionEnergy {
  double kinetic = 0;  ///< kinetic energy v^T M v / 2
  double strain = 0;   ///< strain energy q^T K q / 2
  double work = 0;     ///< work of the load, by the trapezoidal rule over each step
  /// Energy dissipated by damping, by the trapezoidal rule. With a working motion: work of `drag`.
  double dissipated = 0;
  [[nodiscard]] double total() const { return kinetic + strain - work + dissipated; }
};

/// Motion at a sample time. Between the ends of a step, q and v are cubic Hermite polynomials, and
/// a and the energies are linear. After samples inside a step, the state at the end of the step is
/// also output, because the equation of motion is satisfied at this time.
struct MotionSample {
  /// Index of the sample; -1: the time is the end of a step and no sample time.
  Index index = 0;
  double time = 0;             ///< sample time [s]
  const Eigen::VectorXd& q;    ///< displacements [SI]
  const Eigen::VectorXd& v;    ///< velocities q' [SI/s]
  const Eigen::VectorXd& a;    ///< accelerations q'' [SI/s^2]
  const MotionEnergy& energy;  ///< energies, work and dissipation [J]
  /// true: the time is inside a step, so that the equation of motion has an interpolation error.
  bool interpolated = false;
};
/// Function that receives the samples of a motion.
using MotionObserver = std::function<void(const MotionSample&)>;

/// Integrates an equation of motion and passes each sample to the observer. With constant matrices
/// and fixed steps, there is one factorization, and the loop over steps does not allocate memory.
/// @throws ModelError  if the sizes of vectors and matrices differ, or a time or step is invalid.
[[nodiscard]] TransientSummary solve_transient(const EquationOfMotion& equation,
                                               const TransientOptions& options,
                                               const MotionObserver& observe);

/// All samples of a motion: one row per coordinate, one column per sample.
struct TransientHistory {
  TransientSummary summary;
  /// Sample times up to the end or up to a failure [s].
  std::vector<double> time;
  Eigen::MatrixXd q, v, a;
  std::vector<MotionEnergy> energy;
};

/// Integrates an equation of motion and returns all samples.
[[nodiscard]] TransientHistory solve_transient(const EquationOfMotion& equation,
                                               const TransientOptions& options);

/// Largest magnitude of a quantity that is sampled at equal time steps. The peak is refined by the
/// parabola through the largest sample and its two neighbors.
struct Peak {
  double time = 0;
  double value = 0;
};
/// Returns the refined peak of values at equally spaced times [s], or zeros if `value` is empty.
[[nodiscard]] Peak peak(const std::vector<double>& time, const Eigen::VectorXd& value);

/// Motion at the end of a time step: displacements, velocities, accelerations, forces and energies.
struct TransientState {
  double time = 0;
  Eigen::VectorXd q, v, a;
  Eigen::VectorXd A;  ///< algorithmic accelerations of the scheme
  /// Size of the step to which A refers [s].
  double A_step = 0;
  Eigen::VectorXd f, Ma, Mv, Cv, Kq;
  MotionEnergy energy;
  WorkingMotion working;
  /// Output energy: `energy`, or the energy of the working motion.
  MotionEnergy shown;

  explicit TransientState(Index n) {
    for (Eigen::VectorXd* x : {&q, &v, &a, &A, &f, &Ma, &Mv, &Cv, &Kq}) x->setZero(n);
  }
};

}  // namespace trammel::solver
