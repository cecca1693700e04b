#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/results/run_results.h"
#include "solver/large/geometrically_exact_system.h"
#include "solver/linear/system.h"
#include "solver/manipulator/kinematics.h"
#include "solver/manipulator/trajectory.h"

namespace trammel::harness {

using results::Drawing;

[[nodiscard]] inline results::Point point_of(const Eigen::Vector2d& position) {
  return {position.x(), position.y()};
}

/// What a picture can show.
inline constexpr std::size_t kMaxDrawnNodes = 4000;

/// Adds triangles, rigid bodies and joints of a drawing that begins with all nodes of the model.
void draw_parts(const solver::Model& model, bool is_manipulator, Drawing& drawing);

/// The mesh of a model, members smoothed by points inside their elements. A fine mesh is drawn
/// without the middles of its six-node triangles; nothing where there still are more nodes than a
/// picture can show.
[[nodiscard]] std::optional<Drawing> draw_model(const solver::System& system, bool is_manipulator);

/// Displacements of the drawing's nodes under the free coordinates q: inside elements by the cubic
/// shape functions of the Euler-Bernoulli beam.
[[nodiscard]] results::Shape draw_shape(const solver::System& system, const Eigen::VectorXd& q,
                                        const std::string& label);

/// The samples of a motion that a picture can show: 48 at most, fewer of a fine mesh. Where so few
/// would miss vibrations, they are of the beginning alone.
/// @param q      coordinates of each sample
/// @param nodes  of the drawing
[[nodiscard]] std::vector<std::size_t> drawn_samples(const std::vector<Eigen::VectorXd>& q,
                                                     std::size_t nodes);

/// How many moments of a motion a picture with so many nodes can show.
[[nodiscard]] std::size_t max_drawn_moments(std::size_t nodes);

/// "0.25 s"
[[nodiscard]] std::string moment_label(double time);

/// Displacement at s in [0, 1] along an element, from the unconstrained coordinates u = T q [m].
[[nodiscard]] Eigen::Vector2d displacement_along(const solver::FrameElement& element,
                                                 const Eigen::VectorXd& u, double s);

/// A rigid manipulator at the first point and, where there are more, at moments of its path.
[[nodiscard]] Drawing draw_manipulator(const solver::ManipulatorGeometry& geometry,
                                       const std::vector<solver::TrajectoryPoint>& motion);

/// The model in its own pose; nothing where there are more nodes than a picture can show.
[[nodiscard]] std::optional<Drawing> draw_large_model(
    const solver::large_motion::GeometricallyExactSystem& system, bool is_manipulator);

/// Positions of the drawing's nodes at coordinates q.
[[nodiscard]] results::Pose draw_large_pose(
    const solver::large_motion::GeometricallyExactSystem& system, const Eigen::VectorXd& q,
    const std::string& label);

}  // namespace trammel::harness
