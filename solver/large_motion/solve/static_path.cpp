#include "solver/large_motion/solve/static_path.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace trammel::large {

namespace {

/// A direction in (q, lambda, load), of unit length in the path's metric.
struct Direction {
  VectorXd step;  ///< (dq, dlambda)
  double load = 0;
};

class Follower {
 public:
  Follower(const LargeSystem& system, const StaticPathOptions& options)
      : system_(system), options_(options), equilibrium_(system, options.newton) {}

  StaticPath run() {
    if (start() && !points_done()) {
      while (next()) {
      }
    }
    path_.counters.factorizations = equilibrium_.matrix().factorizations();
    path_.counters.solves = equilibrium_.matrix().solves();
    return std::move(path_);
  }

 private:
  bool start() {
    PathPoint point;
    point.state = system_.rest();
    point.newton = equilibrium_.solve(point.state, 0);
    if (!point.newton.outcome.solved()) return stop(point.newton.outcome);
    if (!equilibrium_.factor(point.state))
      return stop({Status::singular, "the tangent is singular"});
    VectorXd shape;
    const double soft = equilibrium_.softest(shape);
    equilibrium_.load_direction(point.state, direction_.step);
    const double response = equilibrium_.size(direction_.step.head(system_.coordinates()));
    // A free motion leaves a pivot of pure round-off: a response beyond every scale.
    if (!std::isfinite(soft) || !std::isfinite(response) || response > 1e11) {
      return stop({Status::singular, "free motion: " + describe_motion(system_, shape)});
    }
    weight_ = 1 / std::pow(std::max(response, 1e-6), 2);
    direction_.load = 1;
    normalize(direction_);
    point.unstable = equilibrium_.matrix().negative_pivots();
    arc_ = options_.first_step / direction_.load;
    path_.points.push_back(std::move(point));
    return true;
  }

  bool points_done() const { return system_.coordinates() == 0; }

  bool stop(Outcome outcome) {
    path_.outcome = std::move(outcome);
    return false;
  }

  double square(const VectorXd& step) const {
    const double length = equilibrium_.size(step.head(system_.coordinates()));
    return weight_ * length * length;
  }

  double dot(const Direction& a, const VectorXd& step, double load) const {
    const Index n = system_.coordinates();
    const double count = static_cast<double>(n);
    return weight_ / count *
               a.step.head(n)
                   .cwiseQuotient(system_.scale())
                   .dot(step.head(n).cwiseQuotient(system_.scale())) +
           a.load * load;
  }

  void normalize(Direction& d) const {
    const double length = std::sqrt(square(d.step) + d.load * d.load);
    d.step /= length;
    d.load /= length;
  }

  /// Tangent of the path with the matrix factored last, along `along`.
  Direction tangent(const State& state, const Direction& along) {
    Direction d;
    equilibrium_.load_direction(state, d.step);
    d.load = 1;
    normalize(d);
    if (dot(along, d.step, d.load) < 0) {
      d.step = -d.step;
      d.load = -d.load;
    }
    return d;
  }

  /// Newton on the plane normal to the direction at distance `arc`.
  bool corrector(const State& from, const Direction& d, double arc, PathPoint& point) {
    State& state = point.state;
    state = from;
    set_load(state, from.load + arc * d.load);
    advance(state, d.step, arc);
    point.newton = {};
    double off = 0;
    for (int i = 0; i < options_.newton.iterations; ++i) {
      if (!equilibrium_.factor(state)) return false;
      equilibrium_.correction(state, residual_step_, point.newton);
      equilibrium_.load_direction(state, load_step_);
      if (!residual_step_.allFinite() || !load_step_.allFinite()) return false;
      const double along = dot(d, load_step_, 1);
      const double change = along == 0 ? 0.0 : -dot(d, residual_step_, 0) / along;
      residual_step_ += change * load_step_;
      advance(state, residual_step_);
      set_load(state, state.load + change);
      const double moved = equilibrium_.size(residual_step_.head(system_.coordinates()));
      point.newton.correction.back() = moved;
      off += std::sqrt(square(residual_step_) + change * change);
      if (!(off < 0.5 * std::abs(arc))) return false;
      if (equilibrium_.settled(point.newton.correction, equilibrium_.size(state.q))) return true;
    }
    return false;
  }

  static void set_load(State& state, double load) { state.t = state.load = state.gravity = load; }

  bool next() {
    const State from = path_.points.back().state;
    const Index was_unstable = path_.points.back().unstable;
    if (static_cast<int>(counted_) >= options_.points) return give_up("too many points");
    PathPoint point;
    for (int cut = 0;; ++cut) {
      if (cut == 40) return give_up("no step is small enough");
      // A step over the target would leave it behind for good: it ends there, or is cut.
      const bool reached = crosses_target(from) ? finish(from, point)
                                                : corrector(from, direction_, arc_, point) &&
                                                      !passed_target(from, point.state) &&
                                                      equilibrium_.factor(point.state);
      if (reached) break;
      arc_ /= 2;
    }
    ++counted_;
    point.unstable = equilibrium_.matrix().negative_pivots();
    const bool done = point.state.load == options_.target;
    Direction ahead = tangent(point.state, direction_);
    const bool switched = notice(from, was_unstable, point, ahead, done);
    if (!switched) {
      const double iterations = static_cast<double>(point.newton.correction.size());
      arc_ *= std::clamp(std::sqrt(5 / iterations), 0.5, 2.0);
      direction_ = std::move(ahead);
      keep(std::move(point));
    }
    return switched || !done;
  }

  void keep(PathPoint point) {
    ++path_.counters.steps;
    if (!options_.keep_points) path_.points.clear();
    path_.points.push_back(std::move(point));
  }

  bool crosses_target(const State& from) const {
    const double ahead = from.load + arc_ * direction_.load;
    return (from.load - options_.target) * (ahead - options_.target) <= 0 && direction_.load != 0;
  }

  bool passed_target(const State& from, const State& to) const {
    return (from.load - options_.target) * (to.load - options_.target) < 0;
  }

  /// The last step ends on the target itself.
  bool finish(const State& from, PathPoint& point) {
    const double arc = (options_.target - from.load) / direction_.load;
    point.state = from;
    advance(point.state, direction_.step, arc);
    const State guess = point.state;
    point.newton = equilibrium_.solve(point.state, options_.target);
    if (!point.newton.outcome.solved()) return false;
    const VectorXd off = point.state.q - guess.q;
    return std::sqrt(weight_) * equilibrium_.size(off) < 0.5 * std::abs(arc) &&
           equilibrium_.factor(point.state);
  }

  /// Records what lies between two points. @return true: the path goes on along another branch.
  bool notice(const State& from, Index was_unstable, const PathPoint& point, const Direction& ahead,
              bool done) {
    const bool turned = ahead.load * direction_.load < 0;
    const bool changed = was_unstable >= 0 && point.unstable != was_unstable;
    if (!turned && !changed) return false;
    PathEvent event;
    event.kind = turned ? PathEvent::Kind::limit_point : PathEvent::Kind::bifurcation;
    PathPoint critical = point;
    locate(from, was_unstable, turned, point, critical);
    event.load = critical.state.load;
    if (!equilibrium_.factor(critical.state)) return false;
    equilibrium_.softest(event.shape);
    path_.events.push_back(event);
    const bool leave = !turned && options_.switch_branch && !switched_;
    if (leave) leave_branch(critical, event.shape);
    if (!leave && done && !equilibrium_.factor(point.state)) return false;
    return leave;
  }

  /// Illinois' method along the arc on what changes sign: dload/darc at a limit point, the softest
  /// eigenvalue at a bifurcation.
  void locate(const State& from, Index was_unstable, bool turned, const PathPoint& to,
              PathPoint& critical) {
    const Direction d = direction_;
    const auto indicator = [&](const State& state) {
      if (turned) return tangent(state, d).load;
      VectorXd shape;
      const double soft = equilibrium_.softest(shape);
      return equilibrium_.matrix().negative_pivots() == was_unstable ? soft : -soft;
    };
    const VectorXd secant = [&] {
      VectorXd s(to.state.q.size() + to.state.lambda.size());
      s << to.state.q - from.q, to.state.lambda - from.lambda;
      return s;
    }();
    double left = 0, right = dot(d, secant, to.state.load - from.load);
    if (!equilibrium_.factor(from)) return;
    double f_left = indicator(from);
    if (!equilibrium_.factor(to.state)) return;
    double f_right = indicator(to.state);
    const double whole = right;
    for (int i = 0; i < 60 && std::abs(right - left) > 1e-12 * std::abs(whole); ++i) {
      if (f_left * f_right > 0) return;
      double middle = left - f_left * (right - left) / (f_right - f_left);
      PathPoint trial;
      if (!corrector(from, d, middle, trial) || !equilibrium_.factor(trial.state)) return;
      const double f = indicator(trial.state);
      const double before = critical.state.load;
      critical = trial;
      if (f == 0 || std::abs(critical.state.load - before) < 1e-13 * std::abs(before)) return;
      if (f * f_left > 0) {
        left = middle;
        f_left = f;
        f_right /= last_side_ < 0 ? 2 : 1;
        last_side_ = -1;
      } else {
        right = middle;
        f_right = f;
        f_left /= last_side_ > 0 ? 2 : 1;
        last_side_ = 1;
      }
    }
  }

  void leave_branch(const PathPoint& critical, const VectorXd& shape) {
    switched_ = true;
    const Index n = system_.coordinates();
    direction_.step.setZero(n + system_.constraints());
    direction_.step.head(n) = shape;
    direction_.load = 0;
    normalize(direction_);
    // The buckling shape's first noticeable amplitude, whatever the response before it was.
    arc_ = 1e-3 * std::sqrt(weight_);
    keep(critical);
    path_.points.back().unstable = -1;
  }

  bool give_up(const std::string& why) {
    const PathPoint& last = path_.points.back();
    std::ostringstream words;
    words << why << " after point " << counted_ << " at load factor " << last.state.load
          << ", arc step " << arc_ << ", residual "
          << (last.newton.residual.empty() ? 0.0 : last.newton.residual.back()) << " N m";
    return stop({Status::not_converged, words.str()});
  }

  const LargeSystem& system_;
  const StaticPathOptions& options_;
  Equilibrium equilibrium_;
  StaticPath path_;
  Direction direction_;
  double weight_ = 1;  ///< of the displacements beside the load factor
  double arc_ = 0;
  int last_side_ = 0;
  std::size_t counted_ = 0;
  bool switched_ = false;
  VectorXd residual_step_, load_step_;
};

}  // namespace

StaticPath follow_static_path(const LargeSystem& system, const StaticPathOptions& options) {
  return Follower(system, options).run();
}

}  // namespace trammel::large
