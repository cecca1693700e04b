#pragma once

#include <random>

#include "solver/manipulator/frequency_sensitivity.h"
#include "tests/support/solver/table_1.h"

/// Designs, poses and parameters for tests of sensitivities.
namespace trammel::solver {

using Eigen::VectorXd;
using Kind = trammel::solver::DesignParameter::Kind;

inline DesignParameter all(Kind kind) {
  return {.kind = kind, .platform = kind != Kind::length};
}

inline DesignParameter length_parameter(std::size_t limb, bool is_proximal) {
  DesignParameter p{.kind = Kind::length, .proximal = {}, .distal = {}};
  (is_proximal ? p.proximal : p.distal)[limb] = true;
  return p;
}

inline ManipulatorDesign coarse_design(Index elements = 2) {
  return meshed_design(elements, PlatformKind::triangles);
}

/// Returns a pose well inside the reach, where no limb is nearly straight or folded.
inline Pose random_pose(const ManipulatorDesign& design, std::mt19937_64& engine) {
  const auto uniform = [&engine](double low, double high) {
    return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53;
  };
  for (;;) {
    const Pose pose{uniform(0.05, 0.45), uniform(-0.05, 0.4), uniform(-0.6, 0.6)};
    const Posture posture = inverse_kinematics(design.geometry, pose);
    if (!posture.outcome.solved()) continue;
    if (jacobians(design.geometry, pose, posture).serial_distance > 0.15) return pose;
  }
}

/// Returns a pose with the platform on the centroid of the base at a random angle. By the threefold
/// symmetry, frequencies occur in equal pairs, except for modes whose shape has the threefold
/// symmetry.
inline Pose random_centered_pose(std::mt19937_64& engine) {
  return centered_pose(-0.6 + 1.2 * static_cast<double>(engine() >> 11) * 0x1p-53);
}

}  // namespace trammel::solver
