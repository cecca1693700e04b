#include "solver/time/sample_output.h"

namespace trammel::solver {

using Eigen::VectorXd;

namespace {

/// Cubic in s = 0 ... 1 over a step of length h, with values x and slopes d at its ends.
void hermite(double s, double h, const VectorXd& x0, const VectorXd& d0, const VectorXd& x1,
             const VectorXd& d1, VectorXd& x) {
  const double r = 1 - s;
  x = (r * r * (1 + 2 * s)) * x0 + (s * s * (1 + 2 * r)) * x1 + (h * s * r * r) * d0 -
      (h * s * s * r) * d1;
}

}  // namespace

void SampleOutput::start(const TransientState& state) {
  if (begun_) return;
  begun_ = true;
  if (!times_.empty() && times_.front() != state.time) return;
  do {
    emit(state.time, state.q, state.v, state.acceleration, state.told);
  } while (next_ < times_.size() && times_[next_] == state.time);
}

void SampleOutput::emit(double time, const VectorXd& q, const VectorXd& v, const VectorXd& a,
                        const MotionEnergy& energy, bool interpolated) {
  observe_({static_cast<Index>(next_), time, q, v, a, energy, interpolated});
  ++next_;
}

/// Step ends are sums of steps: rounding apart, such a sample is one.
constexpr double kEndOfStep = 1e-6;

void SampleOutput::step(const TransientState& begin, const TransientState& end, double h) {
  if (times_.empty()) {
    emit(end.time, end.q, end.v, end.acceleration, end.told);
    return;
  }
  bool inside = false;
  while (next_ < times_.size() && times_[next_] <= end.time) {
    const double time = times_[next_];
    const double s = (time - begin.time) / h;
    inside = s < 1 - kEndOfStep;
    const auto mix = [s](double x, double y) { return (1 - s) * x + s * y; };
    hermite(s, h, begin.q, begin.v, end.q, end.v, q_);
    hermite(s, h, begin.v, begin.acceleration, end.v, end.acceleration, v_);
    a_ = (1 - s) * begin.acceleration + s * end.acceleration;
    const MotionEnergy& e0 = begin.told;
    const MotionEnergy& e1 = end.told;
    emit(time, q_, v_, a_,
         {.kinetic = mix(e0.kinetic, e1.kinetic),
          .strain = mix(e0.strain, e1.strain),
          .work = mix(e0.work, e1.work),
          .dissipated = mix(e0.dissipated, e1.dissipated)},
         inside);
  }
  if (inside) observe_({-1, end.time, end.q, end.v, end.acceleration, end.told});
}

}  // namespace trammel::solver
