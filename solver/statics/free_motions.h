#pragma once

#include <string>
#include <vector>

#include "solver/assembly/system.h"

/// Which parts of a mechanism move freely, and how.
namespace trammel::solver {

/// A rigid motion of one part, to first order.
struct FreeMotion {
  enum class Kind {
    in_plane,        ///< along x, along y and in rotation
    in_translation,  ///< along x and along y
    along,           ///< a direction
    about,           ///< a centre
    turning          ///< the rotation of a node
  };
  Kind kind = Kind::along;
  std::string part;                    ///< "member AB"
  Vector2d vector = Vector2d::Zero();  ///< of `along`, with x > 0 or along y; centre of `about` [m]
};

/// Takes the span of zero-energy modes apart into motions of few parts.
/// @param basis  q x count: free motions that deform nothing
/// @return for each mode the parts that it moves; motions of the whole model first
[[nodiscard]] std::vector<std::vector<FreeMotion>> find_free_motions(const System& system,
                                                                     const Eigen::MatrixXd& basis);

}  // namespace trammel::solver
