#include "solver/large/static_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

#include "solver/large/consistent_initialization.h"
#include "solver/large/state_results.h"
#include "solver/model/numbers.h"

namespace trammel::solver::large_motion {

namespace {

/// Least cosine of the angle between the tangents at two adjacent points of a path.
constexpr double kTurn = 0.95;

/// Relative change of the state below which the last factorization of the tangent matrix is used to
/// count unstable directions.
constexpr double kSame = 1e-9;

/// Trial point in the search for a critical point between two points of a path: distance from the
/// first point, indicator f that vanishes at the critical point, number of unstable directions, and
/// state.
struct Trial {
  double arc, f;
  Index unstable;
  State state;
};

/// Bracket of a root between two points, for the Illinois variant of regula falsi (M. Dowell, P.
/// Jarratt, BIT 11, 1971).
class IllinoisBracket {
 public:
  IllinoisBracket(Trial left, Trial right) : left_(std::move(left)), right_(std::move(right)) {}

  [[nodiscard]] bool has_no_root() const { return left_.f * right_.f > 0; }
  [[nodiscard]] double width() const { return std::abs(right_.arc - left_.arc); }
  [[nodiscard]] double next() const { return left_.arc + share() * (right_.arc - left_.arc); }
  [[nodiscard]] double load() const {
    const double left = left_.state.load;
    return left + share() * (right_.state.load - left);
  }
  [[nodiscard]] const Trial& left() const { return left_; }
  [[nodiscard]] const Trial& right() const { return right_; }
  /// Returns the distance of the load at a point with the indicator f from the extremum of the
  /// load, if f is the derivative of the load. The load is approximated by a parabola.
  [[nodiscard]] double distance_to_extremum(double f) const {
    return f * f / 2 * width() / std::abs(right_.f - left_.f);
  }
  void update(Trial trial) {
    const bool is_left = trial.f * left_.f > 0;
    (is_left ? right_ : left_).f /= was_updated_ && is_left == was_left_ ? 2 : 1;
    (is_left ? left_ : right_) = std::move(trial);
    was_left_ = is_left;
    was_updated_ = true;
  }

 private:
  [[nodiscard]] double share() const { return left_.f / (left_.f - right_.f); }

  Trial left_, right_;
  bool was_updated_ = false, was_left_ = false;
};

/// Returns the length of the next step along the path, divided by the length of the last step. This
/// factor depends on the ratio of the second to the first Newton correction, which grows with the
/// square of the step (Deuflhard, Newton Methods for Nonlinear Problems, 2004, section 5.1). The
/// target of this ratio is a tenth. Unlike the number of iterations, the ratio is continuous, so
/// that round-off does not change the points of the path.
double relative_length_of_next_step(const std::vector<double>& correction) {
  constexpr double kWantedRatio = 0.1;
  if (correction.size() < 2) return 2;
  return std::clamp(std::sqrt(kWantedRatio * correction[0] / correction[1]), 0.5, 2.0);
}

/// Describes the coordinate with the largest motion in a shape, such as "rotation of node P".
std::string describe_largest_coordinate(const GeometricallyExactSystem& system,
                                        const VectorXd& shape) {
  const Layout& layout = system.layout();
  static constexpr std::array names = {"motion along x", "motion along y", "rotation"};
  double largest = -1;
  std::string description = "a motion inside a member";
  const auto consider = [&](Index k, const std::string& what) {
    if (k < 0 || k >= layout.free) return;
    const double amount = std::abs(shape[k]) / system.scale()[k];
    if (amount <= largest * (1 + 1e-9)) return;
    largest = amount;
    description = what;
  };
  for (std::size_t i = 0; i < layout.node.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      consider(layout.node[i][k],
               std::string(names[k]) + " of node " + system.model().nodes[i].name);
  }
  for (std::size_t i = 0; i < layout.end_rotation.size(); ++i) {
    for (const Index k : layout.end_rotation[i])
      consider(k, "rotation of an end of member " + system.model().members[i].name);
  }
  return description;
}

/// Limit point or bifurcation between two points of a path.
struct CriticalPoint {
  bool load_reversed = false;  ///< true: limit point; false: bifurcation
  std::optional<double> load;  ///< load factor; empty if it was not found
  PathPoint point;             ///< point of the path near the critical point
};

class PathFollower {
 public:
  PathFollower(const GeometricallyExactSystem& system, const StaticPathOptions& options)
      : system_(system), options_(options), equilibrium_(system, options.newton) {}

  StaticPath run() {
    if (start() && system_.coordinate_count() > 0) {
      while (next()) {
      }
    }
    path_.evidence.add(Residual::recovered_forces, balance_.residual());
    const Outcome judged = outcome_by_evidence(path_.outcome, path_.evidence);
    if (path_.outcome.solved() && !judged.solved()) not_converged(judged.reason);
    path_.counters.factorizations = equilibrium_.matrix().factorizations();
    path_.counters.solves = equilibrium_.matrix().solves();
    return std::move(path_);
  }

 private:
  bool start() {
    PathPoint point;
    point.state = system_.reference_state();
    point.newton = equilibrium_.solve(point.state, 0);
    if (!point.newton.outcome.solved()) return stop(point.newton.outcome);
    const bool at_rest = point.newton.correction.size() == 1;  // tangent was factored at this state
    if (!at_rest && !equilibrium_.factorize_tangent(point.state))
      return stop({Status::singular, "the tangent matrix is singular"});
    for (Index found = 0; found <= system_.coordinate_count(); ++found) {
      const Equilibrium::FreeMotion free = equilibrium_.free_motion(point.state);
      if (!free.exists) break;
      if (free.is_driven || !options_.keep_free_parts || found == system_.coordinate_count())
        return stop(
            {Status::singular, "free motion: " + describe_largest_coordinate(system_, free.shape)});
      equilibrium_.restrain_coordinate(free.coordinate, free.stiffness);
      if (!equilibrium_.factorize_tangent(point.state))
        return stop({Status::singular, "the tangent matrix is singular"});
    }
    VectorXd direction;
    equilibrium_.load_factor_sensitivity(point.state, direction);
    const double response = weighted_rms_norm(system_, direction.head(system_.coordinate_count()));
    if (!std::isfinite(response)) return stop({Status::singular, "the tangent matrix is singular"});
    const double typical = response < 1e-6 ? mean_response(point.state) : response;
    displacement_weight_ = 1 / std::pow(std::max(typical, 1e-6), 2);
    metric_ = VectorXd::Zero(direction.size() + 1);
    metric_.head(system_.coordinate_count()) = displacement_weight_ /
                                               static_cast<double>(system_.coordinate_count()) *
                                               system_.scale().cwiseAbs2().cwiseInverse();
    metric_.tail<1>().setOnes();
    direction_ = normalized(with_load(direction, 1));
    point.unstable_directions = equilibrium_.matrix().unstable_direction_count();
    const bool small = response * std::abs(options_.target) < options_.small_response;
    arc_step_ = (small ? std::abs(options_.target) : options_.first_step) / load_of(direction_);
    add_evidence(point.state);
    path_.points.push_back(std::move(point));
    return true;
  }

  /// Returns the displacement from the start to the target load by linear theory, divided by the
  /// target load factor. This value is used if drives start from rest, because the response at the
  /// start of the path is then zero.
  double mean_response(const State& start) {
    State end = start;
    system_.set_load_factor(end, options_.target);
    NewtonResult newton;
    VectorXd step;
    equilibrium_.newton_correction(end, step, newton);
    const double response = newton.correction.back() / std::abs(options_.target);
    return std::isfinite(response) ? response : 0;
  }

  bool stop(Outcome outcome) {
    path_.outcome = std::move(outcome);
    return false;
  }

  // Direction vectors (dq, dlambda, dload) are normalized to d^T diag(metric_) d = 1. The metric
  // weights displacements and the load factor. The weight of the multipliers is 0.

  static VectorXd with_load(const VectorXd& step, double load) {
    return (VectorXd(step.size() + 1) << step, load).finished();
  }
  static double load_of(const VectorXd& direction) { return direction[direction.size() - 1]; }
  double dot(const VectorXd& a, const VectorXd& b) const { return a.cwiseProduct(metric_).dot(b); }
  VectorXd normalized(const VectorXd& d) const { return d / std::sqrt(dot(d, d)); }

  /// Returns the tangent direction of the path, computed with the last factorization. Its sense is
  /// that of the direction `along`.
  VectorXd tangent(const State& state, const VectorXd& along) {
    VectorXd step;
    equilibrium_.load_factor_sensitivity(state, step);
    const VectorXd d = normalized(with_load(step, 1));
    return dot(along, d) < 0 ? VectorXd(-d) : d;
  }

  /// Computes a point of the path by Newton's method. The point lies on the plane that is normal to
  /// the direction d, at the distance `arc` from the last point.
  bool corrector(const VectorXd& d, double arc, PathPoint& point) {
    point.state = last().state;
    apply_correction(point.state, d, arc);
    double distance = 0;
    const auto stay_on_plane = [&](const VectorXd& correction, const VectorXd& load_step) {
      const double along = dot(d, with_load(load_step, 1));
      const double change = along == 0 ? 0.0 : -dot(d, with_load(correction, 0)) / along;
      const VectorXd moved = with_load(correction + change * load_step, change);
      distance += std::sqrt(dot(moved, moved));
      return distance < 0.3 * std::abs(arc) ? change : kNaN;
    };
    const double load = last().state.load + arc * load_of(d);
    point.newton = equilibrium_.solve(point.state, load, stay_on_plane);
    return point.newton.outcome.solved();
  }

  bool next() {
    if (static_cast<int>(point_count_) >= options_.max_points)
      return not_converged("the limit of the number of path points was reached");
    PathPoint point;
    VectorXd ahead;
    std::optional<CriticalPoint> critical;
    for (int cut = 0;; ++cut) {
      if (cut == 40) return not_converged("the path step was halved 40 times without success");
      // A step beyond the target load is replaced by a step that ends on this load, or is halved. A
      // step that may have reached another branch nearby is also halved.
      const bool reached = crosses_target() ? solve_at_target(point)
                                            : corrector(direction_, arc_step_, point) &&
                                                  !passed_target(point.state) &&
                                                  equilibrium_.factor_if_moved(point.state, kSame);
      if (reached) ahead = tangent(point.state, direction_);
      if (reached && dot(direction_, ahead) > kTurn) {
        point.unstable_directions = equilibrium_.matrix().unstable_direction_count();
        critical = find_critical_point(point, ahead);
        if (!critical || lies_on_path(*critical, point.state.load)) break;
      }
      arc_step_ /= 2;
    }
    ++point_count_;
    const bool done = point.state.load == options_.target;
    const bool switched = critical && record_event(*critical, point, done);
    if (!switched) {
      arc_step_ *= relative_length_of_next_step(point.newton.correction);
      direction_ = std::move(ahead);
      append(std::move(point));
    }
    return switched || !done;
  }

  /// Returns the critical point between the last point of the path and `to`, or an empty value if
  /// there is none.
  std::optional<CriticalPoint> find_critical_point(const PathPoint& to, const VectorXd& ahead) {
    CriticalPoint critical{load_of(ahead) * load_of(direction_) < 0, {}, to};
    const Index unstable = last().unstable_directions;
    const bool stability_changed = unstable >= 0 && to.unstable_directions != unstable;
    if (!critical.load_reversed && !stability_changed) return {};
    critical.load = locate(critical.load_reversed, to, critical.point);
    return critical;
  }

  /// Returns true if the critical point lies between the last point of the path and a point with
  /// the load `end`. The load of a limit point is beyond the loads of both points. The load of a
  /// bifurcation is between the loads of both points.
  bool lies_on_path(const CriticalPoint& critical, double end) const {
    if (last().unstable_directions < 0) return true;
    if (!critical.load) return false;
    const double load = *critical.load, slack = 1e-9 * std::abs(load);
    const auto [low, high] = std::minmax(last().state.load, end);
    if (!critical.load_reversed) return load > low - slack && load < high + slack;
    return load_of(direction_) > 0 ? load > high - slack : load < low + slack;
  }

  [[nodiscard]] const PathPoint& last() const { return path_.points.back(); }

  static VectorXd chord_between(const State& from, const State& to) {
    VectorXd chord(to.q.size() + to.lambda.size() + 1);
    chord << to.q - from.q, to.lambda - from.lambda, to.load - from.load;
    return chord;
  }

  void add_evidence(const State& state) {
    path_.evidence.add(Residual::equilibrium, equilibrium_.backward_error(state));
    balance_.add_state(system_, state);
  }

  void append(PathPoint point) {
    ++path_.counters.steps;
    add_evidence(point.state);
    if (!options_.keep_points) path_.points.clear();
    path_.points.push_back(std::move(point));
  }

  bool crosses_target() const {
    const double from = last().state.load, slope = load_of(direction_);
    return (from - options_.target) * (from + arc_step_ * slope - options_.target) <= 0 &&
           slope != 0;
  }

  bool passed_target(const State& to) const {
    return (last().state.load - options_.target) * (to.load - options_.target) < 0;
  }

  /// Solves the last step of the path, which ends on the target load.
  bool solve_at_target(PathPoint& point) {
    point.state = last().state;
    const double arc = (options_.target - point.state.load) / load_of(direction_);
    apply_correction(point.state, direction_, arc);
    const State guess = point.state;
    point.newton = equilibrium_.solve(point.state, options_.target);
    if (!point.newton.outcome.solved()) return false;
    const VectorXd distance = point.state.q - guess.q;
    return std::sqrt(displacement_weight_) * weighted_rms_norm(system_, distance) <
               0.5 * std::abs(arc) &&
           equilibrium_.factor_if_moved(point.state, kSame);
  }

  /// Records the critical points between the last point of the path and `point`. @return true if
  /// the path continues along another branch.
  bool record_event(const CriticalPoint& critical, const PathPoint& point, bool done) {
    PathEvent event;
    event.load = critical.load.value_or(critical.point.state.load);
    if (!equilibrium_.factorize_tangent(critical.point.state)) return false;
    equilibrium_.smallest_eigenpair(event.shape);
    // One critical point is recorded for each direction that becomes unstable or stable. A limit
    // point is one of these critical points.
    const Index unstable = last().unstable_directions;
    Index bifurcations = unstable < 0 ? 1 : std::abs(point.unstable_directions - unstable);
    if (critical.load_reversed) {
      event.kind = PathEvent::Kind::limit_point;
      path_.events.push_back(event);
      bifurcations = std::abs(bifurcations - 1);
    }
    event.kind = PathEvent::Kind::bifurcation;
    for (Index i = 0; i < bifurcations; ++i) path_.events.push_back(event);
    const bool switches = !critical.load_reversed && options_.switch_branch && !switched_;
    if (switches) switch_to_branch(critical.point, event.shape);
    if (!switches && done && !equilibrium_.factorize_tangent(point.state)) return false;
    return switches;
  }

  /// Returns the smallest useful distance from a bifurcation, relative to the length of the path.
  /// At a distance w, round-off displaces states normal to the path by epsilon/w of the model size.
  /// This displacement must be small compared with w.
  double nearest_to_bifurcation() const {
    const double size = std::max(std::sqrt(displacement_weight_), 1.0);
    return 8 * std::sqrt(std::numeric_limits<double>::epsilon() * size);
  }

  /// Locates a critical point of the path between its last point and the point `to`. At a limit
  /// point, the derivative of the load along the path vanishes. At a bifurcation, the smallest
  /// eigenvalue vanishes. `critical` is set to a state near the critical point.
  /// @returns the load factor, or an empty value if the critical point is not found, the path has a
  ///   gap, or there is another critical point.
  std::optional<double> locate(bool load_reversed, const PathPoint& to, PathPoint& critical) {
    const VectorXd& d = direction_;
    const State& from = last().state;
    const Index unstable = last().unstable_directions;
    const auto indicator = [&](const State& state) {
      if (load_reversed) return load_of(tangent(state, d));
      VectorXd shape;
      const double eigenvalue = equilibrium_.smallest_eigenpair(shape);
      return equilibrium_.matrix().unstable_direction_count() == unstable ? eigenvalue
                                                                          : -eigenvalue;
    };
    const VectorXd chord = chord_between(from, to.state);
    const double interval = dot(d, chord);
    if (!equilibrium_.factorize_tangent(from)) return {};
    const auto trial_at = [&](double arc, const State& state) {
      const double f = indicator(state);
      return Trial{arc, f, equilibrium_.matrix().unstable_direction_count(), state};
    };
    Trial first = trial_at(0, from);
    if (!equilibrium_.factorize_tangent(to.state)) return {};
    IllinoisBracket bracket(std::move(first), trial_at(interval, to.state));
    const double nearest =
        nearest_to_bifurcation() * std::max(std::abs(to.state.load), std::abs(interval));
    double f = 0;  // indicator f of the last trial point
    const auto solve_at = [&](double arc, PathPoint& trial) {
      if (!corrector(d, arc, trial) || !equilibrium_.factorize_tangent(trial.state)) return false;
      Trial found = trial_at(arc, trial.state);
      f = found.f;
      bracket.update(std::move(found));
      return true;
    };
    std::optional<double> load;
    // Solve at points on both sides of the bifurcation, because the equations are singular at the
    // bifurcation itself.
    const auto solve_beside = [&](double root, PathPoint& trial) {
      const double least = load ? nearest : std::max(1e-3 * bracket.width(), nearest);
      for (const double aside : {least, 4 * least})
        if (solve_at(root - aside, trial) && solve_at(root + aside, trial)) return true;
      return false;
    };
    const double enough = load_reversed ? 0 : 4 * nearest;
    for (int i = 0; i < 60 && bracket.width() > enough && !load; ++i) {
      if (bracket.has_no_root()) return {};
      const double root = bracket.next(), last = critical.state.load;
      PathPoint trial;
      if (solve_at(root, trial)) {
        critical = trial;
        const double left =
            load_reversed ? bracket.distance_to_extremum(f) : critical.state.load - last;
        if (std::abs(left) > 1e-13 * std::abs(last)) continue;
        load = critical.state.load;
      }
      if (!solve_beside(root, trial)) return {};
      if (!load) critical = std::move(trial);
    }
    // States on both sides of a gap do not belong to one path. The distance between the two states
    // normal to the path exceeds the distance that the curvature of the path explains.
    const Trial &left = bracket.left(), &right = bracket.right();
    const VectorXd across = chord_between(left.state, right.state);
    const double along = dot(normalized(chord), across);
    if (dot(across, across) - along * along > 0.05 * along * along) return {};
    const bool alone = left.unstable == unstable || unstable < 0;
    if (!alone || right.unstable != to.unstable_directions) return {};
    return load ? load : bracket.load();
  }

  void switch_to_branch(const PathPoint& critical, const VectorXd& shape) {
    switched_ = true;
    const Index n = system_.coordinate_count();
    direction_.setZero();
    direction_.head(n) = shape;
    direction_ = normalized(direction_);
    // The first step on the new branch displaces the structure by 1e-3 of the model size,
    // independent of its response before the bifurcation. The buckling shape is noticeable at this
    // amplitude.
    arc_step_ = 1e-3 * std::sqrt(displacement_weight_);
    append(critical);
    path_.points.back().unstable_directions = -1;
  }

  bool not_converged(const std::string& why) {
    const PathPoint& point = last();
    std::ostringstream message;
    message << why << " after point " << point_count_ << " at load factor " << point.state.load
            << ", arc-length step " << arc_step_ << ", residual "
            << (point.newton.force_residual.empty() ? 0.0 : point.newton.force_residual.back())
            << " N m" << drive_conflicts_text(system_, point.state, std::abs(arc_step_));
    return stop({Status::not_converged, message.str()});
  }

  const GeometricallyExactSystem& system_;
  const StaticPathOptions& options_;
  Equilibrium equilibrium_;
  StaticPath path_;
  MemberBalance balance_;
  VectorXd direction_, metric_;
  double displacement_weight_ = 1;  ///< weight of the displacements relative to the load factor
  double arc_step_ = 0;
  std::size_t point_count_ = 0;
  bool switched_ = false;
};

}  // namespace

StaticPath follow_static_path(const GeometricallyExactSystem& system,
                              const StaticPathOptions& options) {
  return PathFollower(system, options).run();
}

}  // namespace trammel::solver::large_motion
