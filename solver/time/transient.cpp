#include "solver/time/transient.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <sstream>
#include <utility>

#include "solver/linalg/sparse_ldlt.h"
#include "solver/model/numbers.h"

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
/// Below this ratio of pivot to diagonal a mass matrix counts as singular.
constexpr double kSingularMass = 1e-13;

double infinity_norm(const VectorXd& x) {
  return x.size() ? x.lpNorm<Eigen::Infinity>() : 0;
}

/// Largest column sum of magnitudes.
double matrix_norm(const SparseMatrix& A) {
  double norm = 0;
  for (Index column = 0; column < A.outerSize(); ++column) {
    double sum = 0;
    for (SparseMatrix::InnerIterator it(A, column); it; ++it) sum += std::abs(it.value());
    norm = std::max(norm, sum);
  }
  return norm;
}

bool same_pattern(const SparseMatrix& A, const SparseMatrix& B) {
  return A.isCompressed() && B.isCompressed() && A.nonZeros() == B.nonZeros() &&
         std::equal(A.outerIndexPtr(), A.outerIndexPtr() + A.cols() + 1, B.outerIndexPtr()) &&
         std::equal(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros(), B.innerIndexPtr());
}

void check(const EquationOfMotion& e, const TransientOptions& o) {
  const Index n = e.M.rows();
  const auto fits = [n](const SparseMatrix& A) { return A.rows() == n && A.cols() == n; };
  if (!fits(e.M) || !fits(e.K) || !(e.C.size() == 0 || fits(e.C))) {
    throw ModelError("M, C and K of an equation of motion are square and of one size");
  }
  if (e.update && !(same_pattern(e.M, e.K) && (e.C.size() == 0 || same_pattern(e.M, e.C)))) {
    throw ModelError("matrices that change with time share one pattern");
  }
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

struct State {
  double time = 0;
  VectorXd q, v;
  VectorXd a;             ///< the algorithm's acceleration (time_scheme.h) ...
  double a_step = 0;      ///< ... and the step it belongs to
  VectorXd acceleration;  ///< A, in equilibrium
  VectorXd f, Cv;
  MotionEnergy energy;

  explicit State(Index n)
      : q(VectorXd::Zero(n)),
        v(VectorXd::Zero(n)),
        a(VectorXd::Zero(n)),
        acceleration(VectorXd::Zero(n)),
        f(VectorXd::Zero(n)),
        Cv(VectorXd::Zero(n)) {}
};

class Integrator {
 public:
  Integrator(const EquationOfMotion& equation, const TransientOptions& options,
             const MotionObserver& observe)
      : equation_(equation),
        options_(options),
        observe_(observe),
        scheme_(options.scheme),
        M_(equation.M),
        C_(equation.C),
        K_(equation.K),
        now_(equation.M.rows()),
        next_(equation.M.rows()) {
    const Index n = M_.rows();
    if (C_.size() == 0) C_.resize(n, n);
    if (!equation.update) {
      SparseMatrix pattern = M_ + C_ + K_;
      pattern += SparseMatrix(pattern.transpose());
      std::fill(pattern.valuePtr(), pattern.valuePtr() + pattern.nonZeros(), 0.0);
      for (SparseMatrix* A : {&M_, &C_, &K_}) {
        *A = SparseMatrix(*A + pattern);
        A->makeCompressed();
      }
    }
    if (equation.update && equation.C.size() == 0) {
      C_ = M_;
      C_.coeffs().setZero();
    }
    S_ = M_;
    for (VectorXd* x : {&MA_, &Mv_, &Kq_, &residual_, &correction_, &q_, &v_, &a_}) x->setZero(n);
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

  void load(double time, VectorXd& f) const {
    if (equation_.load) {
      equation_.load(time, f);
    } else {
      f.setZero();
    }
  }

  void update_matrices(double time) {
    if (equation_.update) {
      equation_.update(time, M_, C_, K_);
    } else if (norm_M_ > 0) {
      return;
    }
    norm_M_ = matrix_norm(M_);
    norm_C_ = matrix_norm(C_);
    norm_K_ = matrix_norm(K_);
  }

  // ---- start ---------------------------------------------------------------------------------

  bool start() {
    now_.time = options_.start;
    if (options_.q0.size()) now_.q = options_.q0;
    if (options_.v0.size()) now_.v = options_.v0;
    if (options_.quasi_static_start && !start_quasi_static()) return false;
    update_matrices(now_.time);
    if (!options_.adaptive && !check_stability()) return false;
    Mv_.noalias() = M_ * now_.v;
    Kq_.noalias() = K_ * now_.q;
    now_.energy.kinetic = 0.5 * now_.v.dot(Mv_);
    now_.energy.strain = 0.5 * now_.q.dot(Kq_);
    return true;
  }

  /// K q = f now and at four times after it: the velocity by the one-sided difference of order 4.
  /// Then K q = f - C v: otherwise the drag of that velocity would set in at once, and shake what
  /// is stiff.
  bool start_quasi_static() {
    constexpr std::array<double, 5> kSlope = {-25.0 / 12, 4, -3, 4.0 / 3, -0.25};
    const double gap = std::min(options_.step, options_.end - options_.start) / 4;
    SparseLdlt factor(SparseLdlt::Triangle::mean);
    now_.v.setZero();
    for (int i = 4; i >= 0; --i) {
      const double time = options_.start + i * gap;
      update_matrices(time);
      if (i == 4 || equation_.update) {
        ++summary_.counters.factorizations;
        if (!factor.factorize(K_) || factor.pivot_ratio() < kSingularMass) {
          return fail(Status::singular,
                      "the stiffness is singular: there is no quasi-static start");
        }
      }
      load(time, next_.f);
      solve_statically(factor, next_.f, next_.q);
      now_.v += (kSlope[static_cast<std::size_t>(i)] / gap) * next_.q;
    }
    next_.f.noalias() -= C_ * now_.v;
    solve_statically(factor, next_.f, now_.q);
    return true;
  }

  /// K q = f; the skew part of K, if any, by refinement.
  void solve_statically(SparseLdlt& factor, const VectorXd& f, VectorXd& q) {
    q.setZero();
    for (int pass = 0; pass < 4; ++pass) {
      residual_ = f;
      residual_.noalias() -= K_ * q;
      factor.solve(residual_, correction_);
      q += correction_;
      ++summary_.counters.solves;
    }
  }

  /// Refuses a step at which the fastest motion grows. The power iteration comes from below, so
  /// that it refuses no stable step.
  bool check_stability() {
    const double limit = stability_limit(scheme_);
    if (!std::isfinite(limit) || M_.rows() == 0) return true;
    SparseLdlt factor(SparseLdlt::Triangle::mean);
    ++summary_.counters.factorizations;
    if (!factor.factorize(M_) || factor.pivot_ratio() < kSingularMass) {
      return fail(Status::singular,
                  "the mass is singular: a conditionally stable scheme has no stable step");
    }
    VectorXd x(M_.rows());
    for (Index i = 0; i < x.size(); ++i) x[i] = std::sin(1.0 + 3.7 * static_cast<double>(i));
    double squared = 0;
    for (int i = 0; i < 60; ++i) {
      x /= std::sqrt(x.dot(M_ * x));
      Kq_.noalias() = K_ * x;
      squared = std::max(squared, x.dot(Kq_));
      factor.solve(Kq_, x);
      ++summary_.counters.solves;
      if (!(x.squaredNorm() > 0)) break;
    }
    const double phase = std::sqrt(squared) * options_.step;
    if (phase <= limit) return true;
    std::ostringstream message;
    message << "the step h = " << options_.step
            << " s is unstable: the fastest motion has w h = " << phase << ", the scheme bears "
            << limit << "; take h below " << options_.step * limit / phase << " s";
    return fail(Status::not_converged, message.str());
  }

  // ---- segments and steps ----------------------------------------------------------------------

  /// Accelerations in equilibrium at the start of a segment. Coordinates without mass have none of
  /// their own: there the acceleration is the one that the first step of length h would find.
  bool begin_segment(double h, int level) {
    update_matrices(now_.time);
    load(now_.time, now_.f);
    now_.Cv.noalias() = C_ * now_.v;
    residual_ = now_.f - now_.Cv;
    residual_.noalias() -= K_ * now_.q;
    if (!mass_factor_) mass_factor_ = std::make_unique<SparseLdlt>(SparseLdlt::Triangle::mean);
    if (equation_.update || !mass_is_factored_) {
      ++summary_.counters.factorizations;
      mass_is_singular_ =
          !mass_factor_->factorize(M_) || mass_factor_->pivot_ratio() < kSingularMass;
      mass_is_factored_ = true;
    }
    start_factor_ = mass_factor_.get();
    if (mass_is_singular_) {
      start_factor_ = step_factor(h, level);
      if (!start_factor_)
        return fail(Status::singular, "M + C h + K h^2 is singular at " + describe_step(h));
    }
    start_factor_->solve(residual_, now_.acceleration);
    ++summary_.counters.solves;
    now_.a = now_.acceleration;
    now_.a_step = h;
    return true;
  }

  /// What the load of the segment can move: the size of the motion, before there is any, to which
  /// the error is compared. x = M^-1 f moves as an oscillator with its own Rayleigh quotient, a
  /// free body as far as the time lasts.
  void estimate_size_from_load(double begin, double end) {
    constexpr int kPoints = 8;
    const double time = options_.end - options_.start;
    for (int i = 0; i <= kPoints; ++i) {
      const double t = i == kPoints ? std::nextafter(end, begin)
                                    : begin + (end - begin) * static_cast<double>(i) / kPoints;
      load(t, next_.f);
      start_factor_->solve(next_.f, correction_);
      ++summary_.counters.solves;
      MA_.noalias() = M_ * correction_;
      Kq_.noalias() = K_ * correction_;
      const double squared = correction_.dot(MA_);
      if (!(squared > 0)) continue;
      const double stiffness = std::max(correction_.dot(Kq_) / squared, 1 / (time * time));
      largest_ = std::max(largest_, std::sqrt(squared) / stiffness);
    }
  }

  bool integrate_segment(double begin, double end) {
    const double span = end - begin;
    const double step_count = std::max(1.0, std::ceil(span / options_.step * (1 - 1e-9)));
    if (step_count > 1e12) return fail(Status::not_converged, "more than 1e12 steps");
    if (factors_step_ == 0 || std::abs(span / step_count - factors_step_) > 1e-12 * factors_step_) {
      factors_.clear();
      factors_step_ = span / step_count;
    }
    auto count = static_cast<std::int64_t>(step_count);  // of steps of the present level
    std::int64_t done = 0;
    int level = options_.adaptive ? std::min(level_, options_.adaptive->finest_level) : 0;
    count <<= level;
    if (!begin_segment(std::ldexp(factors_step_, -level), level)) return false;
    if (!begun_) observe_start();
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
        if (++level > options_.adaptive->finest_level) {
          std::ostringstream message;
          message << describe_step(h) << ": the estimated error is " << ratio
                  << " times what is allowed, and the step is the smallest";
          return fail(Status::not_converged, message.str());
        }
        count *= 2;
        done *= 2;
        continue;
      }
      accept(h);
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
    if (equation_.update) {
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
    S_.coeffs() = M_.coeffs() + c * C_.coeffs() + k * K_.coeffs();
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
    update_matrices(time);
    load(load_time, next_.f);
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
    MA_.noalias() = M_ * next_.acceleration;
    next_.Cv.noalias() = C_ * next_.v;
    Kq_.noalias() = K_ * next_.q;
    residual_ = next_.f - MA_ - next_.Cv - Kq_;
    const double left = infinity_norm(residual_);
    const double terms =
        infinity_norm(MA_) + infinity_norm(next_.Cv) + infinity_norm(Kq_) + infinity_norm(next_.f);
    const double products = norm_M_ * infinity_norm(next_.acceleration) +
                            norm_C_ * infinity_norm(next_.v) + norm_K_ * infinity_norm(next_.q);
    allowed = kResidual * terms + 16 * kEps * products + kUnderflow * (norm_M_ + norm_C_ + norm_K_);
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
    residual_.noalias() = M_ * correction_;
    error_ = factor * h * h * std::sqrt(std::max(0.0, correction_.dot(residual_)));
    residual_.noalias() = M_ * next_.q;
    const double size = std::max(largest_, std::sqrt(std::max(0.0, next_.q.dot(residual_))));
    const double budget = options_.adaptive->relative * size + options_.adaptive->absolute;
    const double allowed = budget * h / (options_.end - options_.start);
    if (error_ <= allowed) largest_ = size;
    return error_ == 0 ? 0 : error_ / allowed;
  }

  void accept(double h) {
    MotionEnergy& energy = next_.energy;
    energy = now_.energy;
    correction_ = next_.q - now_.q;
    energy.work += 0.5 * (correction_.dot(now_.f) + correction_.dot(next_.f));
    energy.dissipated += 0.5 * (correction_.dot(now_.Cv) + correction_.dot(next_.Cv));
    Mv_.noalias() = M_ * next_.v;
    energy.kinetic = 0.5 * next_.v.dot(Mv_);
    energy.strain = 0.5 * next_.q.dot(Kq_);
    ++summary_.accepted;
    summary_.smallest_step = summary_.accepted == 1 ? h : std::min(summary_.smallest_step, h);
    summary_.largest_step = std::max(summary_.largest_step, h);
    if (options_.adaptive) summary_.estimated_error += error_;
    observe_step(h);
    std::swap(now_, next_);
  }

  // ---- samples
  // -----------------------------------------------------------------------------------

  void observe_start() {
    begun_ = true;
    const auto& times = options_.sample_times;
    if (!times.empty() && times.front() != now_.time) return;
    do {
      hand_over(now_.time, now_.q, now_.v, now_.acceleration, now_.energy);
    } while (next_sample_ < times.size() && times[next_sample_] == now_.time);
  }

  void hand_over(double time, const VectorXd& q, const VectorXd& v, const VectorXd& a,
                 const MotionEnergy& energy) {
    observe_({static_cast<Index>(next_sample_), time, q, v, a, energy});
    ++next_sample_;
  }

  void observe_step(double h) {
    const auto& times = options_.sample_times;
    if (times.empty()) {
      hand_over(next_.time, next_.q, next_.v, next_.acceleration, next_.energy);
      return;
    }
    while (next_sample_ < times.size() && times[next_sample_] <= next_.time) {
      const double time = times[next_sample_];
      const double s = (time - now_.time) / h;
      const auto mix = [s](double x, double y) { return (1 - s) * x + s * y; };
      hermite(s, h, now_.q, now_.v, next_.q, next_.v, q_);
      hermite(s, h, now_.v, now_.acceleration, next_.v, next_.acceleration, v_);
      a_ = (1 - s) * now_.acceleration + s * next_.acceleration;
      const MotionEnergy& e0 = now_.energy;
      const MotionEnergy& e1 = next_.energy;
      hand_over(time, q_, v_, a_,
                {.kinetic = mix(e0.kinetic, e1.kinetic),
                 .strain = mix(e0.strain, e1.strain),
                 .work = mix(e0.work, e1.work),
                 .dissipated = mix(e0.dissipated, e1.dissipated)});
    }
  }

  static void hermite(double s, double h, const VectorXd& x0, const VectorXd& d0,
                      const VectorXd& x1, const VectorXd& d1, VectorXd& x) {
    const double r = 1 - s;
    x = (r * r * (1 + 2 * s)) * x0 + (s * s * (1 + 2 * r)) * x1 + (h * s * r * r) * d0 -
        (h * s * s * r) * d1;
  }

  const EquationOfMotion& equation_;
  const TransientOptions& options_;
  const MotionObserver& observe_;
  TimeScheme scheme_;
  SparseMatrix M_, C_, K_, S_;  // one pattern
  double norm_M_ = 0, norm_C_ = 0, norm_K_ = 0;
  State now_, next_;
  VectorXd MA_, Mv_, Kq_, residual_, correction_;  // work
  VectorXd q_, v_, a_;                             // the sample
  std::unique_ptr<SparseLdlt> mass_factor_;
  SparseLdlt* start_factor_ = nullptr;  // of M, or of the first step where M is singular
  bool mass_is_factored_ = false, mass_is_singular_ = false;
  std::vector<std::unique_ptr<SparseLdlt>> factors_;  // of steps factors_step_ / 2^index
  double factors_step_ = 0;
  int level_ = 0;
  double error_ = 0, largest_ = 0;
  bool begun_ = false;
  std::size_t next_sample_ = 0;
  TransientSummary summary_;
};

}  // namespace

TransientSummary solve_transient(const EquationOfMotion& equation, const TransientOptions& options,
                                 const MotionObserver& observe) {
  check(equation, options);
  return Integrator(equation, options, observe).run();
}

TransientHistory solve_transient(const EquationOfMotion& equation,
                                 const TransientOptions& options) {
  TransientHistory history;
  const Index n = equation.M.rows();
  Index capacity = static_cast<Index>(options.sample_times.size());
  const auto resize = [&history, n](Index columns) {
    for (Eigen::MatrixXd* X : {&history.q, &history.v, &history.a}) {
      X->conservativeResize(n, columns);
    }
  };
  resize(capacity);
  history.summary = solve_transient(equation, options, [&](const MotionSample& sample) {
    if (sample.index >= capacity) {
      capacity = std::max<Index>(64, 2 * capacity);
      resize(capacity);
    }
    history.q.col(sample.index) = sample.q;
    history.v.col(sample.index) = sample.v;
    history.a.col(sample.index) = sample.a;
    history.time.push_back(sample.time);
    history.energy.push_back(sample.energy);
  });
  resize(static_cast<Index>(history.time.size()));
  return history;
}

Peak peak(const std::vector<double>& time, const Eigen::VectorXd& value) {
  if (value.size() == 0) return {};
  Index k = 0;
  value.cwiseAbs().maxCoeff(&k);
  const auto at = [&time](Index i) { return time[static_cast<std::size_t>(i)]; };
  Peak result{at(k), value[k]};
  if (k == 0 || k + 1 == value.size()) return result;
  const double left = at(k) - at(k - 1);
  const double right = at(k + 1) - at(k);
  const double slope_left = (value[k] - value[k - 1]) / left;
  const double slope_right = (value[k + 1] - value[k]) / right;
  const double curvature = 2 * (slope_right - slope_left) / (left + right);
  const double slope = (slope_left * right + slope_right * left) / (left + right);
  if (curvature == 0) return result;
  const double shift = std::clamp(-slope / curvature, -left, right);
  result.time += shift;
  result.value += shift * (slope + 0.5 * curvature * shift);
  return result;
}

}  // namespace trammel::solver
