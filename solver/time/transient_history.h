#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/time/transient.h"

namespace trammel::solver {

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

}  // namespace trammel::solver
