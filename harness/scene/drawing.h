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

[[nodiscard]] inline results::Point point_at_position(const Eigen::Vector2d& position) {
  return {position.x(), position.y()};
}

inline constexpr std::size_t kMaxDrawnNodes = 4000;

/// Adds triangles, rigid bodies and joints to a drawing that begins with all nodes of the model.
void draw_model_parts(const solver::Model& model, bool is_manipulator, Drawing& drawing);

/// Draws the mesh of a model, with points inside elements, so that bent members look smooth. A fine
/// mesh is drawn without the mid-side nodes of its six-node triangles. Returns nothing if the
/// drawing would have more than kMaxDrawnNodes nodes.
[[nodiscard]] std::optional<Drawing> draw_model(const solver::System& system, bool is_manipulator);

/// Returns the displacements of the drawing's nodes for free coordinates q. Inside elements, it
/// uses the cubic shape functions of the Euler-Bernoulli beam.
[[nodiscard]] results::Shape draw_shape(const solver::System& system, const Eigen::VectorXd& q,
                                        const std::string& label);

/// Returns the samples of a motion that are drawn: at most 48, and fewer for a fine mesh. If these
/// samples are too few to show the vibrations of the full motion, they cover only its beginning.
/// @param q      coordinates of each sample
/// @param nodes  number of nodes of the drawing
[[nodiscard]] std::vector<std::size_t> samples_to_draw(const std::vector<Eigen::VectorXd>& q,
                                                       std::size_t nodes);

/// Returns the maximum number of times at which a motion is drawn, for a drawing with this number
/// of nodes.
[[nodiscard]] std::size_t max_drawn_times(std::size_t nodes);

/// Returns the label of a drawing at one time of a motion: "0.25 s".
[[nodiscard]] std::string time_label(double time);

/// Returns the displacement at s in [0, 1] along an element, from the unconstrained coordinates u =
/// T q [m].
[[nodiscard]] Eigen::Vector2d displacement_at_fraction(const solver::FrameElement& element,
                                                       const Eigen::VectorXd& u, double s);

/// Draws a rigid manipulator at the first point of its path and, if the path has several points, at
/// further times.
[[nodiscard]] Drawing draw_manipulator(const solver::ManipulatorGeometry& geometry,
                                       const std::vector<solver::TrajectoryPoint>& motion);

/// Draws the model in its initial pose. Returns nothing if the drawing would have more than
/// kMaxDrawnNodes nodes.
[[nodiscard]] std::optional<Drawing> draw_initial_pose(
    const solver::large_motion::GeometricallyExactSystem& system, bool is_manipulator);

/// Returns the positions of the drawing's nodes at coordinates q.
[[nodiscard]] results::Pose draw_pose(const solver::large_motion::GeometricallyExactSystem& system,
                                      const Eigen::VectorXd& q, const std::string& label);

}  // namespace trammel::harness
