#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "solver/sensitivity/frequency_differences.h"
#include "tests/support/solver/table_1.h"

/// Sensitivities by differences of the frequencies of the changed design.
namespace trammel::solver {

using Eigen::VectorXd;
using Kind = trammel::solver::DesignParameter::Kind;

inline DesignParameter all(Kind kind) {
  return {.kind = kind, .platform = kind != Kind::length};
}

inline DesignParameter one_length(std::size_t limb, bool is_proximal) {
  DesignParameter p{.kind = Kind::length, .proximal = {}, .distal = {}};
  (is_proximal ? p.proximal : p.distal)[limb] = true;
  return p;
}

inline ManipulatorDesign coarse_design(Index elements = 2) {
  ManipulatorDesign design = table_1_design();
  for (std::size_t i = 0; i < 3; ++i) {
    design.proximal[i].elements = design.distal[i].elements = elements;
  }
  return design;
}

/// A pose well inside the reach, where no limb is nearly straight or folded.
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

/// The platform on the centroid of the base, turned at random: every frequency of the plane
/// problem that is not one of the whole repeats, by the three-fold symmetry.
inline Pose random_centred_pose(std::mt19937_64& engine) {
  return centred_pose(-0.6 + 1.2 * static_cast<double>(engine() >> 11) * 0x1p-53);
}

struct Comparison {
  double worst = 0;  ///< largest error over the largest derivative of that mode
  Index compared = 0;
  Index repeated = 0;  ///< poses with repeated frequencies
};

/// @param centred  every so many poses is a centred one; 0: none
inline Comparison compare(const ManipulatorDesign& design, const DesignParameter& parameter,
                          int poses, double relative_step, std::uint64_t seed, int centred = 0) {
  constexpr Index kModes = 6;
  std::mt19937_64 engine(seed);
  VectorXd error = VectorXd::Zero(kModes);
  VectorXd largest = VectorXd::Zero(kModes);
  Comparison result;
  for (int i = 0; i < poses; ++i) {
    const bool symmetric = centred > 0 && i % centred == 0;
    const Pose pose = symmetric ? random_centred_pose(engine) : random_pose(design, engine);
    const FrequencySensitivity s = frequency_sensitivity(design, pose, {parameter}, kModes);
    if (!s.outcome.solved()) throw ModelError(s.outcome.reason);
    const FrequencyDifferences differences =
        differentiate_frequencies(design, pose, parameter, kModes, relative_step);
    if (!differences.outcome.solved()) throw ModelError(differences.outcome.reason);
    error = error.cwiseMax((s.derivative.col(0) - differences.derivative).cwiseAbs());
    largest = largest.cwiseMax(s.derivative.col(0).cwiseAbs());
    ++result.compared;
    for (const FrequencySet& set : s.sets) {
      if (set.count < 2) continue;
      ++result.repeated;
      break;
    }
  }
  result.worst = error.cwiseQuotient(largest).maxCoeff();
  return result;
}

}  // namespace trammel::solver
