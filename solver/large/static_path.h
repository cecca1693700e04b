#pragma once

#include <string>
#include <vector>

#include "solver/large/equilibrium.h"
#include "solver/large/geometrically_exact_system.h"
#include "solver/linear/system.h"
#include "solver/model/evidence.h"

namespace trammel::solver::large_motion {

struct StaticPathOptions {
  double target = 1;  ///< load factor to reach
  double first_step =
      0.1;  ///< of the load factor; later steps follow from the number of Newton iterations
  /// A response to the whole load below it, relative to the model, is tried in one step.
  double small_response = 0;
  int max_points = 2000;       ///< at most
  bool switch_branch = false;  ///< leave the first bifurcation along its buckling shape
  bool keep_points = true;     ///< false: keep the last point only
  /// Parts that move freely and that no load drives stay where they are; false: they are singular.
  bool keep_free_parts = false;
  NewtonOptions newton;
};

struct PathPoint {
  State state;                    ///< state.load is the load factor
  Index unstable_directions = 0;  ///< negative pivots of the tangent: directions in which it is
                                  ///< unstable; -1 where follower loads leave no such count
  NewtonResult newton;
};

struct PathEvent {
  enum class Kind { limit_point, bifurcation };
  Kind kind = Kind::limit_point;
  double load = 0;  ///< load factor
  VectorXd shape;   ///< critical mode there, over the coordinates
};

/// The path of equilibria from load factor 0 to the target.
struct StaticPath {
  Outcome outcome;  ///< not_converged names the load factor, the step and the residual
  std::vector<PathPoint> points;
  std::vector<PathEvent> events;
  Evidence evidence;  ///< of every point passed
  Counters counters;
};

/// Follows the equilibria by arc-length continuation (E. Riks, IJSS 15, 1979) with automatic steps:
/// limit points are passed, a change of the number of negative pivots without one is a bifurcation,
/// and both are located.
[[nodiscard]] StaticPath follow_static_path(const GeometricallyExactSystem& system,
                                            const StaticPathOptions& options = {});

}  // namespace trammel::solver::large_motion
