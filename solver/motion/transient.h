#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "solver/motion/equation_of_motion.h"
#include "solver/motion/integrate.h"

/// Motions of linear systems by integration in time.
namespace trammel::solver {

/// Energies since the start [J]. Kinetic + strain - work + dissipated stays constant but for what
/// the scheme dissipates or what changing matrices exchange.
struct MotionEnergy {
  double kinetic = 0;     ///< v^T M v / 2
  double strain = 0;      ///< q^T K q / 2
  double work = 0;        ///< of the load, trapezoidal over each step
  double dissipated = 0;  ///< by C, the same way; of a working motion by its drag on its u
  [[nodiscard]] double total() const { return kinetic + strain - work + dissipated; }
};

/// The motion at a sample time: between the ends of a step cubic Hermite in q and in v, linear in a
/// and in the energies. After those inside a step its end is shown, where the equation holds.
struct MotionSample {
  Index index = 0;             ///< -1: the end of a step, and no sample
  double time = 0;             ///< [s]
  const Eigen::VectorXd& q;    ///< [SI]
  const Eigen::VectorXd& v;    ///< q' [SI/s]
  const Eigen::VectorXd& a;    ///< q'' [SI/s^2]
  const MotionEnergy& energy;  ///< [J]
  bool interpolated = false;   ///< inside a step: the equation holds to the error of the steps
};
using MotionObserver = std::function<void(const MotionSample&)>;

/// Integrates, handing each sample to the observer. With constant matrices and fixed steps there is
/// one factorization and the loop does not allocate.
/// @throws ModelError  for sizes that differ, or a time or step without meaning.
[[nodiscard]] TransientSummary solve_transient(const EquationOfMotion& equation,
                                               const TransientOptions& options,
                                               const MotionObserver& observe);

/// All samples of a motion: coordinate x sample.
struct TransientHistory {
  TransientSummary summary;
  std::vector<double> time;  ///< [s]; ends at the failure if there is one
  Eigen::MatrixXd q, v, a;
  std::vector<MotionEnergy> energy;
};

[[nodiscard]] TransientHistory solve_transient(const EquationOfMotion& equation,
                                               const TransientOptions& options);

/// Where a quantity sampled at even times is largest in magnitude, refined by the parabola through
/// the sample and its two neighbours.
struct Peak {
  double time = 0;
  double value = 0;
};
[[nodiscard]] Peak peak(const std::vector<double>& time, const Eigen::VectorXd& value);

/// At the end of a time step.
struct TransientState {
  double time = 0;
  Eigen::VectorXd q, v, a;
  Eigen::VectorXd A;  ///< the scheme's accelerations ...
  double A_step = 0;  ///< ... and the step that they belong to
  Eigen::VectorXd f, Ma, Mv, Cv, Kq;
  MotionEnergy energy;
  WorkingMotion working;
  MotionEnergy shown;  ///< the energy, or that of the working motion

  explicit TransientState(Index n) {
    for (Eigen::VectorXd* x : {&q, &v, &a, &A, &f, &Ma, &Mv, &Cv, &Kq}) x->setZero(n);
  }
};

}  // namespace trammel::solver
