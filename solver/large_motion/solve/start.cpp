#include "solver/large_motion/solve/start.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace trammel::large {

namespace {

class Starter {
 public:
  Starter(const ConstrainedSystem& system, State& state, double step)
      : system_(system),
        state_(state),
        step_(step),
        n_(system.coordinates()),
        m_(system.constraints()),
        matrix_(n_, m_, system.blocks()),
        gap_(VectorXd::Zero(m_)),
        rate_(VectorXd::Zero(m_)),
        unbalanced_(VectorXd::Zero(n_)),
        solution_(VectorXd::Zero(n_ + m_)) {}

  Outcome run(const GivenVelocities& given) {
    state_.v.setZero(n_);
    state_.a.setZero(n_);
    if (state_.lambda.size() != m_) state_.lambda.setZero(m_);
    state_.load = system_.load_factor(state_.t);
    if (!positions()) return failed("positions");
    if (!velocities(given)) return failed("velocities");
    if (!accelerations()) return failed("accelerations");
    return {};
  }

 private:
  Outcome failed(const std::string& what) const {
    std::ostringstream words;
    words << "no consistent " << what << " at the start, time " << state_.t
          << " s: largest constraint gap " << (m_ > 0 ? rigid_gap() : 0.0) << " m or rad";
    return {Status::not_converged, words.str()};
  }

  double rigid_gap() const {
    double largest = 0;
    for (Index i = 0; i < m_; ++i) {
      if (rigid(i)) largest = std::max(largest, std::abs(gap_[i]));
    }
    return largest;
  }

  bool rigid(Index i) const { return system_.compliance()[i] == 0; }

  /// S = M + (fraction of step)^2 K.
  void assemble(double fraction) {
    const double stiffness = fraction * fraction * step_ * step_;
    matrix_.clear();
    weights_ = Weights{1, 0, stiffness, 1 / stiffness};
    system_.tangent(state_, weights_, matrix_);
  }

  bool positions() {
    double last = 1e300;
    for (int i = 0; i < 30; ++i) {
      system_.gaps(state_, gap_, rate_);
      const double now = rigid_gap();
      if (!std::isfinite(now)) return false;
      if (now == 0 || (now < 1e-12 && now > 0.5 * last)) return true;
      last = now;
      assemble(0.5);
      if (!matrix_.factor(system_.symmetric())) return false;
      solution_.setZero();
      for (Index r = 0; r < m_; ++r) {
        if (rigid(r)) solution_[n_ + r] = -gap_[r];
      }
      matrix_.solve(solution_);
      state_.q += solution_.head(n_);
    }
    return last < 1e-9;
  }

  bool velocities(const GivenVelocities& given) {
    assemble(1e-3);
    const double hold = 1e6 * whole_mass();
    for (const auto& [k, value] : given) matrix_.add_diagonal(k, hold);
    if (!matrix_.factor(system_.symmetric())) return false;
    VectorXd push = VectorXd::Zero(n_);
    for (int i = 0; i < 8; ++i) {
      // Each pass also takes away what the last one left of the given values.
      for (const auto& [k, value] : given) push[k] += hold * (value - state_.v[k]);
      State still = state_;
      still.v.setZero();
      system_.gaps(still, gap_, rate_);
      solution_.head(n_) = push;
      for (Index r = 0; r < m_; ++r) solution_[n_ + r] = rigid(r) ? -rate_[r] : 0.0;
      matrix_.solve(solution_);
      const double change = weighted_size(system_, solution_.head(n_) - state_.v);
      state_.v = solution_.head(n_);
      if (!state_.v.allFinite()) return false;
      if (change <= 1e-15 * weighted_size(system_, state_.v)) break;
    }
    return project_velocities();
  }

  /// What regularization left: a last correction onto G v + dg/dt = 0.
  bool project_velocities() {
    for (int i = 0; i < 2; ++i) {
      system_.gaps(state_, gap_, rate_);
      solution_.setZero();
      for (Index r = 0; r < m_; ++r) solution_[n_ + r] = rigid(r) ? -rate_[r] : 0.0;
      matrix_.solve(solution_);
      state_.v += solution_.head(n_);
    }
    return state_.v.allFinite();
  }

  double whole_mass() {
    State probe = state_;
    VectorXd r0(n_), r1(n_);
    system_.balance(probe, r0);
    probe.a.setOnes();
    system_.balance(probe, r1);
    const double sum = (r1 - r0).cwiseAbs().sum();
    return sum > 0 ? sum : 1.0;
  }

  bool accelerations() {
    system_.gaps(state_, gap_, rate_);
    const double tau = system_.strain_rate_damping();
    for (Index r = 0; r < m_; ++r) {
      const double c = system_.compliance()[r];
      state_.lambda[r] = c > 0 ? (gap_[r] + tau * rate_[r]) / c : 0.0;
    }
    const VectorXd bias = rate_of_rate();
    system_.balance(state_, unbalanced_);
    if (!accelerate(0.5, bias)) return false;
    const VectorXd resolved = solution_;
    // Without the step's view where that makes no great difference; where it does, what vibrates
    // faster than the step, or has no mass, would start wildly.
    if (!accelerate(1e-4, bias) || weighted_size(system_, solution_.head(n_)) >
                                       4 * weighted_size(system_, resolved.head(n_))) {
      solution_ = resolved;
    }
    state_.a = solution_.head(n_);
    for (Index r = 0; r < m_; ++r) {
      if (rigid(r)) state_.lambda[r] = solution_[n_ + r];
    }
    return state_.a.allFinite() && state_.lambda.allFinite();
  }

  bool accelerate(double fraction, const VectorXd& bias) {
    assemble(fraction);
    if (!matrix_.factor(system_.symmetric())) return false;
    solution_.head(n_) = -unbalanced_;
    for (Index r = 0; r < m_; ++r) solution_[n_ + r] = rigid(r) ? -bias[r] : 0.0;
    matrix_.solve(solution_);
    return solution_.allFinite();
  }

  /// d(G v + dg/dt)/dt without accelerations, by a central difference along the motion. The
  /// acceleration only starts the integrator, so ten digits are plenty.
  VectorXd rate_of_rate() {
    const double speed = state_.v.size() > 0 ? weighted_size(system_, state_.v) : 0.0;
    double d = 1e-2 * step_;
    if (speed > 0) d = std::min(d, 1e-5 / speed);
    VectorXd before = VectorXd::Zero(m_), after = VectorXd::Zero(m_);
    State near = state_;
    near.q = state_.q - d * state_.v;
    near.t = state_.t - d;
    system_.gaps(near, gap_, before);
    near.q = state_.q + d * state_.v;
    near.t = state_.t + d;
    system_.gaps(near, gap_, after);
    return (after - before) / (2 * d);
  }

  const ConstrainedSystem& system_;
  State& state_;
  double step_;
  Index n_, m_;
  KktMatrix matrix_;
  Weights weights_;
  VectorXd gap_, rate_, unbalanced_, solution_;
};

}  // namespace

double weighted_size(const ConstrainedSystem& system, const Eigen::Ref<const VectorXd>& change) {
  if (change.size() == 0) return 0;
  return change.cwiseQuotient(system.scale()).norm() /
         std::sqrt(static_cast<double>(change.size()));
}

Outcome make_consistent(const ConstrainedSystem& system, State& state, const GivenVelocities& given,
                        double step) {
  return Starter(system, state, step).run(given);
}

}  // namespace trammel::large
