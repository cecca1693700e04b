#include "solver/motion/transient.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <sstream>
#include <utility>

#include "solver/linalg/factorization.h"
#include "solver/model/model.h"
#include "solver/model/numbers.h"
#include "solver/motion/motion_evidence.h"
#include "solver/motion/transient_start.h"

namespace trammel::solver {
namespace {

using Eigen::VectorXd;

/// Limit of the residual of the equation of motion at the end of a step, relative to the sum of the
/// norms of its terms. Round-off errors of the products of M, C and K with the motion are added to
/// the limit.
constexpr double kResidual = 1e-10;
constexpr int kMaxRefinements = 40;

double infinity_norm(const VectorXd& x) {
  return x.size() ? x.lpNorm<Eigen::Infinity>() : 0;
}

void check(const EquationOfMotion& e, const TransientOptions& o) {
  const Index n = e.M.rows();
  const auto missing_or_sized = [n](const VectorXd& x) { return x.size() == 0 || x.size() == n; };
  if (!missing_or_sized(o.q0) || !missing_or_sized(o.v0))
    throw ModelError("the initial state must have one entry per row of the equation of motion");
  if (!(std::isfinite(o.start) && std::isfinite(o.end) && o.end > o.start))
    throw ModelError("the end of a motion must be later than its start");
  if (!(std::isfinite(o.step) && o.step > 0)) throw ModelError("the time step must be positive");
  if (!std::is_sorted(o.sample_times.begin(), o.sample_times.end()) ||
      (!o.sample_times.empty() &&
       !(o.sample_times.front() >= o.start && o.sample_times.back() <= o.end))) {
    throw ModelError("sample times must be ascending and lie between start and end of the motion");
  }
  if (o.adaptive && !(o.adaptive->relative >= 0 && o.adaptive->absolute >= 0 &&
                      o.adaptive->relative + o.adaptive->absolute > 0 &&
                      o.adaptive->finest_level >= 0 && o.adaptive->finest_level <= 40)) {
    throw ModelError("error control requires a positive tolerance and 0 to 40 step halvings");
  }
}

/// Evaluates a cubic polynomial at s = 0 ... 1 over a step of length h. x0 and x1 are the values at
/// both ends, d0 and d1 the slopes.
void hermite(double s, double h, const VectorXd& x0, const VectorXd& d0, const VectorXd& x1,
             const VectorXd& d1, VectorXd& x) {
  const double r = 1 - s;
  x = (r * r * (1 + 2 * s)) * x0 + (s * s * (1 + 2 * r)) * x1 + (h * s * r * r) * d0 -
      (h * s * s * r) * d1;
}

/// Passes the samples of each step to the observer.
class SampleOutput {
 public:
  /// Stores references to `times` and `observe`.
  /// @param times  ascending sample times [s]; empty: the ends of all steps.
  /// @param observe  function that receives the samples.
  /// @pre `times` and `observe` must outlive this object.
  SampleOutput(const std::vector<double>& times, const MotionObserver& observe)
      : times_(times), observe_(observe) {}

  void start(const TransientState& state) {
    if (!times_.empty() && times_.front() != state.time) return;
    do {
      emit(state.time, state.q, state.v, state.a, state.shown);
    } while (next_ < times_.size() && times_[next_] == state.time);
  }
  /// Returns true if a step that ends at the time `end` contains a sample.
  [[nodiscard]] bool covers(double end) const {
    return times_.empty() || (next_ < times_.size() && times_[next_] <= end);
  }
  /// Outputs the samples within a step of length h.
  void step(const TransientState& begin, const TransientState& end, double h);

 private:
  void emit(double time, const VectorXd& q, const VectorXd& v, const VectorXd& a,
            const MotionEnergy& energy, bool interpolated = false) {
    observe_({static_cast<Index>(next_), time, q, v, a, energy, interpolated});
    ++next_;
  }

  const std::vector<double>& times_;
  const MotionObserver& observe_;
  std::size_t next_ = 0;
  VectorXd q_, v_, a_;
};

void SampleOutput::step(const TransientState& begin, const TransientState& end, double h) {
  // The time at the end of a step is a sum of step sizes with round-off errors. A sample is treated
  // as the end of the step if its distance from the end is at most this fraction of the step.
  constexpr double kEndOfStep = 1e-6;
  if (times_.empty()) {
    emit(end.time, end.q, end.v, end.a, end.shown);
    return;
  }
  bool inside = false;
  while (next_ < times_.size() && times_[next_] <= end.time) {
    const double time = times_[next_];
    const double s = (time - begin.time) / h;
    inside = s < 1 - kEndOfStep;
    const auto mix = [s](double x, double y) { return (1 - s) * x + s * y; };
    hermite(s, h, begin.q, begin.v, end.q, end.v, q_);
    hermite(s, h, begin.v, begin.a, end.v, end.a, v_);
    a_ = (1 - s) * begin.a + s * end.a;
    const MotionEnergy &e0 = begin.shown, &e1 = end.shown;
    const MotionEnergy energy{.kinetic = mix(e0.kinetic, e1.kinetic),
                              .strain = mix(e0.strain, e1.strain),
                              .work = mix(e0.work, e1.work),
                              .dissipated = mix(e0.dissipated, e1.dissipated)};
    emit(time, q_, v_, a_, energy, inside);
  }
  if (inside) observe_({-1, end.time, end.q, end.v, end.a, end.shown});
}

/// Stepper of the linear equation M q'' + C q' + K q = f. The matrices are constant or known
/// functions of time. Factorizations of constant matrices are stored for each step size.
class LinearStepper final : public Stepper {
 public:
  LinearStepper(const EquationOfMotion& equation, const TransientOptions& options,
                const MotionObserver& observe)
      : equation_(equation),
        options_(options),
        scheme_(options.scheme),
        matrices_(equation),
        S_(matrices_.M()),
        states_{TransientState(equation.M.rows()), TransientState(equation.M.rows())},
        evidence_(equation, options.scheme),
        output_(options.sample_times, observe) {
    for (VectorXd* x : {&residual_, &correction_}) x->setZero(S_.rows());
    now_->time = options.start;
    if (options.q0.size()) now_->q = options.q0;
    if (options.v0.size()) now_->v = options.v0;
  }

  TransientSummary run() {
    TransientSummary summary;
    summary.outcome = start();
    if (summary.outcome.solved())
      summary = integrate(*this, options_, equation_.breakpoints, StepSizes::halved);
    summary.evidence.add(evidence_.result());
    summary.outcome = outcome_by_evidence(summary.outcome, summary.evidence,
                                          {Residual::equation_of_motion, Residual::energy});
    summary.largest_residual = largest_residual_;
    summary.counters += counters_;
    return summary;
  }

  [[nodiscard]] Outcome begin(const Step& first, double stop) override;
  [[nodiscard]] StepReport attempt(const Step& step) override;
  void accept(const Step& step, bool check_motion, Evidence& evidence) override;
  [[nodiscard]] std::string describe(const StepReport& report) const override {
    std::ostringstream text;
    if (report.status == Status::singular) {
      text << "where the matrix M + C h + K h^2 is singular";
    } else if (report.status == Status::not_converged) {
      text << "where the residual is " << report.residual << " times the terms of the equation";
    } else {
      text << "whose estimated error is " << report.error << " times the allowed error";
    }
    return text.str();
  }

 private:
  [[nodiscard]] Outcome start();
  void settle_massless(double h);
  void estimate_size_from_load(double begin, double end);
  [[nodiscard]] SparseLdlt* step_factor(const Step& step);
  void form_residual();
  double judge_residual(StepReport& report, double& allowed) const;
  [[nodiscard]] double error_ratio(double h);
  void update_energies(double load_time);
  /// Returns the time at which the load is evaluated at the end of a step. If the step ends at a
  /// stop, this time is just before the stop, because `EquationOfMotion::load` writes the value
  /// after a jump.
  [[nodiscard]] double load_time(const Step& step) const {
    return step.last ? std::nextafter(step.end, now_->time) : step.end;
  }

  const EquationOfMotion& equation_;
  const TransientOptions& options_;
  TimeScheme scheme_;
  EquationMatrices matrices_;
  // Step matrix M + gamma' h C + beta' h^2 K, with the gains gamma' of velocity and beta' of
  // position (`TimeScheme`).
  SparseMatrix S_;
  std::array<TransientState, 2> states_;
  TransientState *now_ = &states_[0], *next_ = &states_[1];
  // Work vectors.
  VectorXd residual_, correction_;
  std::unique_ptr<SparseLdlt> mass_factor_;
  // Factorization of M, or of the first step matrix if M is singular.
  SparseLdlt* start_factor_ = nullptr;
  bool mass_is_singular_ = false;
  MasslessCoordinates massless_;
  // true: in output states, massless coordinates are in equilibrium.
  bool massless_balance_ = false;
  std::array<TransientState, 2> shown_{TransientState(0), TransientState(0)};
  // Step size and factorization of the step matrix for each level.
  std::vector<std::pair<double, std::unique_ptr<SparseLdlt>>> factors_;
  double largest_ = 0, largest_residual_ = 0;
  MotionEvidence evidence_;
  SampleOutput output_;
  Counters counters_;
};

Outcome LinearStepper::start() {
  if (options_.quasi_static_start) {
    Outcome outcome = start_quasi_statically(matrices_, options_, now_->q, now_->v, counters_);
    if (!outcome.solved()) return outcome;
  }
  matrices_.update(now_->time);
  if (!options_.adaptive) {
    Outcome outcome = check_time_step_stability(matrices_, options_, counters_);
    if (!outcome.solved()) return outcome;
  }
  now_->Mv.noalias() = matrices_.M() * now_->v;
  now_->Kq.noalias() = matrices_.K() * now_->q;
  now_->energy.kinetic = 0.5 * now_->v.dot(now_->Mv);
  now_->energy.strain = 0.5 * now_->q.dot(now_->Kq);
  return {};
}

/// Computes the accelerations after a breakpoint from the equation of motion. This equation does
/// not contain the accelerations of massless coordinates. With constant matrices, massless
/// coordinates follow the other coordinates. Otherwise their acceleration is computed with the
/// matrix of the first step.
Outcome LinearStepper::begin(const Step& first, double stop) {
  const double h = first.size;
  matrices_.update(now_->time);
  matrices_.compute_load(now_->time, now_->f);
  now_->Cv.noalias() = matrices_.C() * now_->v;
  now_->Kq.noalias() = matrices_.K() * now_->q;
  residual_ = now_->f - now_->Cv - now_->Kq;
  const bool is_start = !mass_factor_;
  if (is_start) mass_factor_ = std::make_unique<SparseLdlt>(SparseLdlt::Triangle::mean);
  if (is_start || !matrices_.is_constant()) {
    ++counters_.factorizations;
    mass_is_singular_ = !mass_factor_->factorize(matrices_.M()) ||
                        mass_factor_->smallest_pivot_to_diagonal() < kSingularMass;
  }
  start_factor_ = mass_is_singular_ ? step_factor(first) : mass_factor_.get();
  if (!start_factor_) return {Status::singular, "the matrix M + C h + K h^2 is singular"};
  massless_balance_ =
      mass_is_singular_ && matrices_.is_constant() && massless_.factor(matrices_, h, counters_);
  if (massless_balance_) {
    settle_massless(h);
  } else {
    start_factor_->solve(residual_, now_->a);
    ++counters_.solves;
  }
  if (equation_.working_motion) {
    now_->working = equation_.working_motion(now_->time, now_->q, now_->v);
    now_->shown.kinetic = now_->working.kinetic;
    now_->shown.strain = now_->working.strain;
  } else {
    now_->shown = now_->energy;
  }
  now_->A = now_->a;
  now_->A_step = h;
  now_->Ma.noalias() = matrices_.M() * now_->a;
  evidence_.begin_segment(residual_ - now_->Ma);
  if (!mass_is_singular_)
    evidence_.add_equilibrium(now_->time, now_->time, now_->q, now_->v, now_->a, h);
  if (is_start) output_.start(*now_);
  if (options_.adaptive) estimate_size_from_load(now_->time, stop);
  return {};
}

/// Moves massless coordinates to their new equilibrium after a jump of the load, without delay. The
/// work that is not stored as strain energy is dissipated.
void LinearStepper::settle_massless(double h) {
  correction_ = now_->q;
  matrices_.compute_load(now_->time + h / 2, next_->f);
  massless_.equilibrate(*now_, (next_->f - now_->f) / (h / 2));
  now_->Cv.noalias() = matrices_.C() * now_->v;
  now_->Kq.noalias() = matrices_.K() * now_->q;
  residual_ = now_->f - now_->Cv - now_->Kq;
  const double strain = 0.5 * now_->q.dot(now_->Kq), work = now_->f.dot(now_->q - correction_);
  now_->energy.dissipated += work - (strain - now_->energy.strain);
  now_->energy.work += work;
  now_->energy.strain = strain;
}

/// Estimates the amplitude of the motion from the load of a segment, because the error control
/// requires an amplitude before the motion starts. The shape x = M^-1 f is assumed to move as an
/// oscillator with the frequency of its Rayleigh quotient. For free bodies, the frequency has a
/// lower limit that follows from the total time. The estimate is the static displacement or, in a
/// shorter segment, the distance covered at the speed that the load causes.
void LinearStepper::estimate_size_from_load(double begin, double end) {
  constexpr int kPoints = 8;
  const double time = options_.end - options_.start;
  for (int i = 0; i <= kPoints; ++i) {
    const double t = i == kPoints ? std::nextafter(end, begin)
                                  : begin + (end - begin) * static_cast<double>(i) / kPoints;
    matrices_.compute_load(t, next_->f);
    start_factor_->solve(next_->f, correction_);
    ++counters_.solves;
    next_->Ma.noalias() = matrices_.M() * correction_;
    next_->Kq.noalias() = matrices_.K() * correction_;
    const double squared = correction_.dot(next_->Ma);
    if (!(squared > 0)) continue;
    const double stiffness = std::max(correction_.dot(next_->Kq) / squared, 1 / (time * time));
    const double share = std::min(1.0, (end - begin) * std::sqrt(stiffness));
    largest_ = std::max(largest_, share * std::sqrt(squared) / stiffness);
  }
}

/// Returns the factorization of the step matrix M + gamma' h C + beta' h^2 K, or null if the matrix
/// is singular. gamma' and beta' are the gains of velocity and position (`TimeScheme`), and h is
/// the step size.
SparseLdlt* LinearStepper::step_factor(const Step& step) {
  const auto index = matrices_.is_constant() ? static_cast<std::size_t>(step.level) : 0;
  if (factors_.size() <= index) factors_.resize(index + 1);
  auto& [size, factor] = factors_[index];
  if (factor && matrices_.is_constant() && size == step.size) return factor.get();
  if (!factor) factor = std::make_unique<SparseLdlt>(SparseLdlt::Triangle::mean);
  size = step.size;
  const double c = scheme_.velocity_gain() * step.size;
  const double k = scheme_.position_gain() * step.size * step.size;
  S_.coeffs() = matrices_.M().coeffs() + c * matrices_.C().coeffs() + k * matrices_.K().coeffs();
  ++counters_.factorizations;
  return factor->factorize(S_) ? factor.get() : nullptr;
}

/// Predicts the motion with zero acceleration at the end of the step. Then corrects the motion
/// until the equation of motion is satisfied at the end. Symmetric matrices require a single
/// correction.
StepReport LinearStepper::attempt(const Step& step) {
  const double h = step.size;
  if (now_->A_step != h) rescale_to_new_step(h / now_->A_step, now_->a, now_->A);
  now_->A_step = h;
  matrices_.update(step.end);
  matrices_.compute_load(load_time(step), next_->f);
  SparseLdlt* factor = step_factor(step);
  StepReport report;
  if (!factor) {
    report.status = Status::singular;
    return report;
  }
  next_->a.setZero();
  predict(scheme_, h, *now_, now_->A, *next_, next_->A);
  double left = std::numeric_limits<double>::infinity();
  double allowed = 0;
  form_residual();
  for (int pass = 0; pass < kMaxRefinements; ++pass) {
    factor->solve(residual_, correction_);
    ++counters_.solves;
    correct(scheme_, h, correction_, *next_, next_->A);
    next_->q += (scheme_.position_gain() * h * h) * correction_;
    const double before = left;
    form_residual();
    left = judge_residual(report, allowed);
    if (left <= allowed * 1e-4 || !(left <= before / 2)) break;
  }
  next_->time = step.end;
  next_->A_step = h;
  if (!(left <= allowed)) return report;
  report.status = Status::solved;
  largest_residual_ = std::max(largest_residual_, report.residual);
  if (options_.adaptive) report.error = error_ratio(h);
  return report;
}

/// Computes the residual f - M a - C v - K q at the end of the attempted step.
void LinearStepper::form_residual() {
  next_->Ma.noalias() = matrices_.M() * next_->a;
  if (matrices_.norm_C() > 0) {
    next_->Cv.noalias() = matrices_.C() * next_->v;
  } else {
    next_->Cv.setZero();
  }
  next_->Kq.noalias() = matrices_.K() * next_->q;
  residual_ = next_->f - next_->Ma - next_->Cv - next_->Kq;
}

/// Computes the residual relative to the sum of the norms of its terms, and the allowed residual.
/// Returns the largest magnitude of the residual.
double LinearStepper::judge_residual(StepReport& report, double& allowed) const {
  const double left = infinity_norm(residual_);
  const double terms = infinity_norm(next_->Ma) + infinity_norm(next_->Cv) +
                       infinity_norm(next_->Kq) + infinity_norm(next_->f);
  const double products = matrices_.norm_M() * infinity_norm(next_->a) +
                          matrices_.norm_C() * infinity_norm(next_->v) +
                          matrices_.norm_K() * infinity_norm(next_->q);
  allowed = kResidual * terms + 16 * kEps * products +
            kUnderflow * (matrices_.norm_M() + matrices_.norm_C() + matrices_.norm_K());
  report.residual = terms > 0 ? left / terms : left;
  return left;
}

/// Returns the ratio of the estimated error of a step to the allowed error, in the norm of the
/// kinetic energy.
double LinearStepper::error_ratio(double h) {
  correction_ = next_->A - now_->A;
  residual_.noalias() = matrices_.M() * correction_;
  const double error =
      scheme_.error_constant() * h * h * std::sqrt(std::max(0.0, correction_.dot(residual_)));
  residual_.noalias() = matrices_.M() * next_->q;
  const double size = std::max(largest_, std::sqrt(std::max(0.0, next_->q.dot(residual_))));
  const double budget = options_.adaptive->relative * size + options_.adaptive->absolute;
  const double allowed = budget * h / (options_.end - options_.start);
  if (error <= allowed) largest_ = size;
  return error == 0 ? 0 : error / allowed;
}

void LinearStepper::update_energies(double load_time) {
  MotionEnergy& energy = next_->energy;
  energy = now_->energy;
  correction_ = next_->q - now_->q;
  energy.work += 0.5 * (correction_.dot(now_->f) + correction_.dot(next_->f));
  energy.dissipated += 0.5 * (correction_.dot(now_->Cv) + correction_.dot(next_->Cv));
  next_->Mv.noalias() = matrices_.M() * next_->v;
  energy.kinetic = 0.5 * next_->v.dot(next_->Mv);
  energy.strain = 0.5 * next_->q.dot(next_->Kq);
  next_->shown = energy;
  if (!equation_.working_motion) return;
  next_->working = equation_.working_motion(load_time, next_->q, next_->v);
  const WorkingMotion &from = now_->working, &to = next_->working;
  const VectorXd way = to.u - from.u;
  next_->shown = {.kinetic = to.kinetic,
                  .strain = to.strain,
                  .work = now_->shown.work + 0.5 * way.dot(from.load + to.load),
                  .dissipated = now_->shown.dissipated + 0.5 * way.dot(from.drag + to.drag)};
}

void LinearStepper::accept(const Step& step, bool check_motion, Evidence& /*evidence*/) {
  update_energies(load_time(step));
  evidence_.add_energy_balance(*now_, *next_, step.size);
  if (check_motion || output_.covers(next_->time)) {
    evidence_.add_scheme_residual(*now_, *next_, step.size);
    evidence_.add_equilibrium(next_->time, load_time(step), next_->q, next_->v, next_->a,
                              step.size);
  }
  if (massless_balance_ && output_.covers(next_->time)) {
    shown_[0] = *now_;
    shown_[1] = *next_;
    const VectorXd rate = (next_->f - now_->f) / step.size;
    for (TransientState& state : shown_) massless_.set_rates_from_positions(state, rate);
    output_.step(shown_[0], shown_[1], step.size);
  } else {
    output_.step(*now_, *next_, step.size);
  }
  std::swap(now_, next_);
}

}  // namespace

TransientSummary solve_transient(const EquationOfMotion& equation, const TransientOptions& options,
                                 const MotionObserver& observe) {
  check(equation, options);
  return LinearStepper(equation, options, observe).run();
}

TransientHistory solve_transient(const EquationOfMotion& equation,
                                 const TransientOptions& options) {
  TransientHistory history;
  std::vector<double> q, v, a;
  const auto append = [](const VectorXd& from, std::vector<double>& to) {
    to.insert(to.end(), from.begin(), from.end());
  };
  history.summary = solve_transient(equation, options, [&](const MotionSample& sample) {
    if (sample.index < 0) return;
    append(sample.q, q);
    append(sample.v, v);
    append(sample.a, a);
    history.time.push_back(sample.time);
    history.energy.push_back(sample.energy);
  });
  const auto columns = [&](const std::vector<double>& values) {
    return Eigen::Map<const Eigen::MatrixXd>(values.data(), equation.M.rows(),
                                             std::ssize(history.time));
  };
  history.q = columns(q);
  history.v = columns(v);
  history.a = columns(a);
  return history;
}

Peak peak(const std::vector<double>& time, const VectorXd& value) {
  if (value.size() == 0) return {};
  Index k = 0;
  value.cwiseAbs().maxCoeff(&k);
  const auto at = [&time](Index i) { return time[static_cast<std::size_t>(i)]; };
  Peak result{at(k), value[k]};
  if (k == 0 || k + 1 == value.size()) return result;
  const double slope = (value[k + 1] - value[k - 1]) / 2;
  const double curvature = (value[k + 1] - value[k]) - (value[k] - value[k - 1]);
  if (curvature == 0) return result;
  const double shift = std::clamp(-slope / curvature, -1.0, 1.0);
  result.time += shift * (at(k + 1) - at(k));
  result.value += shift * (slope + 0.5 * curvature * shift);
  return result;
}

}  // namespace trammel::solver
