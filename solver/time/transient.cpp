#include "solver/time/transient.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <sstream>
#include <utility>

#include "solver/linalg/sparse_ldlt.h"
#include "solver/model/model.h"
#include "solver/model/numbers.h"
#include "solver/time/massless_coordinates.h"
#include "solver/time/motion_evidence.h"
#include "solver/time/sample_output.h"
#include "solver/time/transient_start.h"

namespace trammel::solver {
namespace {

using Eigen::VectorXd;

/// A step counts as solved when what is left of the equation is below this share of its terms, or
/// is round-off of its largest products.
constexpr double kResidual = 1e-10;
/// Motions so small have no digits: what numerical damping leaves of a vibration ends in them.
constexpr double kUnderflow =
    std::numeric_limits<double>::min() / std::numeric_limits<double>::epsilon();
constexpr int kMaxRefinements = 40;

double infinity_norm(const VectorXd& x) {
  return x.size() ? x.lpNorm<Eigen::Infinity>() : 0;
}

void check(const EquationOfMotion& e, const TransientOptions& o) {
  const Index n = e.M.rows();
  const auto missing_or_sized = [n](const VectorXd& x) { return x.size() == 0 || x.size() == n; };
  if (!missing_or_sized(o.q0) || !missing_or_sized(o.v0)) {
    throw ModelError("the initial state has the size of the equation of motion");
  }
  if (!(std::isfinite(o.start) && std::isfinite(o.end) && o.end > o.start)) {
    throw ModelError("a motion ends after it starts");
  }
  if (!(std::isfinite(o.step) && o.step > 0)) throw ModelError("the time step must be positive");
  if (!std::is_sorted(o.sample_times.begin(), o.sample_times.end()) ||
      (!o.sample_times.empty() &&
       !(o.sample_times.front() >= o.start && o.sample_times.back() <= o.end))) {
    throw ModelError("sample times ascend within the time of the motion");
  }
  if (o.adaptive && !(o.adaptive->relative >= 0 && o.adaptive->absolute >= 0 &&
                      o.adaptive->relative + o.adaptive->absolute > 0 &&
                      o.adaptive->finest_level >= 0 && o.adaptive->finest_level <= 40)) {
    throw ModelError("error control needs a positive tolerance and at most 40 levels");
  }
}

/// Ends of the intervals in which the load is smooth.
std::vector<double> segment_ends(const EquationOfMotion& e, const TransientOptions& o) {
  std::vector<double> ends;
  for (const double t : e.breakpoints) {
    if (t > o.start && t < o.end) ends.push_back(t);
  }
  ends.push_back(o.end);
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return ends;
}

class TransientIntegrator {
 public:
  TransientIntegrator(const EquationOfMotion& equation, const TransientOptions& options,
                      const MotionObserver& observe)
      : equation_(equation),
        options_(options),
        scheme_(options.scheme),
        matrices_(equation),
        S_(matrices_.M()),
        now_(equation.M.rows()),
        next_(equation.M.rows()),
        evidence_(equation, options.scheme),
        output_(options.sample_times, observe) {
    for (VectorXd* x : {&residual_, &correction_}) x->setZero(S_.rows());
  }

  TransientSummary run() {
    if (start()) {
      const std::vector<double> ends = segment_ends(equation_, options_);
      double begin = options_.start;
      for (const double end : ends) {
        if (!integrate_segment(begin, end)) break;
        begin = end;
      }
    }
    summary_.time = now_.time;
    summary_.evidence = evidence_.result();
    summary_.outcome = outcome_by_evidence(summary_.outcome, summary_.evidence,
                                           {Residual::equation_of_motion, Residual::energy});
    summary_.counters.steps = summary_.accepted + summary_.rejected;
    return summary_;
  }

 private:
  bool fail(Status status, const std::string& reason) {
    summary_.outcome = {status, reason};
    return false;
  }

  [[nodiscard]] std::string describe_step(double h) const {
    std::ostringstream message;
    message << "step " << summary_.accepted + 1 << " to t = " << now_.time + h << " s (h = " << h
            << " s)";
    return message.str();
  }

  bool start() {
    now_.time = options_.start;
    if (options_.q0.size()) now_.q = options_.q0;
    if (options_.v0.size()) now_.v = options_.v0;
    Outcome& outcome = summary_.outcome;
    if (options_.quasi_static_start) {
      outcome = start_quasi_statically(matrices_, options_, now_.q, now_.v, summary_.counters);
      if (!outcome.solved()) return false;
    }
    matrices_.update(now_.time);
    if (!options_.adaptive) outcome = check_stability(matrices_, options_, summary_.counters);
    if (!outcome.solved()) return false;
    now_.Mv.noalias() = matrices_.M() * now_.v;
    now_.Kq.noalias() = matrices_.K() * now_.q;
    now_.energy.kinetic = 0.5 * now_.v.dot(now_.Mv);
    now_.energy.strain = 0.5 * now_.q.dot(now_.Kq);
    return true;
  }

  // ---- segments and steps ----------------------------------------------------------------------

  /// Accelerations in equilibrium at the start of a segment. Coordinates without mass have none of
  /// their own: with constant matrices they follow the others, else the acceleration is the one
  /// that the first step of length h would find.
  bool begin_segment(double h, int level) {
    matrices_.update(now_.time);
    matrices_.load(now_.time, now_.f);
    now_.Cv.noalias() = matrices_.C() * now_.v;
    now_.Kq.noalias() = matrices_.K() * now_.q;
    residual_ = now_.f - now_.Cv - now_.Kq;
    if (!mass_factor_) mass_factor_ = std::make_unique<SparseLdlt>(SparseLdlt::Triangle::mean);
    if (!matrices_.constant() || !mass_is_factored_) {
      ++summary_.counters.factorizations;
      mass_is_singular_ = !mass_factor_->factorize(matrices_.M()) ||
                          mass_factor_->smallest_to_largest_pivot() < kSingularMass;
      mass_is_factored_ = true;
    }
    start_factor_ = mass_is_singular_ ? step_factor(h, level) : mass_factor_.get();
    if (!start_factor_)
      return fail(Status::singular, "M + C h + K h^2 is singular at " + describe_step(h));
    massless_balance_ = mass_is_singular_ && matrices_.constant() &&
                        massless_.factor(matrices_, h, summary_.counters);
    if (massless_balance_) {
      settle_massless(h);
    } else {
      start_factor_->solve(residual_, now_.acceleration);
      ++summary_.counters.solves;
    }
    if (equation_.working_motion) {
      now_.working = equation_.working_motion(now_.time, now_.q, now_.v);
      now_.told.kinetic = now_.working.kinetic;
      now_.told.strain = now_.working.strain;
    } else {
      now_.told = now_.energy;
    }
    now_.a = now_.acceleration;
    now_.a_step = h;
    now_.MA.noalias() = matrices_.M() * now_.acceleration;
    evidence_.begin_segment(residual_ - now_.MA);
    if (!mass_is_singular_) {
      evidence_.add_equilibrium(now_.time, now_.time, now_.q, now_.v, now_.acceleration, h);
    }
    return true;
  }

  /// A jump of the load moves coordinates without mass at once, and what it does beyond straining
  /// is lost.
  void settle_massless(double h) {
    correction_ = now_.q;
    matrices_.load(now_.time + h / 2, next_.f);
    massless_.settle(now_, (next_.f - now_.f) / (h / 2));
    now_.Cv.noalias() = matrices_.C() * now_.v;
    now_.Kq.noalias() = matrices_.K() * now_.q;
    residual_ = now_.f - now_.Cv - now_.Kq;
    const double strain = 0.5 * now_.q.dot(now_.Kq), work = now_.f.dot(now_.q - correction_);
    now_.energy.dissipated += work - (strain - now_.energy.strain);
    now_.energy.work += work;
    now_.energy.strain = strain;
  }

  /// What the load of the segment can move: the size of the motion, before there is any, to which
  /// the error is compared. x = M^-1 f moves as an oscillator with its own Rayleigh quotient, a
  /// free body as far as the time lasts: to the place where the load would hold it, or as far as
  /// the speed carries that a shorter segment leaves it.
  void estimate_size_from_load(double begin, double end) {
    constexpr int kPoints = 8;
    const double time = options_.end - options_.start;
    for (int i = 0; i <= kPoints; ++i) {
      const double t = i == kPoints ? std::nextafter(end, begin)
                                    : begin + (end - begin) * static_cast<double>(i) / kPoints;
      matrices_.load(t, next_.f);
      start_factor_->solve(next_.f, correction_);
      ++summary_.counters.solves;
      next_.MA.noalias() = matrices_.M() * correction_;
      next_.Kq.noalias() = matrices_.K() * correction_;
      const double squared = correction_.dot(next_.MA);
      if (!(squared > 0)) continue;
      const double stiffness = std::max(correction_.dot(next_.Kq) / squared, 1 / (time * time));
      const double share = std::min(1.0, (end - begin) * std::sqrt(stiffness));
      largest_ = std::max(largest_, share * std::sqrt(squared) / stiffness);
    }
  }

  void set_largest_step(double h) {
    if (factors_step_ != 0 && std::abs(h - factors_step_) <= 1e-12 * factors_step_) return;
    factors_.clear();
    factors_step_ = h;
  }

  bool fail_at_smallest_step(double h, double ratio) {
    std::ostringstream message;
    message << describe_step(h) << ": the estimated error is " << ratio
            << " times what is allowed, and the step is the smallest";
    return fail(Status::not_converged, message.str());
  }

  bool integrate_segment(double begin, double end) {
    const double span = end - begin;
    const double step_count = std::max(1.0, std::ceil(span / options_.step * (1 - 1e-9)));
    if (step_count > 1e12) return fail(Status::not_converged, "more than 1e12 steps");
    set_largest_step(span / step_count);
    auto count = static_cast<std::int64_t>(step_count);  // of steps of the present level
    std::int64_t done = 0;
    int level = options_.adaptive ? std::min(level_, options_.adaptive->finest_level) : 0;
    count <<= level;
    if (!begin_segment(std::ldexp(factors_step_, -level), level)) return false;
    output_.start(now_);
    if (options_.adaptive) estimate_size_from_load(begin, end);
    while (done < count) {
      const double h = std::ldexp(factors_step_, -level);
      const bool last = done + 1 == count;
      const double time = last ? end : begin + static_cast<double>(done + 1) * h;
      // The left limit at a jump; see EquationOfMotion::load.
      const double load_time = last ? std::nextafter(end, begin) : time;
      if (!try_step(h, level, time, load_time)) return false;
      const double ratio = error_ratio(h);
      if (ratio > 1) {
        ++summary_.rejected;
        if (++level > options_.adaptive->finest_level) return fail_at_smallest_step(h, ratio);
        count *= 2;
        done *= 2;
        continue;
      }
      accept(h, load_time);
      ++done;
      if (options_.adaptive && level > 0 && ratio < 0.125 && done % 2 == 0) {
        --level;
        done /= 2;
        count /= 2;
      }
    }
    level_ = level;
    return true;
  }

  /// M + gamma' h C + beta' h^2 K, factored; null where singular.
  SparseLdlt* step_factor(double h, int level) {
    const double c = gamma_prime() * h;
    const double k = beta_prime() * h * h;
    if (!matrices_.constant()) {
      if (factors_.empty())
        factors_.push_back(std::make_unique<SparseLdlt>(SparseLdlt::Triangle::mean));
      level = 0;
    } else {
      if (factors_.size() <= static_cast<std::size_t>(level)) {
        factors_.resize(static_cast<std::size_t>(level) + 1);
      }
      auto& cached = factors_[static_cast<std::size_t>(level)];
      if (cached) return cached.get();
      cached = std::make_unique<SparseLdlt>(SparseLdlt::Triangle::mean);
    }
    S_.coeffs() = matrices_.M().coeffs() + c * matrices_.C().coeffs() + k * matrices_.K().coeffs();
    ++summary_.counters.factorizations;
    SparseLdlt* factor = factors_[static_cast<std::size_t>(level)].get();
    return factor->factorize(S_) ? factor : nullptr;
  }

  [[nodiscard]] double gain() const { return (1 - scheme_.alpha_f) / (1 - scheme_.alpha_m); }
  [[nodiscard]] double gamma_prime() const { return scheme_.gamma * gain(); }
  [[nodiscard]] double beta_prime() const { return scheme_.beta * gain(); }

  /// One step from now_ to next_: predictors with A_1 = 0, then corrections until the equation of
  /// motion holds at the end of the step. Symmetric matrices need one.
  bool try_step(double h, int level, double time, double load_time) {
    const TimeScheme& s = scheme_;
    if (now_.a_step != h) {  // a lies alpha_m - alpha_f steps off the time of A
      now_.a = now_.acceleration + (h / now_.a_step) * (now_.a - now_.acceleration);
      now_.a_step = h;
    }
    matrices_.update(time);
    matrices_.load(load_time, next_.f);
    SparseLdlt* factor = step_factor(h, level);
    if (!factor)
      return fail(Status::singular, "M + C h + K h^2 is singular at " + describe_step(h));
    next_.acceleration.setZero();
    next_.a = (s.alpha_f * now_.acceleration - s.alpha_m * now_.a) / (1 - s.alpha_m);
    next_.q = now_.q + h * now_.v + h * h * ((0.5 - s.beta) * now_.a + s.beta * next_.a);
    next_.v = now_.v + h * ((1 - s.gamma) * now_.a + s.gamma * next_.a);
    double left = std::numeric_limits<double>::infinity();
    double allowed = 0;
    double share = 0;
    form_residual(share, allowed);
    for (int pass = 0; pass < kMaxRefinements; ++pass) {
      factor->solve(residual_, correction_);
      ++summary_.counters.solves;
      next_.acceleration += correction_;
      next_.a += gain() * correction_;
      next_.q += (beta_prime() * h * h) * correction_;
      next_.v += (gamma_prime() * h) * correction_;
      const double before = left;
      left = form_residual(share, allowed);
      if (left <= allowed * 1e-4 || !(left <= before / 2)) break;
    }
    next_.time = time;
    next_.a_step = h;
    if (left <= allowed) {
      summary_.largest_residual = std::max(summary_.largest_residual, share);
      return true;
    }
    std::ostringstream message;
    message << describe_step(h) << ": the residual is " << share << " of the terms of the equation";
    return fail(Status::not_converged, message.str());
  }

  /// residual_ = f - M A - C v - K q of next_; its largest entry, what is allowed, and the share of
  /// the sum of the terms.
  double form_residual(double& share, double& allowed) {
    next_.MA.noalias() = matrices_.M() * next_.acceleration;
    if (matrices_.norm_C() > 0) {
      next_.Cv.noalias() = matrices_.C() * next_.v;
    } else {
      next_.Cv.setZero();
    }
    next_.Kq.noalias() = matrices_.K() * next_.q;
    residual_ = next_.f - next_.MA - next_.Cv - next_.Kq;
    const double left = infinity_norm(residual_);
    const double terms = infinity_norm(next_.MA) + infinity_norm(next_.Cv) +
                         infinity_norm(next_.Kq) + infinity_norm(next_.f);
    const double products = matrices_.norm_M() * infinity_norm(next_.acceleration) +
                            matrices_.norm_C() * infinity_norm(next_.v) +
                            matrices_.norm_K() * infinity_norm(next_.q);
    allowed = kResidual * terms + 16 * kEps * products +
              kUnderflow * (matrices_.norm_M() + matrices_.norm_C() + matrices_.norm_K());
    share = terms > 0 ? left / terms : left;
    return left;
  }

  /// Estimated local error over its allowance (Zienkiewicz & Xie 1991, with a alpha_m - alpha_f
  /// steps late): q_1 - q(t_1) = h^2 (beta + (alpha_m - alpha_f) / 2 - 1/6) (a_1 - a_0). Where that
  /// vanishes the error of v remains, hence the 1/12.
  double error_ratio(double h) {
    if (!options_.adaptive) return 0;
    const double factor = std::max(
        1.0 / 12, std::abs(scheme_.beta + (scheme_.alpha_m - scheme_.alpha_f) / 2 - 1.0 / 6));
    correction_ = next_.a - now_.a;
    residual_.noalias() = matrices_.M() * correction_;
    error_ = factor * h * h * std::sqrt(std::max(0.0, correction_.dot(residual_)));
    residual_.noalias() = matrices_.M() * next_.q;
    const double size = std::max(largest_, std::sqrt(std::max(0.0, next_.q.dot(residual_))));
    const double budget = options_.adaptive->relative * size + options_.adaptive->absolute;
    const double allowed = budget * h / (options_.end - options_.start);
    if (error_ <= allowed) largest_ = size;
    return error_ == 0 ? 0 : error_ / allowed;
  }

  /// The equation itself is looked at where a sample is, and a hundred times in between.
  void add_evidence(double h, double load_time) {
    evidence_.add_energy(now_, next_, h);
    if (!output_.covers(next_.time) && next_.time < next_look_) return;
    next_look_ = next_.time + (options_.end - options_.start) / 100;
    evidence_.add_relations(now_, next_, h);
    evidence_.add_equilibrium(next_.time, load_time, next_.q, next_.v, next_.acceleration, h);
  }

  void tell_working_energy(double load_time) {
    next_.working = equation_.working_motion(load_time, next_.q, next_.v);
    const WorkingMotion& from = now_.working;
    const WorkingMotion& to = next_.working;
    const VectorXd way = to.u - from.u;
    next_.told = {.kinetic = to.kinetic,
                  .strain = to.strain,
                  .work = now_.told.work + 0.5 * way.dot(from.load + to.load),
                  .dissipated = now_.told.dissipated + 0.5 * way.dot(from.drag + to.drag)};
  }

  void accept(double h, double load_time) {
    MotionEnergy& energy = next_.energy;
    energy = now_.energy;
    correction_ = next_.q - now_.q;
    energy.work += 0.5 * (correction_.dot(now_.f) + correction_.dot(next_.f));
    energy.dissipated += 0.5 * (correction_.dot(now_.Cv) + correction_.dot(next_.Cv));
    next_.Mv.noalias() = matrices_.M() * next_.v;
    energy.kinetic = 0.5 * next_.v.dot(next_.Mv);
    energy.strain = 0.5 * next_.q.dot(next_.Kq);
    next_.told = energy;
    if (equation_.working_motion) tell_working_energy(load_time);
    add_evidence(h, load_time);
    ++summary_.accepted;
    summary_.smallest_step = summary_.accepted == 1 ? h : std::min(summary_.smallest_step, h);
    summary_.largest_step = std::max(summary_.largest_step, h);
    if (massless_balance_ && output_.covers(next_.time)) {
      shown_[0] = now_;
      shown_[1] = next_;
      const VectorXd rate = (next_.f - now_.f) / h;
      for (TransientState& state : shown_) massless_.follow(state, rate);
      output_.step(shown_[0], shown_[1], h);
    } else {
      output_.step(now_, next_, h);
    }
    std::swap(now_, next_);
  }

  const EquationOfMotion& equation_;
  const TransientOptions& options_;
  TimeScheme scheme_;
  EquationMatrices matrices_;
  SparseMatrix S_;  // of a step
  TransientState now_, next_;
  VectorXd residual_, correction_;  // work
  std::unique_ptr<SparseLdlt> mass_factor_;
  SparseLdlt* start_factor_ = nullptr;  // of M, or of the first step where M is singular
  bool mass_is_factored_ = false, mass_is_singular_ = false;
  MasslessCoordinates massless_;
  bool massless_balance_ = false;  // they follow the others, as the states that are shown have it
  std::array<TransientState, 2> shown_{TransientState(0), TransientState(0)};
  std::vector<std::unique_ptr<SparseLdlt>> factors_;  // of steps factors_step_ / 2^index
  double factors_step_ = 0;
  int level_ = 0;
  double error_ = 0, largest_ = 0;
  MotionEvidence evidence_;
  double next_look_ = -std::numeric_limits<double>::infinity();
  SampleOutput output_;
  TransientSummary summary_;
};

}  // namespace

TransientSummary solve_transient(const EquationOfMotion& equation, const TransientOptions& options,
                                 const MotionObserver& observe) {
  check(equation, options);
  return TransientIntegrator(equation, options, observe).run();
}

}  // namespace trammel::solver
