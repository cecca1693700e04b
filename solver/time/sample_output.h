#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/time/transient.h"

namespace trammel::solver {

/// At the end of a time step.
struct TransientState {
  double time = 0;
  Eigen::VectorXd q, v;
  Eigen::VectorXd a;             ///< the algorithm's acceleration (time_scheme.h) ...
  double a_step = 0;             ///< ... and the step it belongs to
  Eigen::VectorXd acceleration;  ///< A, in equilibrium
  Eigen::VectorXd f, MA, Mv, Cv, Kq;
  MotionEnergy energy;
  WorkingMotion working;
  MotionEnergy told;  ///< the energy, or that of the working motion

  explicit TransientState(Index n)
      : q(Eigen::VectorXd::Zero(n)),
        v(Eigen::VectorXd::Zero(n)),
        a(Eigen::VectorXd::Zero(n)),
        acceleration(Eigen::VectorXd::Zero(n)),
        f(Eigen::VectorXd::Zero(n)),
        MA(Eigen::VectorXd::Zero(n)),
        Mv(Eigen::VectorXd::Zero(n)),
        Cv(Eigen::VectorXd::Zero(n)),
        Kq(Eigen::VectorXd::Zero(n)) {}
};

/// Hands the samples that a step covers to the observer.
class SampleOutput {
 public:
  /// @param times  ascending; empty: the ends of all steps.   @pre both outlive this
  SampleOutput(const std::vector<double>& times, const MotionObserver& observe)
      : times_(times), observe_(observe) {}

  void start(const TransientState& state);
  /// Whether a step that ends then covers a sample.
  [[nodiscard]] bool covers(double end) const {
    return times_.empty() || (next_ < times_.size() && times_[next_] <= end);
  }
  /// Between the ends of the step of length h.
  void step(const TransientState& begin, const TransientState& end, double h);

 private:
  void emit(double time, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
            const Eigen::VectorXd& a, const MotionEnergy& energy, bool interpolated = false);

  const std::vector<double>& times_;
  const MotionObserver& observe_;
  bool begun_ = false;
  std::size_t next_ = 0;
  Eigen::VectorXd q_, v_, a_;
};

}  // namespace trammel::solver
