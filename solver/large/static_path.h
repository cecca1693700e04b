#pragma once

#include <vector>

#include "solver/large/equilibrium.h"
#include "solver/large/geometrically_exact_system.h"
#include "solver/linear/system.h"
#include "solver/model/evidence.h"

namespace trammel::solver::large_motion {

/// Options of a path of equilibria.
struct StaticPathOptions {
  double target = 1;  ///< load factor at the end of the path
  double first_step =
      0.1;  ///< first increment of the load factor; the program selects all later increments
  /// Limit of the displacement under the full load by linear theory, relative to the model size
  /// [-]. Below this limit, the load is applied in one step.
  double small_response = 0;
  int max_points = 2000;       ///< limit of the number of points of the path
  bool switch_branch = false;  ///< true: leave the first bifurcation along its buckling shape
  bool keep_points = true;     ///< true: return all points; false: only the last point
  /// true: members or bodies that can move freely remain at rest if no load drives the free motion;
  /// false: a model with a free motion is singular.
  bool keep_free_parts = false;
  NewtonOptions newton;
};

/// Equilibrium at one point of a path of equilibria.
struct PathPoint {
  State state;  ///< state.load is the load factor
  /// Number of unstable directions, from the negative pivots of the tangent matrix. The number is
  /// -1 if follower loads make the tangent matrix nonsymmetric.
  Index unstable_directions = 0;
  NewtonResult newton;
};

/// Critical point of a path of equilibria: limit point or bifurcation.
struct PathEvent {
  enum class Kind { limit_point, bifurcation };
  Kind kind = Kind::limit_point;
  double load = 0;  ///< load factor
  VectorXd shape;   ///< critical mode shape, one value per free coordinate
};

/// Path of equilibria from load factor 0 to the target.
struct StaticPath {
  Outcome outcome;  ///< not_converged: the reason states load factor, step and residual
  std::vector<PathPoint> points;
  std::vector<PathEvent> events;
  Evidence evidence;  ///< residuals of all points
  Counters counters;
};

/// Follows the equilibria by arc-length continuation (E. Riks, IJSS 15, 1979) with automatic steps.
/// The path continues beyond limit points. A change of the number of negative pivots without a
/// limit point is a bifurcation. Critical points of both types are located.
[[nodiscard]] StaticPath follow_static_path(const GeometricallyExactSystem& system,
                                            const StaticPathOptions& options = {});

}  // namespace trammel::solver::large_motion
